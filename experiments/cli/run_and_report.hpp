// Computing experiments and telling what came of it, as `run` and `reproduce` do.
#pragma once

#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// How the runs are reported on stdout.
enum class Report { tables, lines, json, explanations };

/// Runs them; prints an experiment as soon as its last run is over, or each run as a line of JSON. Runs that
/// were not started because of a signal are left out. `strict`: warnings are errors. Returns the exit code.
int run_and_report(const std::vector<Experiment>& experiments, CampaignOptions options, Report report,
                   bool strict = false);

}  // namespace bendlab
