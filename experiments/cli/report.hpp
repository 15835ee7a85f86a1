// What `bendlab run` says about its runs: a line of JSON per run, or a table per experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/cli/campaign.hpp"

namespace bendlab {

/// {id, experiment, point, status, reused, file, config, wall_s, cpu_s, step_cpu_s, summary, passes, expectations,
/// implausible (null, or as to_json(BrokenBound)), warnings ([{code, message}]), message}.
Json run_json(const CampaignRun& run);

/// Swept values and the main numbers, a row per run; where the time went; which expectations hold.
/// `runs` are those of one experiment.
std::string experiment_text(std::span<const CampaignRun> runs);

/// The same on a line, "fig5: 160 runs, 160 complete (3 reused), …", with a further line per expectation that
/// does not hold.
std::string experiment_line(std::span<const CampaignRun> runs);

/// A warning of an experiment: of the first run that has it, and how many do.
struct CollectedWarning {
  std::string code, place, message;
  int runs = 0;
};

/// One per code. `runs` are those of one experiment.
std::vector<CollectedWarning> collected_warnings(std::span<const CampaignRun> runs);

/// "units: cells 64: the cloth is … (and 3 more runs)"
std::string text_of(const CollectedWarning& warning);

/// Whether every expectation holds in every run that has a summary.
bool expectations_hold(std::span<const CampaignRun> runs);

/// The run's place on the sweep, "cells 64, model crossover"; its experiment's name where nothing is swept.
std::string place_text(const CampaignRun& run);

/// The run's experiment and place, "fig5 (cells 64, model crossover)".
std::string run_text(const CampaignRun& run);

/// Headings for the swept values: last part of each pointer, or all of it where two would be alike.
std::vector<std::string> axis_headings(const Experiment& experiment);

/// The run's values under axis_headings(), empty where an axis does not apply to it.
std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config);

}  // namespace bendlab
