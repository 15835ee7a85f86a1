// Transfers poses from one mesh of a flat sheet to another mesh of the same sheet.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Whether two meshes have the same vertices at the same positions, to the bit.
bool same_rest_positions(const RestMesh& first, const RestMesh& second);

/// Interpolates linearly in the rest plane, and extrapolates linearly beyond the outline; the two outlines
/// may differ by an edge length or two. Between meshes with the same rest positions a pose is copied to the
/// bit.
class PoseTransfer {
 public:
  /// Throws std::invalid_argument if the meshes differ and are not meshes of the same flat sheet.
  PoseTransfer(const RestMesh& from, const RestMesh& to);

  /// `pose` #V of `from` by 3 → #V of `to` by 3, m.
  Positions operator()(const Positions& pose) const;

 private:
  struct Place {
    std::array<int, 3> corner;
    std::array<double, 3> weight;  // sum 1; outside the triangle there are negative weights
  };
  std::vector<Place> places_;  // #V of `to`; empty: the meshes are the same
};

}  // namespace bendlab
