// What is known of a run's mesh before it is made.
#pragma once

#include <optional>

#include "bendlab/bending/expected.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Of a generated mesh from its settings, of a file's by reading it, once for all runs that share it. Nothing
/// for a mesh that cannot be made: the run itself says why.
std::optional<ExpectedMesh> expected_mesh(const RunConfig& config);

}  // namespace bendlab
