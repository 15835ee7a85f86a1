// Collects warnings and broken bounds of many runs. Each kind has one text: the text of the worst run, with
// the range of the values of all runs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// One kind of text, such as a warning of one code, from several runs of an experiment.
struct CollectedText {
  /// `place` (the swept values) and `message` come from the worst run; ties go to the first run.
  std::string kind, place, message;
  int runs = 0;
  double worst = 0, mildest = 0;             ///< severities
  std::string worst_text{}, mildest_text{};  ///< the measured values there; empty if there are none
};

/// The warnings of runs of one experiment, one per code.
std::vector<CollectedText> collected_warnings(std::span<const CampaignRun> runs);

/// The bounds that runs of one experiment broke, one per bound.
std::vector<CollectedText> collected_bounds(std::span<const CampaignRun> runs);

/// "cells 64: the cloth has 0.1 % … (the worst of 12 runs: 0.1 % to 48 %)", "… (and 3 more runs)"
std::string text_of(const CollectedText& text);

}  // namespace bendlab
