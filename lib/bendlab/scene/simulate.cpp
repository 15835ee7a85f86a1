#include "bendlab/scene/simulate.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "bendlab/scene/rules.hpp"
#include "bendlab/scene/start_after.hpp"

namespace bendlab {

Cloth::Cloth(BuiltScene scene)
    : scene_(std::make_unique<BuiltScene>(std::move(scene))), simulation_(simulation_of(*scene_)) {}

void Cloth::step() {
  if (simulation_->step()) return;
  const Divergence& where = simulation_->divergence();
  throw std::runtime_error(
      fmt::format("the cloth diverged at t = {:.6g} s, first at vertex {}: use more substeps, or another "
                  "method",
                  where.time, where.vertex));
}

void Cloth::run(double seconds) {
  constexpr double rounding = 1e-6;  // of a step
  const double end = time() + seconds, dt = scene_->input.settings.dt;
  while (time() < end - rounding * dt && !simulation_->settled()) step();
}

Cloth simulate(Scene scene) {
  settle(scene);
  ConfigProblems problems;
  check_ranges(scene, problems);
  check_unread(scene, problems);
  check_scene(scene, problems);
  if (!problems.empty()) throw ConfigError("the scene", std::move(problems));
  BuiltScene built = build_scene(scene);
  start_after(scene, built);
  return Cloth(std::move(built));
}

}  // namespace bendlab
