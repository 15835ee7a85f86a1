#include "bendlab/scene/membrane.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

bool is_stated(const BuiltScene& scene) {
  const StrainStiffness& strain = scene.input.strain_stiffness;
  return scene.input.method.kind().projects && scene.input.strain.size() > 0 &&
         strain.kind == StiffnessKind::compliance && strain.compliance > 0;
}

}  // namespace

double courant_number(const BuiltScene& scene) {
  const SimulationInput& input = scene.input;
  const std::vector<double>& areas = scene.rest.areas();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0),
               density = std::accumulate(input.mass.begin(), input.mass.end(), 0.0) / area,
               cell = std::sqrt(2 * area / static_cast<double>(areas.size()));  // legs of a right triangle
  return std::sqrt(1 / (input.strain_stiffness.compliance * density)) * input.settings.dt /
         input.settings.substeps / cell;
}

double excess_stretch(const BuiltScene& scene) {
  if (!is_stated(scene)) return 0;
  const double courant = courant_number(scene);
  return courant * courant / projections_per_substep(scene.input);
}

bool membrane_needs_no_tethers(const BuiltScene& scene) {
  return is_stated(scene) && excess_stretch(scene) <= 1;
}

}  // namespace bendlab
