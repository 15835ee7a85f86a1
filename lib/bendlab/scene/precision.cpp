#include "bendlab/scene/precision.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {

bool RoundingSpeed::single_suffices() const {
  // The largest allowed ratio rounded / gained. Measured in single precision on sheets of 1.4 m, 0.2 kg and
  // 12 cells, on a plane and on tethers: with 16, 64, 256 and 1024 substeps the ratio is 0.008, 0.13, 2 and
  // 32. Sheets that should be at rest then move at 0.008, 0.02, 0.1 and 0.3 mm/s (rms), but not in double
  // precision. The motion is too small to be seen in positions and strains.
  constexpr double of_speeds = 10;
  // With friction, the largest allowed ratio rounded · projections / gained. Friction depends on how far
  // gravity pushes a vertex into an obstacle. A sheet of 1 m that slides down an incline moves by a wrong
  // distance: 2 % at a ratio of 0.25, 7 % at 1, and 150 % at 4. At 0.85 and 0.98 of the static limit and a
  // ratio of 0.06, a sheet slides, with 6 projections per substep and with 1, but not in double precision.
  constexpr double of_friction = 0.01;
  return !matters || gained == 0 ||
         !(friction ? rounded * projections > of_friction * gained : rounded > of_speeds * gained);
}

bool RoundingSpeed::whole_suffices() const {
  // The largest allowed ratio rounded / gained. Measured with whole positions on a strip of 1 m with known
  // membrane stiffness, and on cantilevers of 9 cm (three models, 12 and 24 cells). Elongation and drop
  // differ from double precision by less than 0.0006 below a ratio of 0.01, and by 0.006 at 0.2.
  constexpr double most = 0.01;
  return rounded <= most * gained;
}

RoundingSpeed rounding_speed(const BuiltScene& scene) {
  const SolverSettings& solver = scene.input.settings;
  const double substep = solver.dt / solver.substeps;
  RoundingSpeed speed{
      .rounded = double{std::numeric_limits<float>::epsilon()} * scene.rest.size() / substep,
      .gained = gravity_of(scene.effects).norm() * substep,
      .matters = true,
      .projections = static_cast<double>(projections_per_substep(scene.input)),
      .friction = std::ranges::any_of(scene.effects, [](const Effect& e) { return e.kind().uses_contacts; })};
  const bool in_doubt = scene.input.method.kind().make_float != nullptr && !speed.single_suffices();
  speed.matters = in_doubt && (!scene.input.method.kind().keeps_moves_apart || moves_vertices(scene));
  return speed;
}

bool RoundingStrain::single_suffices() const {
  // The largest allowed ratio rounded / of_weight. A curtain of 0.4 m at rest, with 20 iterations per step
  // (24, 48 and 96 cells, Y = 10³ to 10⁵ N/m), differs from double precision by 0.0008 of its size at a ratio
  // of 0.15, and by 0.005 to 0.01 at 0.36 to 1.5. A cloth of 0.2 mm (ratio 38) does not move at all.
  constexpr double most = 0.2;
  return !matters || !(rounded > most * of_weight);
}

RoundingStrain rounding_strain(const BuiltScene& scene) {
  const SimulationInput& input = scene.input;
  const MethodKind& method = input.method.kind();
  const double size = scene.rest.size(), compliance = input.strain_stiffness.compliance;
  const auto sum = [](const std::vector<double>& values) {
    return std::reduce(values.begin(), values.end());
  };
  const double area_density = sum(input.mass) / sum(scene.rest.areas());
  const double stated = gravity_of(scene.effects).norm(), g = stated > 0 ? stated : 9.81;
  // If a membrane error is allowed, the membrane is so soft that rounding is less than 1 % of its strain.
  const bool softened =
      method.membrane_error != nullptr && method.membrane_error(input.method.settings()) > 0;
  return {.rounded = double{std::numeric_limits<float>::epsilon()} * size / scene.rest.mean_edge_length(),
          .of_weight = compliance * area_density * g * size,
          .matters = method.make_float != nullptr && !method.keeps_moves_apart && compliance > 0 &&
                     method.membrane == Membrane::triangles && !method.needs_compliance.empty() && !softened};
}

bool single_suffices(const BuiltScene& scene) {
  return rounding_speed(scene).single_suffices() && rounding_strain(scene).single_suffices();
}

}  // namespace bendlab
