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
  for (const Json& entry : json) {
    if (!entry.is_object() || !entry.contains("code") || !entry.contains("message") ||
        !entry["code"].is_string() || !entry["message"].is_string())
      continue;
    Warning& warning = warnings.emplace_back(Warning{entry["code"], entry["message"]});
    const auto severity = entry.find("severity"), measured = entry.find("measured");
    if (severity == entry.end() || measured == entry.end() || !severity->is_number() ||
        !measured->is_string())
      continue;
    warning.severity = *severity, warning.measured = *measured;
  }
  return warnings;
}

}  // namespace bendlab
