// How large a run is: counted on its mesh, or estimated from a patch if the mesh is large.
#pragma once

#include <optional>

#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Sizes of the rest mesh and of the bending constraints on it. For a large mesh, these sizes are estimates,
/// good enough for forecasts.
struct RunSize {
  double vertices = 0, triangles = 0;
  double size = 0;         ///< m, diagonal of the rest box
  double mean_edge = 0;    ///< m
  double constraints = 0;  ///< bending constraints
  double pairs = 0;        ///< bending constraints that join two vertices
  double reach = 0;        ///< mean length of these pairs, in mean edge lengths
  double corners = 0;      ///< mean number of points of a constraint: vertices, and normals of edges
  double list_bytes = 0;   ///< memory of the constraint lists
  double own = 0;          ///< corners of elements of dkt, and of elements that a user wrote
  double directors = 0;    ///< coordinates of unknowns besides the vertices, such as the normals of mid_edge
  double numbers = 0;      ///< count of indices and rest values that the solver keeps for all constraints
};

/// Builds the mesh and the bending model's constraints if the mesh is small. For a larger mesh, builds a
/// patch with the same edge length, and a sample of the constraints. Results are cached. Returns nothing if
/// the mesh cannot be made; computing the run then gives an error with the reason.
std::optional<RunSize> size_of(const RunConfig& config);

}  // namespace bendlab
