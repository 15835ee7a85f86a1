// Whether single precision, which rounds a number x by up to 2⁻²⁴ |x|, is accurate enough for coordinates.
#pragma once

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// The largest rounding error of a coordinate, in mean edge lengths, that files in single precision may have.
/// Even on an edge of a tenth of the mean length, a strain is then wrong by less than 10⁻³.
inline constexpr double tolerated_rounding = 1e-4;

/// Whether single precision would round a coordinate by more than `tolerated_rounding` mean edge lengths. A
/// mesh needs double if it reaches farther from the origin than about 1700 mean edge lengths.
bool needs_double(const Positions& positions, const Triangles& triangles);

/// A point with round coordinates near the middle of the mesh's box: multiples of the largest power of ten
/// that is not longer than the box. Relative to this point, coordinates are about as small as the box.
Vector3 round_centre(const Positions& positions);

}  // namespace bendlab
