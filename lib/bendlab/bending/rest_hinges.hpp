// Hinges in their rest state, from which the models of the literature build their constraints.
#pragma once

#include <functional>
#include <vector>

#include "bendlab/bending/model.hpp"

namespace bendlab {

struct RestHinge {
  std::array<int, 4> vertices;      ///< p0, p1 of the shared edge, then the vertices opposite it
  std::array<Vector3, 4> position;  ///< of these vertices, m
  double angle;                     ///< θ0, 0 flat
  double edge;                      ///< |p1 - p0|, m
  double area;                      ///< of both triangles together, m²
};

/// One hinge per interior edge, in the order of the edges, if at least one of the hinge's vertices is free. A
/// hinge on a degenerate triangle (see bad_triangles.hpp) has no angle and is left out. `is_flat`: every
/// hinge has the rest angle 0, whatever the rest shape.
std::vector<RestHinge> rest_hinges(const RestMesh& rest, const Pins& pins, bool is_flat = false);

/// Angle constraints on the hinges. `softness(hinge)` gives the values of ElementList::softness.
ElementList<HingeAngle> angle_constraints(const std::vector<RestHinge>& hinges, HingeAngle::Law law,
                                          const std::function<double(const RestHinge&)>& softness);

}  // namespace bendlab
