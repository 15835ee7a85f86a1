// Constraints that depend on the mesh alone, and the masses of the mesh.
#pragma once

#include <vector>

#include "bendlab/constraints/lists.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// One strain constraint per triangle, in mesh order. A triangle gets no constraint if all its corners are
/// pinned, or if `off` (#T) is true for the triangle. If `off` is empty, no triangle is off. `factor` (#T, or
/// empty: 1): on the stiffness.
StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest,
                                     const std::vector<char>& off = {},
                                     const std::vector<double>& factor = {});

/// #T: whether a triangle is degenerate and each of its vertices also belongs to a triangle that is not
/// degenerate. Such a degenerate triangle needs no strain constraint (BadTriangles::membrane_off).
std::vector<char> dispensable_triangles(const RestMesh& rest);

/// The membrane of mass-spring cloth: a spring at rest along every edge that has a free end, in mesh order.
DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins);

/// #V masses, kg: `density` (kg/m²) times a third of the area of each adjacent triangle. A vertex that has
/// only degenerate triangles gets 1/100 of the mean mass, because every free vertex needs a mass. `factor`
/// (#T, or empty: 1): on the density.
std::vector<double> lumped_masses(const RestMesh& rest, double density,
                                  const std::vector<double>& factor = {});

}  // namespace bendlab
