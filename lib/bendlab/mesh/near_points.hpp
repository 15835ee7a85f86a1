// Points that lie so near to each other that they are meant to be one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bendlab {

/// #P: the nearest earlier point within `tolerance` (m) that stays itself, or else the point itself. So all
/// points that become one lie within the tolerance of it. Points that are not `used` stay themselves; the
/// others have to be finite.
std::vector<std::size_t> near_points(const std::vector<std::array<double, 3>>& points,
                                     const std::vector<char>& used, double tolerance);

}  // namespace bendlab
