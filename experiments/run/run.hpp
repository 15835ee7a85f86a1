// Executes one run (a point of a sweep), from its config to its file. Reads no command line and prints
// nothing.
#pragma once

#include <filesystem>

#include "bendlab/scene/start_after.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// Computes a run, or reads its file if the run is complete. While this process computes, it locks the run's
/// folder (folder_lock.hpp): a second process waits until the run is complete. A file that was changed, or
/// that belongs to another run, is set aside. A run that was stopped or killed, or whose machine lost power,
/// continues from its last checkpoint, and gives the same bits.
///
/// If config.starts_at_end_of is set, the run starts from `start`. The references of the run are computed
/// below <out>/<experiment>, and their time is not counted. Throws MeshError, RunFileError, and NoRoom before
/// anything is allocated. A run that diverges is no error, but an outcome.
RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control = {},
                       const StartingPose* start = nullptr);

}  // namespace bendlab
