// Gusts: smooth noise in time, added to a steady wind. A seed gives the same bits on every machine.
#pragma once

#include <cstdint>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Each component is a separate value noise: independent uniform values at whole multiples of `time`,
/// interpolated by 3 x² - 2 x³. A component has the mean 0 and the standard deviation `deviation` over time,
/// and is at most 2.01 times the deviation. Values at least 2 `time` apart are independent.
struct Gusts {
  double deviation = 0;  ///< m/s
  double time = 1;       ///< s
  std::uint64_t seed = 0;

  Vector3 at(double seconds) const;  ///< m/s; also at negative times; NaN beyond 2⁶² times `time`
};

}  // namespace bendlab
