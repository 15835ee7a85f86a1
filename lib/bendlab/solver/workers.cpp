#include "bendlab/solver/workers.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace bendlab {

struct Workers::Arena {
  // More workers than cores would not be faster. The range is still cut into `threads` parts.
  explicit Arena(int threads) : arena(std::min(threads, tbb::info::default_concurrency())) {}
  tbb::task_arena arena;
  std::atomic<std::int64_t> helper_nanoseconds = 0;
};

Workers::Workers(int threads) : threads_(threads) {
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}

Workers::~Workers() = default;

void Workers::split(std::size_t first, std::size_t last, const void* task, Call call) {
  const std::size_t count = last - first, parts = std::min(count, static_cast<std::size_t>(threads_));
  const auto caller = std::this_thread::get_id();
  arena_->arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, parts,
        [&](std::size_t part) {
          const std::size_t from = first + count * part / parts, to = first + count * (part + 1) / parts;
          if (from == to) return;
          const auto start = std::chrono::steady_clock::now();
          call(task, from, to);
          if (std::this_thread::get_id() != caller)
            arena_->helper_nanoseconds +=
                std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
        },
        tbb::static_partitioner());
  });
}

double Workers::helper_seconds() const {
  return arena_ ? 1e-9 * static_cast<double>(arena_->helper_nanoseconds.load()) : 0;
}

}  // namespace bendlab
