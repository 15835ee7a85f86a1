// Constraints that depend on the mesh alone, and the masses of the mesh.
#pragma once

#include <vector>

#include "bendlab/constraints/lists.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// One strain constraint per triangle, in mesh order. A triangle gets no constraint if all its corners are
/// pinned or if it is `off` (#T; empty: no triangle is).
StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest,
                                     const std::vector<char>& off = {});

/// #T: whether a triangle is degenerate and all its vertices also have a triangle that is not degenerate.
/// Then the degenerate triangle needs no strain constraint (BadTriangles::membrane_off).
std::vector<char> dispensable_triangles(const RestMesh& rest);

/// The membrane of mass-spring cloth: a spring at rest along every edge with a free end, in mesh order.
DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins);

/// #V masses, kg: `density` (kg/m²) times a third of the area of each adjacent triangle. A vertex that only
/// has degenerate triangles gets 1/100 of the mean mass, because a vertex that moves needs a mass.
std::vector<double> lumped_masses(const RestMesh& rest, double density);

}  // namespace bendlab
