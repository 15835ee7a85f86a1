#include "experiments/campaign/plan_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "bendlab/io/disk.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

constexpr int format = 1;

RunFileError plan_error(const fs::path& file, const std::string& what) {
  return RunFileError(fmt::format("{}: {}. Write the plan again with 'bendlab plan CONFIG… --write {}'.",
                                  file.string(), what, file.string()));
}

Json read_document(const fs::path& file) {
  std::string text;
  try {
    text = read_input_file(file);
  } catch (const std::runtime_error& error) {
    throw RunFileError(fmt::format("{}: the plan {}", file.string(), error.what()));
  }
  Json plan = Json::parse(text, nullptr, false);
  if (!plan.is_object() || plan.value("bendlab_plan", 0) != format)
    throw plan_error(file, "this is not a plan of bendlab");
  return plan;
}

template <class Read>
auto reading(const fs::path& file, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw plan_error(file, fmt::format("the plan is damaged ({})", error.what()));
  }
}

}  // namespace

void write_plan(const fs::path& file, const std::vector<Experiment>& experiments, const fs::path& out) {
  Json plan = {{"bendlab_plan", format},
               {"version", build_info().version},
               {"source_hash", build_info().source_hash},
               {"out", fs::absolute(out).lexically_normal().string()},
               {"experiments", Json::array()},
               {"runs", Json::array()}};
  for (const Experiment& experiment : experiments)
    plan["experiments"].push_back({{"config", fs::absolute(experiment.source).lexically_normal().string()},
                                   {"text", read_input_file(experiment.source)},
                                   {"overrides", experiment.overrides}});
  for (const CampaignRun& run : plan_campaign(experiments)) {
    const std::string id = run_id(*run.config);
    const fs::path folder = run_folder("", *run.experiment, *run.config, id);
    plan["runs"].push_back({{"id", id},
                            {"text", run_text(run)},
                            {"folder", folder.string()},
                            {"work", crude_work(*run.config)}});
  }
  if (file.has_parent_path()) make_folder(file.parent_path());
  replace_file(file, plan.dump(1) + "\n");
}

PlanOverview read_plan(const fs::path& file) {
  const Json plan = read_document(file);
  return reading(file, [&] {
    PlanOverview overview{plan.at("source_hash"), plan.at("version"), plan.at("out").get<std::string>(), {}};
    for (const Json& run : plan.at("runs"))
      overview.runs.push_back(
          {run.at("id"), run.at("text"), overview.out / run.at("folder").get<std::string>(), run.at("work")});
    return overview;
  });
}

Plan load_plan(const fs::path& file) {
  const Json document = read_document(file);
  return reading(file, [&] {
    if (document.at("source_hash") != build_info().source_hash)
      throw plan_error(file,
                       fmt::format("it was written by another version of the program ({}, sources {}); in "
                                   "this version ({}, sources {}) the planned runs would have other ids",
                                   document.at("version").get<std::string>(),
                                   document.at("source_hash").get<std::string>(), build_info().version,
                                   build_info().source_hash));
    Plan plan{{}, document.at("out").get<std::string>()};
    for (const Json& experiment : document.at("experiments"))
      plan.experiments.push_back(parse_config(experiment.at("text").get<std::string>(),
                                              fs::path(experiment.at("config").get<std::string>()),
                                              experiment.at("overrides").get<std::vector<std::string>>()));
    const std::vector<CampaignRun> runs = plan_campaign(plan.experiments);
    const Json& planned = document.at("runs");
    if (runs.size() != planned.size())
      throw plan_error(file, "the number of runs of the plan's configs has changed");
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (const std::string id = run_id(*runs[i].config); id != planned.at(i).at("id"))
        throw plan_error(
            file, fmt::format("{} is a different run now, because a file that the run reads was changed",
                              run_text(runs[i])));
    return plan;
  });
}

}  // namespace bendlab
