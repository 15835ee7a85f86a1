#include "bendlab/io/facts.hpp"

#include <cmath>
#include <cstdlib>

#include "bendlab/settings/names.hpp"

namespace bendlab {

Json number_json(double number) {
  if (std::isfinite(number)) return number;
  return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
}

double number_of(const Json& json) {
  return json.is_string() ? std::strtod(json.get_ref<const std::string&>().c_str(), nullptr)
                          : json.get<double>();
}

Json facts_of(const RunRecord& run) {
  Json json = {{"id", run.id},
               {"name", run.name},
               {"frames", run.frames},
               {"metrics", run.metrics},
               {"constraints", run.constraints},
               {"config", Json::parse(run.config)}};
  json.update(facts_of(RunFooter{.status = run.status,
                                 .summary = run.summary,
                                 .passes = run.passes,
                                 .wall_s = run.wall_s,
                                 .cpu_s = run.cpu_s,
                                 .step_cpu_s = run.step_cpu_s,
                                 .provenance = run.provenance}));
  return json;
}

Json facts_of(const RunFooter& footer) {
  Json passes = Json::array(), summary = Json::object();
  for (const PassTime& pass : footer.passes)
    passes.push_back({pass.name, number_json(pass.seconds), pass.calls, pass.acted});
  for (const auto& [name, value] : footer.summary) summary[name] = number_json(value);
  return {{"status", to_string(footer.status)},
          {"wall_s", number_json(footer.wall_s)},
          {"cpu_s", number_json(footer.cpu_s)},
          {"step_cpu_s", number_json(footer.step_cpu_s)},
          {"passes", passes},
          {"summary", summary},
          {"provenance", footer.provenance}};
}

Json facts_of(const RunHeader& header) {
  Json metrics = {"time"}, units = {"s"}, meanings = {"simulated time"}, counts = Json::object(),
       hashes = counts, fields = counts, inputs = Json::array();
  for (const Column& column : header.metrics)
    metrics.push_back(column.name), units.push_back(column.unit), meanings.push_back(column.meaning);
  for (const ConstraintRecord& record : header.constraints)
    counts[record.kind] = record.count, hashes[record.kind] = record.hash;
  for (const Column& field : header.cell_fields) fields[field.name] = {field.unit, field.meaning};
  for (const InputFile& input : header.inputs) inputs.push_back({input.pointer, input.name});
  Json facts = facts_of(RunFooter{.status = RunStatus::running, .provenance = header.provenance});
  facts.update({{"id", header.id},
                {"name", header.name},
                {"metrics", metrics},
                {"units", units},
                {"meanings", meanings},
                {"cell_fields", fields},
                {"constraints", counts},
                {"hashes", hashes},
                {"inputs", inputs},
                {"config", Json::parse(header.config)}});
  return facts;
}

RunRecord record_of(const Json& json, const std::filesystem::path& file) {
  RunRecord run{.file = file,
                .id = json.at("id"),
                .name = json.at("name"),
                .status = named<RunStatus>(json.at("status").get<std::string>(), run_status_names),
                .frames = json.value("frames", std::uint64_t{0}),
                .wall_s = number_of(json.at("wall_s")),
                .cpu_s = number_of(json.at("cpu_s")),
                .step_cpu_s = number_of(json.at("step_cpu_s")),
                .provenance = json.value("provenance", std::map<std::string, std::string>()),
                .config = json.contains("config") ? json.at("config").dump() : "",
                .metrics = json.at("metrics"),
                .constraints = json.at("constraints")};
  for (const Json& pass : json.at("passes"))
    run.passes.push_back({pass.at(0), number_of(pass.at(1)), pass.at(2), pass.at(3)});
  if (json.contains("summary"))
    for (const auto& [name, value] : json.at("summary").items()) run.summary[name] = number_of(value);
  return run;
}

}  // namespace bendlab
