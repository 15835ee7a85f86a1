// The positions of a constraint's corners.
#pragma once

#include <array>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Rows of `positions` (#V by 3) for the N vertices.
template <std::size_t N>
std::array<Vector3, N> corners(const Positions& positions, const std::array<int, N>& vertices) {
  std::array<Vector3, N> p;
  for (std::size_t i = 0; i < N; ++i) p[i] = positions.row(vertices[i]).transpose();
  return p;
}

}  // namespace bendlab
