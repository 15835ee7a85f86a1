// Cuts a polygon, also if concave, slightly bent, or with corners on a straight edge, into triangles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Cutting larger polygons would take minutes. A polygon that a fan cuts may have any number of corners.
inline constexpr std::size_t most_corners_cut = 10000;

/// Cuts a polygon (at least three finite corners) into triangles that face the same side as the polygon. A
/// triangle is three indices into `corners`. A polygon that is not flat is first projected along Newell's
/// mean normal. Triangles thinner than `thickness` (m) are avoided where possible.
///
/// `triangles` stays empty if the polygon has no area, or if a fan around the first corner is good enough:
/// all triangles of the fan face the same side and none is thin. Throws std::invalid_argument for a polygon
/// that crosses itself, and for a polygon of more than most_corners_cut corners that a fan does not cut. The
/// caller adds the place in the file to the text.
void cut_polygon(std::span<const Vector3> corners, double thickness,
                 std::vector<std::array<std::size_t, 3>>& triangles);

}  // namespace bendlab
