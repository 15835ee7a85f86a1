// Computes runs, and reports on them: a line of JSON per run, a step plan per run, or a table per experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// What is printed on stdout about the runs.
enum class Report { tables, lines, json, explanations };

/// Computes the runs of the experiments. Prints a report of each experiment when its last run is over, or a
/// line of JSON or a step plan for each run. Leaves out runs that were not started because of a signal.
/// `strict`: warnings are errors, and nothing is computed if there are warnings before the runs begin.
/// Returns the exit code.
int run_and_report(const std::vector<Experiment>& experiments, CampaignOptions options, Report report,
                   bool strict = false, Shard shard = {});

/// {id, experiment, point, status, reused, file, config, wall_s, cpu_s, step_cpu_s, summary, passes,
/// expectations, implausible (null, or as to_json(BrokenBound)), warnings ([{code, message}]), message}.
Json run_json(const CampaignRun& run);

/// A row per run: swept values, the main metrics, the metrics that the experiment expects, and how the run
/// ended.
std::string run_table(std::span<const CampaignRun> runs);

/// A table for each measure that /output/measures names, below the measure's name; "" without such metrics.
std::string measure_tables(std::span<const CampaignRun> runs);

/// The table of runs, the passes that took the time, the expectations, the bounds that runs broke, and the
/// warnings. `runs`: the runs of one experiment.
std::string experiment_text(std::span<const CampaignRun> runs);

/// A summary on one line, "fig5: 160 runs, 160 complete (3 reused), …", and a line per expectation that does
/// not hold.
std::string experiment_line(std::span<const CampaignRun> runs);

/// The step plan of a run that is over. For each pass: the setting that needs it, its number of calls, how
/// much it changed, its share of the time. Then the effects that changed nothing in this run.
std::string explain_text(const CampaignRun& run);

/// Whether every expectation holds in every run that has a summary.
bool expectations_hold(std::span<const CampaignRun> runs);

}  // namespace bendlab
