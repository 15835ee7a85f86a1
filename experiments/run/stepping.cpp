#include "experiments/run/stepping.hpp"

#include <fmt/format.h>

#include "bendlab/io/without_traps.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/settings/archive.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/remedies.hpp"

namespace bendlab {
namespace {

// "; triangle 12 (3, 4, 9), the most stretched, is 1.2e+05 times as long as at rest", or nothing without
// strain constraints.
std::string worst_triangle_text(const Divergence& divergence, const Triangles& triangles) {
  const auto& [a, b, c] = divergence.triangle;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (triangles(t, 0) == a && triangles(t, 1) == b && triangles(t, 2) == c)
      return fmt::format("; triangle {} ({}, {}, {}), the most stretched, is {:.3g} times as long as at rest",
                         t, a, b, c, divergence.stretch);
  return "";
}

std::string divergence_message(const Divergence& divergence, const BuiltScene& scene) {
  const WithoutTraps traps_are_off;  // fmt compares the NaNs that it prints
  const std::string remedies = remedies_for(Bound::finite, scene);
  return fmt::format(
      "diverged at t = {:.6g} s: vertex {} is at ({:.3g}, {:.3g}, {:.3g}) m{}; earlier frames are kept{}{}",
      divergence.time, divergence.vertex, divergence.position.x(), divergence.position.y(),
      divergence.position.z(), worst_triangle_text(divergence, scene.rest.triangles()),
      remedies.empty() ? "" : ". In tests, this helped: ", remedies);
}

// Checks from time to time whether the cloth has come to rest. A check copies all velocities.
class Calm {
 public:
  explicit Calm(double speed) : speed_(speed) {}

  // Whether no check in the last half second found a vertex faster than `speed`.
  bool settled(const Simulation& simulation) {
    constexpr double looks_per_second = 60, calm_s = 0.5, rounding = 1e-9;
    if (speed_ == 0 || simulation.time() < next_look_ - rounding) return false;
    next_look_ = simulation.time() + 1 / looks_per_second;
    if (!(simulation.velocities().rowwise().squaredNorm().maxCoeff() <= speed_ * speed_))
      since_ = simulation.time();
    return simulation.time() - since_ >= calm_s - rounding;
  }
  double since() const { return since_; }  // s
  void archive(Archive& state) { state(next_look_, since_); }

 private:
  double speed_, next_look_ = 0, since_ = 0;
};

// CPU time that this thread and its helper threads spend in the steps.
class StepClock {
 public:
  explicit StepClock(Simulation& simulation) : simulation_(simulation) {}

  bool step() {
    const double before = thread_cpu_s();
    const bool whole = simulation_.step();
    seconds_ += thread_cpu_s() - before;
    return whole;
  }
  double seconds() const { return seconds_ + simulation_.helper_seconds(); }
  void archive(Archive& state) { state(seconds_); }

 private:
  Simulation& simulation_;
  double seconds_ = 0;
};

std::string stop_message(double time, double duration) {
  return fmt::format(
      "stopped at t = {:.6g} s of {:.6g} s, the frames so far are kept; run the same command again to "
      "continue the run",
      time, duration);
}

}  // namespace

RunClock::RunClock() : thread_start_s_(bendlab::thread_cpu_s()) {}

double RunClock::wall_s() const {
  return earlier_wall_s_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double RunClock::thread_cpu_s() const {
  return earlier_thread_s_ + bendlab::thread_cpu_s() - thread_start_s_;
}

void RunClock::archive(Archive& state, double recording_now) {
  double wall = wall_s(), thread = thread_cpu_s(), recording = recording_s(recording_now);
  state(wall, thread, recording, went_on_at_);
  if (state.reads()) earlier_wall_s_ = wall, earlier_thread_s_ = thread, earlier_recording_s_ = recording;
}

Stepping step_to_end(const RunAtWork& run, const BuiltScene& scene, const RunConfig& config,
                     const RunControl& control, const Checkpoint* saved) {
  // No structured bindings: in clang before 16, lambdas cannot capture them.
  Simulation& simulation = run.simulation;
  Recorder& recorder = run.recorder;
  Plausibility& plausibility = run.plausibility;
  FrameWriter& writer = run.writer;
  Checkpoints& checkpoints = run.checkpoints;
  RunClock& run_clock = run.clock;
  const double duration = config.scene().duration, dt = config.scene().solver.dt;
  const double frame_interval = 1 / config.settings().output.frames_per_second;
  // As a share of a step: a step records a frame even if the step ends by rounding before the frame's time.
  constexpr double rounding = 1e-6;
  const std::int64_t steps = step_count(config.scene());

  std::int64_t done = 0;
  std::uint64_t frames = 0;
  double next_frame = frame_interval;
  Calm calm(config.settings().settled_speed);
  StepClock clock(simulation);
  const auto archive = [&](Archive& state) {
    state(done, next_frame, calm, clock, simulation, recorder, plausibility);
    run_clock.archive(state, writer.cpu_s());
  };
  const auto state = [&] {
    Archive written;
    archive(written);
    return written.bytes();
  };
  const auto record = [&] {
    writer.push(recorder.capture(simulation));
    ++frames;
  };
  const auto look = [&](const Moment& moment) {
    recorder.step(simulation, moment);
    plausibility.look(simulation, moment.is_recorded);
  };
  const auto ended = [&](RunStatus status, std::string message, std::optional<double> settled_at = {}) {
    return Stepping{status, std::move(message), clock.seconds(), frames, settled_at};
  };

  if (saved) {
    try {
      Archive read(saved->state);
      archive(read);
      if (!read.at_end()) throw std::runtime_error("the checkpoint has more data than the run reads");
    } catch (const std::exception& error) {
      throw Unresumable(error.what());
    }
    frames = saved->frames;
    run_clock.go_on(simulation.time());
  } else {
    record();
    look({.is_start = true, .is_recorded = true});
  }
  for (std::int64_t step = done + 1; step <= steps; ++step) {
    if (!clock.step()) return ended(RunStatus::diverged, divergence_message(simulation.divergence(), scene));
    const double time = simulation.time();
    // A method that seeks an equilibrium has no velocities. Such a method itself reports whether the
    // equilibrium is found.
    const bool balanced = simulation.settled(),
               settled = balanced || (!simulation.unbalanced() && calm.settled(simulation));
    const bool last = step == steps || settled;
    const bool recorded = last || !(time < next_frame - rounding * dt);
    look({.is_recorded = recorded, .is_last = last});
    if (recorded) {
      while (next_frame <= time + rounding * dt) next_frame += frame_interval;
      record();
      if (control.progress) control.progress(time, duration);
    }
    if (settled) return ended(RunStatus::complete, "", balanced ? time : calm.since());
    if (last) break;
    done = step;
    checkpoints.look(frames, state);
    if (!control.stop || !control.stop->load(std::memory_order_relaxed)) continue;
    checkpoints.now(frames, state);
    if (!recorded) record();  // shows where the run stopped; a run that goes on leaves this frame out
    return ended(RunStatus::interrupted, stop_message(time, duration));
  }
  return ended(RunStatus::complete, "");
}

}  // namespace bendlab
