// Transfers poses from one mesh of a flat sheet to another mesh of the same sheet.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Whether two meshes have the same number of vertices, at exactly equal positions.
bool same_rest_positions(const RestMesh& first, const RestMesh& second);

/// Interpolates linearly in the rest plane, and extrapolates beyond the outline, because the two outlines may
/// differ by up to two edge lengths. Between meshes with equal rest positions, a pose is copied exactly.
class PoseTransfer {
 public:
  /// Throws std::invalid_argument if the meshes differ and are not two meshes of the same flat sheet.
  PoseTransfer(const RestMesh& from, const RestMesh& to);

  /// `pose` has a row for each vertex of `from`, the result for each vertex of `to`; m.
  Positions operator()(const Positions& pose) const;

 private:
  struct Place {
    std::array<int, 3> corner;
    std::array<double, 3> weight;  // with sum 1; negative weights mean a point outside
  };
  std::vector<Place> places_;  // #V of `to`; empty: the meshes are the same
};

}  // namespace bendlab
