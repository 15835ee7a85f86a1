// Surfaces of revolution, which represent round obstacles in pictures.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A point of a profile: distance from the axis and height along the axis, m.
using ProfilePoint = std::array<double, 2>;

/// A part of a circle from the angle `first` to the angle `last`, in quarters of a turn; 0 is the equator.
std::vector<ProfilePoint> arc(double radius, int first, int last);

/// The surface of revolution of a profile from bottom to top. The first and the last point lie on the axis
/// and close the surface. Each of the remaining points becomes a ring of corners. Normals point outward.
TriangleMesh revolved(const std::vector<ProfilePoint>& profile, const Vector3& origin, const Vector3& axis);

}  // namespace bendlab
