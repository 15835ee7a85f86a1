#include "bendlab/scene/start_after.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/pose_transfer.hpp"
#include "bendlab/scene/scene_json.hpp"

namespace bendlab {
namespace {

constexpr const char* pointer = "/initial/after";

// The positions at the end of the scene.
Positions end_of(const Scene& scene, const BuiltScene& built, const std::atomic<bool>* stop) {
  const std::int64_t steps = step_count(scene);
  const std::unique_ptr<Simulation> simulation = simulation_of(built);
  for (std::int64_t step = 0; step < steps && !simulation->settled(); ++step) {
    if (stop && stop->load(std::memory_order_relaxed)) break;
    if (!simulation->step())
      throw std::runtime_error(fmt::format("{}: the earlier run diverged at t = {:.6g} s", pointer,
                                           simulation->divergence().time));
  }
  return simulation->positions();
}

// Applies a change "/json/pointer=value" to the settings. A value that is not JSON is used as a text.
void change(Json& settings, const std::string& text, ConfigProblems& problems) try {
  const std::size_t equals = text.find('=');
  const std::string place = text.substr(0, equals);
  if (equals == std::string::npos || !place.starts_with('/')) {
    problems.push_back({"", fmt::format("'{}' is not of the form /json/pointer=value", text)});
    return;
  }
  ConfigProblems no_json;
  const std::optional<Json> value = read_strict_json(text.substr(equals + 1), no_json);
  if (!set_at(settings, place, no_json.empty() && value ? *value : Json(text.substr(equals + 1))))
    problems.push_back({place, "the scene has no setting at this pointer"});
} catch (const Json::parse_error&) {
  problems.push_back({"", fmt::format("'{}': the text before '=' is not a JSON pointer", text)});
}

}  // namespace

std::int64_t step_count(const Scene& scene) {
  constexpr double rounding = 1e-6;  // of a step: 1 s of 1/60 s is 60 steps, whatever the quotient rounds to
  return static_cast<std::int64_t>(std::ceil(scene.duration / scene.solver.dt - rounding));
}

std::optional<Scene> earlier_scene(const Scene& scene) {
  if (!scene.initial.after) return std::nullopt;
  Scene changed = scene;
  changed.initial.after.reset();
  Json settings = to_json(changed);
  ConfigProblems problems;
  for (const std::string& text : *scene.initial.after) change(settings, text, problems);
  Scene earlier = read_scene(settings, {}, problems);
  if (!problems.empty()) throw ConfigError("the earlier run", std::move(problems));
  earlier.folder = scene.folder;
  return earlier;
}

void start_after(const Scene& scene, BuiltScene& built, const std::atomic<bool>* stop) {
  const std::optional<Scene> earlier = earlier_scene(scene);
  if (!earlier) return;
  BuiltScene first = build_scene(*earlier);
  start_after(*earlier, first, stop);
  const Positions pose = end_of(*earlier, first, stop);
  start_from(built, {first.rest, pose}, pointer);
}

void start_from(BuiltScene& scene, const StartingPose& start, const std::string& pointer) try {
  const Positions pose = PoseTransfer(start.rest, scene.rest)(start.positions);
  for (int v = 0; v < scene.rest.vertex_count(); ++v)
    if (!scene.pins.pinned(v)) scene.input.positions.row(v) = pose.row(v);
  scene.input.starting_from =
      same_rest_positions(start.rest, scene.rest) ? StartingFrom::same_mesh : StartingFrom::other_mesh;
} catch (const std::invalid_argument& error) {
  throw ConfigError("initial pose", {{pointer, error.what()}});
}

}  // namespace bendlab
