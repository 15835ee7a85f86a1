#include "experiments/precision.hpp"

#include <limits>

#include "experiments/energy.hpp"
#include "experiments/scene.hpp"

namespace bendlab {

bool RoundingSpeed::single_suffices() const {
  // Measured on a sheet that comes to rest on a plane, and on one on tethers: see tests/experiments/precision_test.cpp.
  constexpr double most = 0.1;
  return !matters || !(rounded > most * gained) || gained == 0;
}

RoundingSpeed rounding_speed(const Scene& scene) {
  const SolverSettings& solver = scene.input.settings;
  const double substep = solver.dt / solver.substeps;
  RoundingSpeed speed{.rounded = double{std::numeric_limits<float>::epsilon()} * scene.rest.size() / substep,
                      .gained = gravity_of(scene.effects).norm() * substep};
  const bool in_doubt = solver.method != Method::equilibrium && !RoundingSpeed{speed.rounded, speed.gained, true}.single_suffices();
  speed.matters = in_doubt && (solver.method == Method::kang_cho || moves_vertices(scene));
  return speed;
}

}  // namespace bendlab
