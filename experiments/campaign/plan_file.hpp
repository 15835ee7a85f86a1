// A plan: a JSON file from which many machines compute the runs of some experiments together. A plan never
// changes once it is written. The folders of the runs show which runs are done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// A run of a plan, as written in the plan's file.
struct PlannedRun {
  std::string id, text;  ///< `text`: the run's experiment and swept values
  std::filesystem::path folder;
  double work = 0;  ///< crude_work() the run
};

/// The parts of a plan that `bendlab status` needs.
struct PlanOverview {
  std::string source_hash, version;  ///< of the program that wrote the plan
  std::filesystem::path out;
  std::vector<PlannedRun> runs;
};

/// Writes a plan: the texts of the configs, the overrides, the folder of results, and the list of runs.
/// Throws RunFileError.
void write_plan(const std::filesystem::path& file, const std::vector<Experiment>& experiments,
                const std::filesystem::path& out);

/// Throws RunFileError if the file is not a plan.
PlanOverview read_plan(const std::filesystem::path& file);

/// The experiments of a plan, and its folder of results. Throws RunFileError if a run would differ from the
/// planned run: another version of the program wrote the plan, or a file that a run reads was changed.
struct Plan {
  std::vector<Experiment> experiments;
  std::filesystem::path out;
};
Plan load_plan(const std::filesystem::path& file);

}  // namespace bendlab
