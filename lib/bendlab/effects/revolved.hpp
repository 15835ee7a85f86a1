// Surfaces of revolution, by which round obstacles are drawn.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A point of a profile: its distance from the axis and its height along it, m.
using ProfilePoint = std::array<double, 2>;

/// A part of a circle, from one angle to another, both in quarters of a turn; 0 is the equator.
std::vector<ProfilePoint> arc(double radius, int first, int last);

/// The surface of revolution of a profile from bottom to top. The first and last point lie on the axis and
/// close the surface; every other point becomes a ring of corners. Normals point outward.
TriangleMesh revolved(const std::vector<ProfilePoint>& profile, const Vector3& origin, const Vector3& axis);

}  // namespace bendlab
