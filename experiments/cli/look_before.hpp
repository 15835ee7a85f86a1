// Finds errors and warnings of runs before the runs are computed.
#pragma once

#include <span>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// Prints each warning of an experiment once, with the first run that has it.
void tell_warnings(std::span<const CampaignRun> runs);

/// What is known about runs before they are computed.
struct KnownBefore {
  std::size_t warnings = 0;
  int exit_code = 0;  ///< of the first run that cannot be built; 0 if every run can
};

/// Builds the scene of each run (set_up.hpp), only once for runs with the same scene, and the smallest first.
/// Prints warnings, and why runs cannot be built, each text once per experiment. Leaves out
/// scenes of more than 500 MB, begins no scene after ten seconds, and prints how many scenes were built; with
/// `all`, builds every scene.
KnownBefore look_before(const std::vector<Experiment>& experiments, bool all);

}  // namespace bendlab
