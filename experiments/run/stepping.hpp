// Steps a run until it ends, comes to rest, is stopped or diverges, and records its frames.
#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/io/frame_writer.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/run/checkpoint.hpp"
#include "experiments/run/plausibility.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run_control.hpp"

namespace bendlab {

/// Thrown if a checkpoint does not fit the run that should continue from this checkpoint.
class Unresumable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Time that a run took, in this process and in earlier processes.
class RunClock {
 public:
  RunClock();
  double wall_s() const;
  double thread_cpu_s() const;  ///< CPU time of the thread that steps
  /// CPU time of the thread that writes frames; `now` is the thread's time in this process.
  double recording_s(double now) const { return earlier_recording_s_ + now; }
  /// Simulated times at which the run continued from a checkpoint, s.
  const std::vector<double>& went_on_at() const { return went_on_at_; }
  void go_on(double time) { went_on_at_.push_back(time); }
  void archive(Archive& state, double recording_now);

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double thread_start_s_, earlier_wall_s_ = 0, earlier_thread_s_ = 0, earlier_recording_s_ = 0;
  std::vector<double> went_on_at_;
};

struct Stepping {
  RunStatus status = RunStatus::complete;
  std::string message;  ///< where the run diverged or stopped
  double cpu_s = 0;     ///< CPU time of the steps alone
  std::uint64_t frames = 0;
  std::optional<double> settled_at = std::nullopt;  ///< s
};

/// The objects that change while a run is stepped.
struct RunAtWork {
  Simulation& simulation;
  Recorder& recorder;
  Plausibility& plausibility;
  FrameWriter& writer;
  Checkpoints& checkpoints;
  RunClock& clock;
};

/// Records the first pose, then /output/frames_per_second frames per second. Measures and plausibility checks
/// are called after every step. `saved`: the checkpoint from which the run continues, or null; its frames are
/// in the writer's file. Throws RunFileError if frames can't be written, Unresumable if `saved` does not fit
/// the run.
Stepping step_to_end(const RunAtWork& run, const BuiltScene& scene, const RunConfig& config,
                     const RunControl& control, const Checkpoint* saved);

}  // namespace bendlab
