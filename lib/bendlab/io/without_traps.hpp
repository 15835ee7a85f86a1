// Allows invalid floating-point operations, which stop a program built with the option BENDLAB_TRAPS.
#pragma once

#include <cfenv>

namespace bendlab {

/// While the object exists, the thread may compute with NaN. HDF5 does that with its fill value.
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
