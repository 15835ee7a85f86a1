// The part of a run file before the first frame: mesh, pins, constraints with their hashes, provenance.
#pragma once

#include <string>

#include "bendlab/io/run_file.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/recorder.hpp"

namespace bendlab {

RunHeader header_of(const Experiment& experiment, const RunConfig& config, const std::string& id,
                    const BuiltScene& scene, const Simulation& simulation, const Recorder& recorder);

}  // namespace bendlab
