// Cuts a polygon into triangles: concave, not quite flat, with corners on a straight edge.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// More corners than this take minutes to cut; a fan has no limit.
inline constexpr std::size_t most_corners_cut = 10000;

/// Cuts a polygon (at least three finite corners) into triangles of its corners' numbers, which face as it
/// does. It need not be flat: it is cut as it looks along its mean normal (Newell's). No triangle is thinner
/// than `thickness` (m), where the polygon allows that.
///
/// `triangles` stay empty if a fan around the first corner does: all of it faces one way and none is thin; or
/// the polygon has no area. Throws std::invalid_argument without a place for a polygon that crosses itself,
/// and for one of more than most_corners_cut corners that is no fan.
void cut_polygon(std::span<const Vector3> corners, double thickness,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace bendlab
