// A time limit: a flag that is set when it is over, or a signal comes.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "experiments/terminal/signals.hpp"

namespace bendlab {

class TimeLimit {
 public:
  explicit TimeLimit(double seconds)
      : end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))),
        watch_([this](const std::stop_token& done) {
          while (!done.stop_requested() && !over_) {
            over_ = stop_flag() || left_s() <= 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          }
        }) {}

  double left_s() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
  const std::atomic<bool>& over() const { return over_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
  std::atomic<bool> over_{false};
  std::jthread watch_;  // ends before what it uses
};

}  // namespace bendlab
