// Exact geometric predicates; CGAL is behind them.
#pragma once

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Whether three points lie on one line, exactly (no rounding). They have to be finite.
bool exactly_collinear(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace bendlab
