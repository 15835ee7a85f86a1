// What differs between two runs: settings, metrics and the motion of the cloth.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// A setting that differs. For a run without the setting, the value is null.
struct ChangedSetting {
  std::string pointer;
  Json one, other;
};

/// A metric that differs.
struct ChangedNumber {
  std::string name;
  std::optional<double> one, other;
  std::optional<double> relative;  ///< other / one - 1, if both runs have the metric and `one` is not 0
};

struct RunDifference {
  std::vector<ChangedSetting> settings;
  std::vector<ChangedNumber> summary;  ///< the largest relative change first
  std::map<std::string, double>
      cloth;             ///< distances (measures/trajectory.hpp) over all common frames, in sizes of the mesh
  std::string no_cloth;  ///< why the cloths cannot be compared; empty if they were compared
  std::vector<std::string> differing_parts;  ///< parts of the files whose bits differ; empty if none does
};

/// Throws RunFileError.
RunDifference difference(const RunRecord& one, const RunRecord& other);

}  // namespace bendlab
