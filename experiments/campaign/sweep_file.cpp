#include "experiments/campaign/sweep_file.hpp"

#include <fmt/format.h>

#include "bendlab/io/disk.hpp"
#include "experiments/config/schema.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

Json run_entry(const fs::path& out, const Experiment& experiment, const RunConfig& config) {
  const std::string id = run_id(config);
  return {{"point", point_json(config)},
          {"id", id},
          {"folder", run_folder(out, experiment, config, id).filename().string()}};
}

Json to_json(const Expectation& expectation) {
  Json entry = {{"metric", expectation.metric}, {"why", expectation.why}};
  if (expectation.minimum) entry["min"] = *expectation.minimum;
  if (expectation.maximum) entry["max"] = *expectation.maximum;
  if (!expectation.where.empty()) entry["where"] = expectation.where;
  return entry;
}

// The list as JSON text, with one entry per line.
std::string lines_of(const Json& list) {
  std::string text = "[";
  for (const Json& entry : list) text += fmt::format("{}\n  {}", text.size() == 1 ? "" : ",", entry.dump());
  return text + "\n]";
}

std::string sweep_text(const fs::path& out, const Experiment& experiment) {
  const BuildInfo& build = build_info();
  Json axes = Json::object(), runs = Json::array(), expect = Json::array();
  for (const Expectation& expectation : experiment.expectations) expect.push_back(to_json(expectation));
  for (const auto& [pointer, values] : experiment.axes) axes[pointer] = values;
  for (const RunConfig& config : experiment.runs) runs.push_back(run_entry(out, experiment, config));
  const Json head = {{"experiment", experiment.name},
                     {"config", experiment.source.string()},
                     {"overrides", experiment.overrides},
                     {"version", build.version},
                     {"git_commit", build.git_commit},
                     {"source_hash", build.source_hash},
                     {"settings", experiment.settings},
                     {"models", model_traits_json()},
                     {"methods", method_traits_json()},
                     {"cover", experiment.cover.strength},
                     {"expect", expect}};
  std::string text = "{\n";
  for (const auto& [key, value] : head.items()) text += fmt::format("\"{}\": {},\n", key, value.dump());
  return text + fmt::format("\"axes\": {},\n\"runs\": {}\n}}\n", axes.dump(), lines_of(runs));
}

}  // namespace

fs::path sweep_file(const fs::path& out, const Experiment& experiment) {
  std::string name = experiment.source.empty() ? "text" : experiment.source.stem().string();
  if (!experiment.overrides.empty())
    name += "," + hex_hash(fmt::format("{}", fmt::join(experiment.overrides, "\n")));
  return out / experiment.name / (name + ".sweep.json");
}

std::vector<SweepFile> sweep_files(const fs::path& out, const std::vector<Experiment>& experiments) {
  std::vector<SweepFile> files;
  for (const Experiment& experiment : experiments)
    files.push_back({sweep_file(out, experiment), sweep_text(out, experiment)});
  return files;
}

void write(const std::vector<SweepFile>& files) {
  for (const auto& [file, text] : files) {
    make_folder(file.parent_path());
    replace_file(file, text);
  }
}

}  // namespace bendlab
