// Forecasts the memory, disk space and time of a run, before anything is allocated for it.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "experiments/config/run_config.hpp"

namespace bendlab {

struct Forecast {
  double memory_bytes = 0;  ///< peak of a process that computes only this run
  double disk_bytes = 0;    ///< of the run file
  double cpu_s = 0;         ///< CPU time, on a processor like that of results/performance
  double set_up_s = 0;      ///< the part of cpu_s before the first step
  double constraints = 0;   ///< bending constraints
  std::string advice;       ///< which setting lowers the largest part of the memory
};

/// Forecasts from the settings alone. Memory and disk space are right within 20 % (measured:
/// tests/experiments/forecast_test.cpp); time depends on the machine. Nothing if the mesh cannot be made.
std::optional<Forecast> forecast(const RunConfig& config);

/// Memory that the processes of a control group may still take, bytes; infinite without a limit. `group`:
/// folder of the control group (cgroup version 2). Memory in which the system caches files counts as free.
double left_in_group(const std::filesystem::path& group);

/// Memory that this process may still take, bytes: limited by the machine, its control group, and its own
/// limit.
double available_memory();

/// Thrown if the machine has too little memory for a run.
class NoRoom : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws NoRoom, with the memory that the run needs, the memory that is available, and the setting to
/// change. Allows runs that need up to 10 % more than the available memory, because a forecast is not exact.
void require_memory(const RunConfig& config);

/// Like require_memory(); also throws RunFileError if the run file does not fit on the disk of `folder`.
void require_room(const RunConfig& config, const std::filesystem::path& folder);

/// "1.2 GB".
std::string bytes_text(double bytes);

/// "3 s", "2.5 h".
std::string duration_text(double seconds);

}  // namespace bendlab
