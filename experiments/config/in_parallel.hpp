// Distributes many small, independent calls over all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace bendlab {

/// Calls work(i) for every i below `count`, in any order. Uses as many threads as there are cores, but at
/// most 8, and at most one, and one more for every `worth_a_thread` calls. If calls throw, rethrows the first
/// exception, and may leave out the remaining calls.
template <class Work>
void in_parallel(std::size_t count, std::size_t worth_a_thread, const Work& work) {
  constexpr std::size_t most_threads = 8, block = 64;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = std::min({most_threads, cores, 1 + count / worth_a_thread});
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;  // guards `failure`
  const auto take_blocks = [&] {
    try {
      for (std::size_t begin = next.fetch_add(block); begin < count; begin = next.fetch_add(block))
        for (std::size_t i = begin; i < std::min(begin + block, count); ++i) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      for (std::size_t t = 1; t < threads; ++t) helpers.emplace_back(take_blocks);
    } catch (const std::system_error&) {  // no more threads are available: the existing ones do the work
    }
    take_blocks();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace bendlab
