// Finds points that lie so near to each other that they are meant to be the same point.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bendlab {

/// #P: the point that replaces each point: the nearest earlier kept point within `tolerance` (m). If there is
/// no such point, the point itself is kept. So all points that are united lie within the tolerance of the
/// kept point. Points that are not `used` stay as they are; `used` points have to be finite.
std::vector<std::size_t> near_points(const std::vector<std::array<double, 3>>& points,
                                     const std::vector<char>& used, double tolerance);

}  // namespace bendlab
