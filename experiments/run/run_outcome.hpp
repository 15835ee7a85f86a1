// What came of a run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/run/broken_bound.hpp"
#include "experiments/run/warning.hpp"

namespace bendlab {

struct RunOutcome {
  std::string id;
  RunStatus status = RunStatus::complete;
  bool differs = false;  ///< `minimal` changed a bit: an effect that could not act did
  bool reused = false;   ///< the file was there and complete; nothing was computed
  bool left = false;     ///< another process is computing it, and was left to it
  std::filesystem::path file;
  std::optional<BrokenBound> broken{};  ///< why it is implausible; also of a run that diverged after that
  std::vector<Warning> warnings{};
  std::string message;  ///< where and when it diverged, how to resume, …; may be empty
  double wall_s = 0, cpu_s = 0;
  double step_cpu_s = 0;  ///< of the steps alone, without set-up and recording
  std::map<std::string, double> summary;
  std::vector<PassTime> passes;
};

}  // namespace bendlab
