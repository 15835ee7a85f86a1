// What differs between two runs: their settings, their numbers, their cloths.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// A setting that differs; null where one run does not have it.
struct ChangedSetting {
  std::string pointer;
  Json one, other;
};

/// A number that differs.
struct ChangedNumber {
  std::string name;
  std::optional<double> one, other;
  std::optional<double> relative;  ///< other / one - 1, where both are there and one is not 0
};

struct RunDifference {
  std::vector<ChangedSetting> settings;
  std::vector<ChangedNumber> summary;  ///< the largest relative change first
  std::map<std::string, double>
      cloth;             ///< of measures/trajectory.hpp, over all common frames; in sizes of the mesh
  std::string no_cloth;  ///< why the cloths cannot be compared; empty: they were
  std::vector<std::string> differing_parts;  ///< of the files, to the bit; empty: the same
};

/// Throws RunFileError.
RunDifference difference(const RunRecord& one, const RunRecord& other);

}  // namespace bendlab
