// What advise reads off a run: its error, its strain, and what it cost.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

inline constexpr double frames_per_second = 60;  ///< costs are told per frame of 1/60 s

/// What a run says about its setting.
struct Measured {
  std::optional<double> error, gap, strain;
  double cpu_s = 0;  ///< per frame
  std::string why;   ///< why there is no error
  bool failed = false, diverged = false;
  bool unfinished = false;    ///< it was stopped, and nothing else is known
  double kinetic_energy = 0;  ///< at the end, J
  double stretch = 1;         ///< largest of a triangle, in the motion or at the end
  bool implausible = false;
  std::vector<Warning> warnings;  ///< of the run
};

/// Root mean square of the Green strain at the end of a run, or its mean over the frames; infinite if it is
/// not finite.
double strain_in(const std::filesystem::path& file, bool over_time);

/// The largest stretch of a triangle at the end of a run, or in any frame; at least 1.
double stretch_in(const std::filesystem::path& file, bool over_time);

/// Steps that were too short to be timed are simulated again.
Measured measured_by(const CampaignRun& run);

}  // namespace bendlab
