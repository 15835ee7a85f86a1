// A plan: what many machines need to compute the runs of some experiments together. It is a JSON file that
// nobody changes once it is written; what has been done is seen in the runs' folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// A run of a plan, as it stands in the file.
struct PlannedRun {
  std::string id, text;  ///< `text`: its experiment and place on the sweep
  std::filesystem::path folder;
  double expected_s = 0;  ///< CPU time, a guess (expected_cpu_s)
};

/// A plan as who looks at it needs it.
struct PlanOverview {
  std::string source_hash, version;  ///< of the program that wrote it
  std::filesystem::path out;
  std::vector<PlannedRun> runs;
};

/// Writes the experiments as they are now: the texts of their configs with overrides, where results go, and
/// each run. Throws RunFileError.
void write_plan(const std::filesystem::path& file, const std::vector<Experiment>& experiments,
                const std::filesystem::path& out);

/// Throws RunFileError for a file that is none.
PlanOverview read_plan(const std::filesystem::path& file);

/// The experiments of a plan, and its folder of results. Throws RunFileError if the plan was written by
/// another program, or if a file that a run reads was changed since: a run would not be the planned one.
struct Plan {
  std::vector<Experiment> experiments;
  std::filesystem::path out;
};
Plan load_plan(const std::filesystem::path& file);

}  // namespace bendlab
