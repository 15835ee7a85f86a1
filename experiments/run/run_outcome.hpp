// The outcome of a run.
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
  bool differs = false;  ///< `minimal` changed a bit: it left out an effect that acts
  bool reused = false;   ///< the file was complete already; nothing was computed
  bool left = false;     ///< left to another process, which is computing it
  std::filesystem::path file;
  std::optional<BrokenBound> broken{};  ///< why the run is implausible; also if it diverged after that
  std::vector<Warning> warnings{};
  std::string message;  ///< where and when the run diverged, how to resume it, …; may be empty
  double wall_s = 0, cpu_s = 0;
  double step_cpu_s = 0;  ///< CPU time of the steps alone, without set-up and recording
  std::map<std::string, double> summary;
  std::vector<PassTime> passes;
};

}  // namespace bendlab
