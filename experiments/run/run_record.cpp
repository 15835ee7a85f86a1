#include "experiments/run/run_record.hpp"

#include <cmath>
#include <limits>

#include "bendlab/parameters/names.hpp"

namespace bendlab {

nlohmann::json number_json(double number) {
  return std::isfinite(number) ? nlohmann::json(number)
         : std::isnan(number)  ? nlohmann::json()
                               : nlohmann::json(number > 0 ? "inf" : "-inf");
}

double number_of(const nlohmann::json& value) {
  if (value.is_number()) return value.get<double>();
  if (value.is_null()) return std::nan("");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return value == "inf" ? infinity : -infinity;
}

nlohmann::json head_json(const RunRecord& run) {
  nlohmann::json passes = nlohmann::json::array();
  for (const PassTime& pass : run.passes) passes.push_back({pass.name, pass.seconds, pass.calls, pass.acted});
  return {{"id", run.id},
          {"name", run.name},
          {"status", to_string(run.status)},
          {"frames", run.frames},
          {"wall_s", number_json(run.wall_s)},
          {"cpu_s", number_json(run.cpu_s)},
          {"step_cpu_s", number_json(run.step_cpu_s)},
          {"metrics", run.metrics},
          {"constraints", run.constraints},
          {"passes", std::move(passes)}};
}

RunRecord record_of(const nlohmann::json& head, const std::filesystem::path& file) {
  RunRecord run{.file = file,
                .id = head.at("id"),
                .name = head.at("name"),
                .status = named<RunStatus>(head.at("status").get<std::string>(), run_status_names),
                .frames = head.at("frames"),
                .wall_s = number_of(head.at("wall_s")),
                .cpu_s = number_of(head.at("cpu_s")),
                .step_cpu_s = number_of(head.at("step_cpu_s")),
                .metrics = head.at("metrics"),
                .constraints = head.at("constraints")};
  for (const nlohmann::json& pass : head.at("passes"))
    run.passes.push_back({pass.at(0), number_of(pass.at(1)), pass.at(2), pass.at(3)});
  return run;
}

std::string provenance_text(const RunRecord& run, const std::string& name, const std::string& absent) {
  const auto found = run.provenance.find(name);
  return found == run.provenance.end() ? absent : found->second;
}

Json provenance_json(const RunRecord& run, const std::string& name) {
  Json value = Json::parse(provenance_text(run, name, "null"), nullptr, false);
  return value.is_discarded() ? Json() : value;
}

}  // namespace bendlab
