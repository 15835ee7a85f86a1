// Finds points that are so near to each other that they count as the same point.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace bendlab {

/// #P: the index of the point that replaces each point. A point is replaced by the nearest earlier point that
/// is not replaced itself, if the two are at most `tolerance` (m) apart. Otherwise the point keeps its own
/// index, as all points that are not `used` do. `used` points have to be finite.
std::vector<std::size_t> near_points(const std::vector<std::array<double, 3>>& points,
                                     const std::vector<char>& used, double tolerance);

}  // namespace bendlab
