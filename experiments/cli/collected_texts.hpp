// What many runs have to be told of, each kind once: the worst run's text, and the range of the others.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// A text of one kind, such as a warning's code, that several runs of an experiment have.
struct CollectedText {
  std::string kind, place, message;  ///< place and message of the worst run; of equal ones the first
  int runs = 0;
  double worst = 0, mildest = 0;             ///< severities
  std::string worst_text{}, mildest_text{};  ///< the numbers that are so bad; empty if there are none
};

/// The warnings of runs of one experiment, one per code.
std::vector<CollectedText> collected_warnings(std::span<const CampaignRun> runs);

/// The bounds that runs of one experiment broke, one per bound.
std::vector<CollectedText> collected_bounds(std::span<const CampaignRun> runs);

/// "cells 64: the cloth has 0.1 % … (the worst of 12 runs: 0.1 % to 48 %)", "… (and 3 more runs)"
std::string text_of(const CollectedText& text);

}  // namespace bendlab
