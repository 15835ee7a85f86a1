#include "experiments/run/warning.hpp"

#include <cmath>

namespace bendlab {

Json to_json(const std::vector<Warning>& warnings) {
  Json json = Json::array();
  for (const Warning& warning : warnings) {
    json.push_back({{"code", warning.code}, {"message", warning.message}});
    if (!warning.measured.empty() && std::isfinite(warning.severity))
      json.back().update({{"severity", warning.severity}, {"measured", warning.measured}});
  }
  return json;
}

std::vector<Warning> warnings_of(const Json& json) {
  std::vector<Warning> warnings;
  if (!json.is_array()) return warnings;
  for (const Json& each : json) {
    if (!each.is_object() || !each.contains("code") || !each.contains("message") ||
        !each["code"].is_string() || !each["message"].is_string())
      continue;
    Warning& warning = warnings.emplace_back(Warning{each["code"], each["message"]});
    const auto severity = each.find("severity"), measured = each.find("measured");
    if (severity == each.end() || measured == each.end() || !severity->is_number() || !measured->is_string())
      continue;
    warning.severity = *severity, warning.measured = *measured;
  }
  return warnings;
}

}  // namespace bendlab
