// Whether three points lie on one line.
#pragma once

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Exact: CGAL computes the answer without rounding. The points have to be finite.
bool exactly_collinear(const Vector3& a, const Vector3& b, const Vector3& c);

/// Whether the triangle's smallest height is at most `thickness` (m); false if a coordinate is NaN. A
/// triangle has zero area if `thickness` may be zero_area_thickness times the mesh's size.
bool collinear_within(double thickness, const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace bendlab
