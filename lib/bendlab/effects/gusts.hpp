// Gusts: smooth noise in time about a steady wind, the same bits for the same seed on every machine.
#pragma once

#include <cstdint>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Each component is its own value noise: independent uniform values at whole multiples of `time`, between
/// them joined by 3 x² - 2 x³. Its mean is 0, its standard deviation over time `deviation`; it never exceeds
/// 2.01 deviations, and values two `time`s or more apart are independent.
struct Gusts {
  double deviation = 0;  ///< m/s
  double time = 1;       ///< s
  std::uint64_t seed = 0;

  Vector3 at(double seconds) const;  ///< m/s; any time, negative ones too
};

}  // namespace bendlab
