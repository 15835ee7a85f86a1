// What `bendlab run` says about its runs: a line of JSON or the step plan of each, or a table per experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// {id, experiment, point, status, reused, file, config, wall_s, cpu_s, step_cpu_s, summary, passes,
/// expectations, implausible (null, or as to_json(BrokenBound)), warnings ([{code, message}]), message}.
Json run_json(const CampaignRun& run);

/// Swept values, the main numbers, those that the experiment expects, and how each run ended.
std::string run_table(std::span<const CampaignRun> runs);

/// A table for each measure that /output/measures asks for, below its name; "" if none has a number.
std::string measure_tables(std::span<const CampaignRun> runs);

/// Swept values and the main numbers, a row per run; where the time went; which expectations hold; what made
/// runs implausible, and their warnings. `runs` are those of one experiment.
std::string experiment_text(std::span<const CampaignRun> runs);

/// The same on a line, "fig5: 160 runs, 160 complete (3 reused), …", and a further line per expectation
/// that does not hold.
std::string experiment_line(std::span<const CampaignRun> runs);

/// The step plan of a run that is over: each pass, why it is there, how often it ran, what it changed, its
/// share of the time; then the listed effects that changed nothing in this run.
std::string explain_text(const CampaignRun& run);

/// Whether every expectation holds in every run that has a summary.
bool expectations_hold(std::span<const CampaignRun> runs);

}  // namespace bendlab
