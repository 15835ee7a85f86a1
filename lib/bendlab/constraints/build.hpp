// Constraints that follow from the mesh alone, and the masses that go with them.
#pragma once

#include <vector>

#include "bendlab/constraints/lists.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// One strain constraint per triangle, in mesh order; a triangle with all corners pinned has none.
StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest);

/// A spring at rest along every edge of the mesh that has a free end, in mesh order: the membrane of mass-spring
/// cloth.
DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins);

/// #V masses, kg: a third of each adjacent triangle's `density` (kg/m²) times area.
std::vector<double> lumped_masses(const RestMesh& rest, double density);

}  // namespace bendlab
