// Suspends floating-point traps (CMake option BENDLAB_TRAPS).
#pragma once

#include <cfenv>

namespace bendlab {

/// As long as the object exists, its thread may compute infinities and NaNs. For libraries that do this on
/// purpose (HDF5 converts a NaN as a fill value).
class WithoutTraps {
 public:
  WithoutTraps() { std::feholdexcept(&environment_); }
  ~WithoutTraps() { std::fesetenv(&environment_); }
  WithoutTraps(const WithoutTraps&) = delete;
  WithoutTraps& operator=(const WithoutTraps&) = delete;

 private:
  std::fenv_t environment_;
};

}  // namespace bendlab
