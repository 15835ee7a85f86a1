#include "experiments/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <numeric>
#include <string>

#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {
constexpr int bar_width = 24;
constexpr std::string_view clear_line = "\r\x1b[K";
}  // namespace

Progress::Progress(std::vector<double> costs)
    : costs_(std::move(costs)),
      fraction_(costs_.size(), 0.0),
      simulated_of_(costs_.size(), 0.0),
      visible_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (visible_) fmt::print(stderr, "{}", clear_line);
}

void Progress::update(std::size_t index, double done_s, double total_s) {
  const std::lock_guard lock(mutex_);
  simulated_s_ += done_s - simulated_of_[index];
  simulated_of_[index] = done_s;
  fraction_[index] = total_s > 0 ? done_s / total_s : 1.0;
  draw();
}

void Progress::finish(std::size_t index, bool computed) {
  const std::lock_guard lock(mutex_);
  fraction_[index] = 1;
  if (!computed) reused_cost_ += costs_[index];
  ++finished_;
  draw();
}

void Progress::message(std::string_view text) {
  pause([&] { print_text(stderr, "bendlab: {}\n", text); });
}

void Progress::pause(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  if (visible_) fmt::print(stderr, "{}", clear_line);
  print();
  drawn_ = {};
  draw();
}

void Progress::draw() {
  using namespace std::chrono_literals;
  const Clock::time_point now = Clock::now();
  if (!visible_ || now - drawn_ < 100ms) return;
  drawn_ = now;

  const double all = std::accumulate(costs_.begin(), costs_.end(), 0.0);
  const double done = std::inner_product(costs_.begin(), costs_.end(), fraction_.begin(), 0.0);
  const double share = all > 0 ? done / all : 1.0;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double computed = done - reused_cost_;
  const int filled = static_cast<int>(std::lround(share * bar_width));
  std::string line = fmt::format(
      "[{}{}] {:3.0f} %  runs {}/{}", std::string(static_cast<std::size_t>(filled), '#'),
      std::string(static_cast<std::size_t>(bar_width - filled), '-'), 100 * share, finished_, costs_.size());
  if (elapsed > 0.5) line += fmt::format("  {:.2g} simulated s/s", simulated_s_ / elapsed);
  if (elapsed > 0.5 && computed > 0)
    line += fmt::format("  {} left", format_duration(elapsed * (all - done) / computed));
  fmt::print(stderr, "{}{}", clear_line, line);
  std::fflush(stderr);
}

}  // namespace bendlab
