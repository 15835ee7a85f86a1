// Repeats a run from its file alone.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

struct Repetition {
  RunOutcome outcome;
  std::vector<std::string> differing_parts;  ///< parts of the files whose bits differ; empty if none does
  /// Changes of program, compiler, libraries and machine that may explain a difference: name → (old value,
  /// new value).
  std::map<std::string, std::pair<std::string, std::string>> changed;
};

/// Computes the run again below `folder`, from the settings and input files in the run file. Throws
/// ConfigError if this program does not know the settings, MeshError and RunFileError.
Repetition repeat(const RunRecord& run, const std::filesystem::path& folder, const RunControl& control);

}  // namespace bendlab
