// `bendlab run --explain`: what a scene's step consists of, and which parts of it did nothing.
#pragma once

#include <string>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// The step plan of a run that is over: each pass, why it is there, how often it ran, what it changed, its
/// share of the time; then the listed effects that changed nothing in this run.
std::string explain_text(const CampaignRun& run);

}  // namespace bendlab
