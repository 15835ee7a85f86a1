// How large a run is: counted on its mesh, or on a patch of it where that is large.
#pragma once

#include <optional>

#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Of the rest mesh and of the bending constraints on it. Numbers of a large mesh are estimates, near enough
/// for forecasts.
struct RunSize {
  double vertices = 0, triangles = 0;
  double size = 0;         ///< m, diagonal of the rest box
  double mean_edge = 0;    ///< m
  double constraints = 0;  ///< of bending
  double pairs = 0;        ///< those of them that join two vertices
  double reach = 0;        ///< mean length of these pairs, in mean edges
  double list_bytes = 0;   ///< of the constraints' lists
  double numbers = 0;      ///< that the solver keeps for the constraints: indices, rest values
};

/// Makes the mesh and the bending model's constraints if that is cheap. Of a larger mesh it makes a patch,
/// with edges as long, and a sample of the constraints. Remembers what it counted. Nothing for a mesh that
/// cannot be made: the run itself says why.
std::optional<RunSize> size_of(const RunConfig& config);

}  // namespace bendlab
