// Constraints that follow from the mesh alone, and the masses that go with them.
#pragma once

#include <vector>

#include "bendlab/constraints/lists.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// One strain constraint per triangle, in mesh order; a triangle with all corners pinned has none, nor has
/// one that is switched `off` (#T, or empty: none is).
StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest,
                                     const std::vector<char>& off = {});

/// #T: the degenerate triangles whose vertices all have a strain constraint without them
/// (BadTriangles::membrane_off).
std::vector<char> dispensable_triangles(const RestMesh& rest);

/// A spring at rest along every edge of the mesh that has a free end, in mesh order: the membrane of
/// mass-spring cloth.
DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins);

/// #V masses, kg: a third of each adjacent triangle's `density` (kg/m²) times area. A vertex of degenerate
/// triangles alone, which have none to give, gets 1/100 of the mean: nothing that moves is without mass.
std::vector<double> lumped_masses(const RestMesh& rest, double density);

}  // namespace bendlab
