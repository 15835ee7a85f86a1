// The hinges of a mesh as other engines' formulas need them, and means over all directions of bending.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "bendlab/bending/unit_bend.hpp"

namespace bendlab {

/// An interior edge of a rest mesh, with its two triangles.
struct MeshHinge {
  double edge;    ///< length, m
  double area;    ///< of both triangles together, m²
  double height;  ///< of a triangle over the edge, mean of the two triangles, m
  double mobility = 0;  ///< Σ |∂θ/∂x|² / (a third of the adjacent triangles' area) over four vertices, 1/m⁴
  QuadraticForm fold{};  ///< θ/κ, m, in the sheet bent to a cylinder of curvature κ
};

/// One per interior edge between triangles with an area. If the rest shape is not flat, `fold` refers to
/// directions in the hinge, unfolded into a plane. Throws std::invalid_argument if there is none.
std::vector<MeshHinge> mesh_hinges(const RestMesh& rest);

struct DirectionalMean {
  double mean = 0;
  /// The least and the largest value of a direction; empty if the rest shape is not flat, because then the
  /// hinges have no common direction.
  std::optional<std::pair<double, double>> range{};
};

/// Σ stiffness (θ/κ)^power / area over all hinges, averaged over all directions of bending.
DirectionalMean directional_mean(const RestMesh& rest,
                                 const std::function<double(const MeshHinge&)>& stiffness, int power = 2);

}  // namespace bendlab
