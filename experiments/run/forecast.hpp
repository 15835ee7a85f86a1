// What a run will need, before anything is allocated for it.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "experiments/config/run_config.hpp"

namespace bendlab {

struct Forecast {
  double memory_bytes = 0;  ///< of the process at its peak, with nothing else in it
  double disk_bytes = 0;    ///< of the run file
  double cpu_s = 0;         ///< CPU time, on a processor like that of results/performance
  double set_up_s = 0;      ///< the part of it before the first step
  double constraints = 0;   ///< of bending
  std::string advice;       ///< which setting lowers the largest part of the memory
};

/// From the settings alone, within 20 % of memory and disk (measured: tests/experiments/forecast_test.cpp);
/// time depends on the machine. Nothing if the mesh cannot be made.
std::optional<Forecast> forecast(const RunConfig& config);

/// Memory that processes of a control group (version 2, its folder) may still take, bytes; infinite without a
/// limit. Files that the system keeps for them in memory are no obstacle: it drops those first.
double left_in_group(const std::filesystem::path& group);

/// Memory that this process may still take, bytes: of the machine, of its control group, and its own limit.
double available_memory();

/// A run that the machine has no room for.
class NoRoom : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws NoRoom with the memory that the run needs, what there is, and the setting to change. A tenth too
/// much is let through, because a forecast is no measurement.
void require_memory(const RunConfig& config);

/// The same, and RunFileError for the disk. `folder`: where the run file goes.
void require_room(const RunConfig& config, const std::filesystem::path& folder);

/// "1.2 GB".
std::string bytes_text(double bytes);

/// "3 s", "2.5 h".
std::string duration_text(double seconds);

}  // namespace bendlab
