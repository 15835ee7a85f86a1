// Splits a range over a fixed number of threads; a single thread gets the whole range. The result of a task
// must not depend on how the range is cut.
#pragma once

#include <cstddef>
#include <memory>

namespace bendlab {

class Workers {
 public:
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls task(first, last) on equal parts of [first, last), one part per thread. If `worthwhile` is false,
  /// calls task once on the whole range.
  template <class Task>
  void for_range(std::size_t first, std::size_t last, bool worthwhile, const Task& task) {
    if (threads_ == 1 || !worthwhile)
      task(first, last);
    else
      split(first, last, &task, [](const void* t, std::size_t from, std::size_t to) {
        (*static_cast<const Task*>(t))(from, to);
      });
  }

  /// Seconds of work so far, by all threads except the calling thread.
  double helper_seconds() const;

 private:
  using Call = void (*)(const void*, std::size_t, std::size_t);
  void split(std::size_t first, std::size_t last, const void* task, Call call);

  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace bendlab
