#include "experiments/terminal/signals.hpp"

#include <signal.h>
#include <unistd.h>

#include <string_view>

namespace bendlab {
namespace {

// A signal handler may touch lock-free atomics only.
std::atomic<bool> stop{false};
std::atomic<int> stop_signal{0};
std::atomic<bool> terminal{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void handle(int signal) {
  if (stop.exchange(true)) _exit(128 + signal);
  stop_signal = signal;
  // On a terminal the current line already shows a progress bar and ^C, so the text begins with a new line.
  constexpr std::string_view text =
      "\nbendlab: stopping after the current frame (interrupt again to stop at once)\n";
  const std::string_view line = terminal ? text : text.substr(1);
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace

void catch_stop_signals() {
  terminal = isatty(STDERR_FILENO) != 0;
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& stop_flag() {
  return stop;
}

int stop_exit_code() {
  return stop_signal == 0 ? 0 : 128 + stop_signal;
}

}  // namespace bendlab
