// Cuts a polygon into triangles. It may be concave, not quite flat, and have corners on a straight edge.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Polygons with more corners are refused, because cutting them would take minutes. A fan may have any number
/// of corners.
inline constexpr std::size_t most_corners_cut = 10000;

/// Cuts a polygon (at least three finite corners) into triangles that face the same side as the polygon. A
/// triangle is three indices into `corners`. The polygon need not be flat: it is cut as seen along its mean
/// normal (Newell's). If the polygon allows it, no triangle is thinner than `thickness` (m).
///
/// `triangles` stays empty if a fan around the first corner is good enough (all its triangles face the same
/// side and none is thin), or if the polygon has no area. Throws std::invalid_argument for a polygon that
/// crosses itself, and for a polygon of more than most_corners_cut corners that is no fan. The caller adds to
/// the text where the polygon is in its file.
void cut_polygon(std::span<const Vector3> corners, double thickness,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace bendlab
