// One run: a point of a sweep, from its config to its file. Knows no command line and prints nothing.
#pragma once

#include <filesystem>

#include "bendlab/scene/start_after.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// Computes a run, or reads it if it is complete. While it is computed its folder is claimed (claim.hpp): who
/// comes second waits, and finds it complete. A file that was changed, or is another run's, is set aside. A
/// run that was stopped, killed, or lost its power goes on from its last checkpoint, and gives the same bits.
///
/// With config.starts_at_end_of it starts from `start`. The references that it is compared with are made
/// below <out>/<experiment>; their time is not the run's. Throws MeshError, RunFileError, and
/// NoRoom before anything is allocated; a run that diverges is an outcome.
RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control = {},
                       const StartingPose* start = nullptr);

}  // namespace bendlab
