// The obstacles of a run as surfaces.
#pragma once

#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/config/run_config.hpp"
#include "experiments/export/surface.hpp"

namespace bendlab {

/// The obstacles among a run's effects, where they are at time 0. Round ones have 96 corners around, which
/// lie on their surface. A plane is a square of 4 `size` below or beside `centre`, those of the cloth's rest
/// box. Mesh obstacles are read from `inputs`, the files in the run file. A spin is not there: it turns a
/// round shape into itself. `notes` receives why an obstacle is left out.
std::vector<Surface> obstacle_surfaces(const std::vector<Effect>& effects,
                                       const std::vector<InputFile>& inputs, const Vector3& centre,
                                       double size, std::vector<std::string>& notes);

}  // namespace bendlab
