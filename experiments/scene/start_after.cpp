#include "experiments/scene/start_after.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "experiments/scene/pose_transfer.hpp"

namespace bendlab {
namespace {

constexpr const char* pointer = "/initial/after";

// Where the run ends.
Positions end_of(const RunConfig& config, const Scene& scene, const std::atomic<bool>* stop) {
  const std::int64_t steps = step_count(config);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (std::int64_t step = 0; step < steps && !simulation->settled(); ++step) {
    if (stop && stop->load(std::memory_order_relaxed)) break;
    if (!simulation->step())
      throw std::runtime_error(fmt::format("{}: the run before this one diverged at t = {:.6g} s", pointer,
                                           simulation->divergence().time));
  }
  return simulation->positions();
}

}  // namespace

std::int64_t step_count(const RunConfig& config) {
  constexpr double rounding = 1e-6;  // of a step: 1 s of 1/60 s is 60 steps, whatever the quotient rounds to
  const double duration = config.section("").number("duration"), dt = config.section("/solver").number("dt");
  return static_cast<std::int64_t>(std::ceil(duration / dt - rounding));
}

void start_after(const RunConfig& config, Scene& scene, const std::atomic<bool>* stop) {
  const std::optional<RunConfig> before = run_before(config);
  if (!before) return;
  Scene first = build_scene(*before);
  start_after(*before, first, stop);
  const Positions pose = end_of(*before, first, stop);
  start_from(scene, {first.rest, pose}, pointer);
}

void start_from(Scene& scene, const StartingPose& start, const std::string& pointer) try {
  const Positions pose = PoseTransfer(start.rest, scene.rest)(start.positions);
  for (int v = 0; v < scene.rest.vertex_count(); ++v)
    if (!scene.pins.pinned(v)) scene.input.positions.row(v) = pose.row(v);
  scene.input.starting_from =
      same_rest_positions(start.rest, scene.rest) ? StartingFrom::same_mesh : StartingFrom::other_mesh;
} catch (const std::invalid_argument& error) {
  throw ConfigError("initial pose", {{pointer, error.what()}});
}

}  // namespace bendlab
