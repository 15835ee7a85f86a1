#include "experiments/scene/precision.hpp"

#include <limits>

#include "bendlab/solver/method.hpp"
#include "experiments/scene/gravity.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

bool RoundingSpeed::single_suffices() const {
  // Sheets of 1.4 m, 0.2 kg and 12 cells on a plane, and on tethers, in single precision: with 16, 64, 256
  // and 1024 substeps the ratio is 0.008, 0.13, 2 and 32, and at rest they still move at 0.008, 0.02, 0.1 and
  // 0.3 mm/s (rms; in double they do not). Their positions and strains do not show it.
  constexpr double most = 10;
  return !matters || !(rounded > most * gained) || gained == 0;
}

bool RoundingSpeed::whole_suffices() const {
  // A strip of known membrane stiffness, 1 m long, and cantilevers of 9 cm (three models, 12 and 24 cells)
  // with rounded positions differ from double precision in elongation and drop by less than 0.0006 where the
  // ratio is below 0.01; at 0.2 by 0.006.
  constexpr double most = 0.01;
  return rounded <= most * gained;
}

RoundingSpeed rounding_speed(const Scene& scene) {
  const SolverSettings& solver = scene.input.settings;
  const double substep = solver.dt / solver.substeps;
  RoundingSpeed speed{.rounded = double{std::numeric_limits<float>::epsilon()} * scene.rest.size() / substep,
                      .gained = gravity_of(scene.effects).norm() * substep};
  const bool in_doubt = scene.input.method->make_float != nullptr &&
                        !RoundingSpeed{speed.rounded, speed.gained, true}.single_suffices();
  speed.matters = in_doubt && (!scene.input.method->keeps_moves_apart || moves_vertices(scene));
  return speed;
}

}  // namespace bendlab
