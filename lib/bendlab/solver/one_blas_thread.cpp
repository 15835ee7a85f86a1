#include "bendlab/solver/one_blas_thread.hpp"

#include <dlfcn.h>

namespace bendlab {

void one_blas_thread() {
  using SetThreads = void (*)(int);
  static const auto set_threads =
      reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  static const bool once = (set_threads ? set_threads(1) : void(), true);
  static_cast<void>(once);
}

}  // namespace bendlab
