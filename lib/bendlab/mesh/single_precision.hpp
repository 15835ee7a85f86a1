// Whether coordinates survive single precision, which rounds them by up to 2⁻²⁴ of their distance from 0.
#pragma once

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// The largest rounding error of a coordinate, in mean edges, that files in single precision may have. A
/// strain is then off by less than 10⁻³ on edges of a tenth of the mean.
inline constexpr double tolerated_rounding = 1e-4;

/// Whether single precision would round a coordinate by more than `tolerated_rounding` mean edges: the mesh
/// is farther from the origin than about 1700 of its edges.
bool needs_double(const Positions& positions, const Triangles& triangles);

/// A point with round coordinates near the middle of the mesh's box. Each coordinate is a whole multiple of a
/// power of ten that is at most the box's longest side. Relative to this point, the mesh's coordinates are
/// about as small as its box.
Vector3 round_centre(const Positions& positions);

}  // namespace bendlab
