// What `bendlab run` says about its runs: a line of JSON per run, or a table per experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// {id, experiment, point, status, reused, file, config, wall_s, cpu_s, step_cpu_s, summary, passes,
/// expectations, implausible (null, or as to_json(BrokenBound)), warnings ([{code, message}]), message}.
Json run_json(const CampaignRun& run);

/// Swept values and the main numbers, a row per run; where the time went; which expectations hold; what made
/// runs implausible, and their warnings. `runs` are those of one experiment.
std::string experiment_text(std::span<const CampaignRun> runs);

/// The same on a line, "fig5: 160 runs, 160 complete (3 reused), …", and a further line per expectation
/// that does not hold.
std::string experiment_line(std::span<const CampaignRun> runs);

/// Whether every expectation holds in every run that has a summary.
bool expectations_hold(std::span<const CampaignRun> runs);

}  // namespace bendlab
