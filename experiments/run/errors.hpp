// The exit codes of the program, and which error leads to which exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace bendlab {

/// The meaning of the program's exit code. A command stopped by a signal gives 128 + the signal's number.
enum ExitCode : int {
  exit_ok = 0,
  exit_failed = 1,  ///< a run or an expectation failed, or a run is implausible
  exit_usage = 2,
  exit_config = 3,
  exit_mesh = 4,
  exit_io = 5,
  exit_numerical = 6,  ///< a run diverged
};

/// Arguments that contradict each other, or that name something that does not exist. Exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Problems of one or more configs, one per line. Exit code 3.
class ConfigsError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Failure {
  int exit_code = exit_failed;
  std::string message;
};

/// Exit code and text of the current exception. To be called inside a catch block.
Failure current_failure();

}  // namespace bendlab
