// What is wrong with runs, or doubtful, before they are computed.
#pragma once

#include <span>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// Prints each warning of an experiment once, with the first run that has it.
void tell_warnings(std::span<const CampaignRun> runs);

/// What is known of runs before they are computed.
struct KnownBefore {
  std::size_t warnings = 0;
  int exit_code = 0;  ///< of the first run that cannot be built
};

/// Builds all that the runs have before their first step (set_up.hpp), once for those that are built alike,
/// what takes least first. Prints warnings, and why a run cannot be built, each once per experiment. Unless
/// `all` are asked for, stops after ten seconds, and says how many were built.
KnownBefore look_before(const std::vector<Experiment>& experiments, bool all);

}  // namespace bendlab
