// Steps a run until it ends, comes to rest, is stopped or diverges, and records its frames.
#pragma once

#include <optional>
#include <string>

#include "bendlab/io/frame_writer.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/run/plausibility.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run.hpp"

namespace bendlab {

struct Stepping {
  RunStatus status = RunStatus::complete;
  std::string message;  ///< where it diverged, why it stopped, what is not balanced
  double cpu_s = 0;     ///< of the steps alone
  std::optional<double> settled_at = std::nullopt;  ///< s
};

/// Records the first pose and then /output/frames_per_second; measures and verdict look at every step. Throws
/// RunFileError if frames can't be written.
Stepping step_to_end(Simulation& simulation, const Scene& scene, Recorder& recorder,
                     Plausibility& plausibility, FrameWriter& writer, const RunConfig& config,
                     const RunControl& control);

}  // namespace bendlab
