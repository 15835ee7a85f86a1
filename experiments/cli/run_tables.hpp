// The tables of an experiment's runs: a row per run.
#pragma once

#include <span>
#include <string>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// Swept values, the main numbers, those that the experiment expects, and how each run ended.
std::string run_table(std::span<const CampaignRun> runs);

/// A table for each measure that /output/measures asks for, below its name; "" if none has a number.
std::string measure_tables(std::span<const CampaignRun> runs);

}  // namespace bendlab
