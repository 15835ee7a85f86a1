#include "bendlab/solver/one_blas_thread.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <new>

namespace bendlab {
namespace {

// OpenBLAS allocates its working memory in its first call. If there is no memory, OpenBLAS retries for ever.
// So this function tests first whether there is memory.
void require_working_memory() {
  constexpr std::size_t enough = std::size_t{192} << 20;  // a buffer takes 32 to 128 MiB of address space
  void* const there =
      mmap(nullptr, enough, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (there == MAP_FAILED) throw std::bad_alloc();
  munmap(there, enough);
}

}  // namespace

void one_blas_thread() {
  using SetThreads = void (*)(int);
  static const auto set_threads =
      reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  static const bool once = (require_working_memory(), set_threads ? set_threads(1) : void(), true);
  static_cast<void>(once);
}

}  // namespace bendlab
