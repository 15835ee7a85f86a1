// What a run needs: memory, disk space and work, estimated before anything is allocated for the run.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "experiments/config/run_config.hpp"

namespace bendlab {

struct Needs {
  double vertices = 0;
  double springs = 0;       ///< of the bending model; 0 for models with few of them
  double memory_bytes = 0;  ///< peak of a process that computes only this run
  double disk_bytes = 0;    ///< of the run file
};

/// Estimates from the settings alone; tests/trust/needs.py compares them with runs. Memory is within a factor
/// of 2 for the registered models and methods. Nothing if the mesh cannot be made.
std::optional<Needs> needs_of(const RunConfig& config);

/// A crude estimate of a run's work, to order runs: vertices × substeps × iterations × steps. It is not a
/// time. Compare it only between runs with the same model and method.
double crude_work(const RunConfig& config);

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
/// change.
void require_memory(const RunConfig& config);

/// Like require_memory(); also throws RunFileError if the run file does not fit on the disk of `folder`.
void require_room(const RunConfig& config, const std::filesystem::path& folder);

/// "1.2 GB".
std::string bytes_text(double bytes);

/// "3 s", "2.5 h".
std::string duration_text(double seconds);

}  // namespace bendlab
