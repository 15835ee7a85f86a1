// The progress bar of runs that are computed at the same time. Shown on stderr, and only on a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string_view>
#include <vector>

namespace bendlab {

class Progress {
 public:
  /// `costs`: the expected work of each run, in any unit. Shows nothing if stderr is not a terminal.
  explicit Progress(std::vector<double> costs);
  ~Progress();  ///< removes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Run `index` has simulated `done_s` of `total_s` seconds. Thread-safe.
  void update(std::size_t index, double done_s, double total_s);

  /// Run `index` is over; `computed` is false if the run was already complete and so took no time.
  void finish(std::size_t index, bool computed);

  /// Prints a line on stderr, above the bar if there is a bar.
  void message(std::string_view text);

  /// Hides the bar while `print` writes to the terminal.
  void pause(const std::function<void()>& print);

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  std::mutex mutex_;
  std::vector<double> costs_, fraction_;  // per run
  double simulated_s_ = 0;                // by all runs
  std::vector<double> simulated_of_;      // per run, s
  double reused_cost_ = 0;
  std::size_t finished_ = 0;
  bool visible_;
  Clock::time_point start_ = Clock::now(), drawn_{};
};

}  // namespace bendlab
