// The directions of a sheet's warp as the fit of stiffnesses needs them: at hinges, at pairs of vertices, and
// in the sheet's plane.
#pragma once

#include <array>
#include <vector>

#include "bendlab/bending/directed_rigidity.hpp"
#include "bendlab/bending/stiffness_fit.hpp"
#include "bendlab/bending/triangle_lookup.hpp"

namespace bendlab {

class WarpField {
 public:
  /// `directed` is null if the sheet's rigidity does not depend on the direction. Arguments are kept by
  /// reference.
  WarpField(const RestMesh& rest, const DirectedSheet* directed);

  bool matters() const { return directed_ != nullptr; }

  /// B(φ) divided by its mean, for the angles of all_bending_directions() to the warp; 1 if the direction
  /// does not matter.
  const ByDirection& shape() const { return shape_; }

  // The functions below are for sheets in which the direction matters.

  /// The vertices of a hinge, unfolded into a plane whose x axis is the mean warp of the hinge's triangles.
  std::array<Vector2, 4> unfolded_along_warp(const std::array<int, 4>& hinge) const;

  // The functions below are for flat sheets. Directions are in plane_coordinates().

  /// `d` is relative to the mean warp at the vertices a and b. Returns the same direction in the plane.
  Vector2 in_plane(int a, int b, const Vector2& d) const;

  /// B in a direction divided by the mean of B over all directions, averaged over the sheet's area. 1 if the
  /// direction does not matter.
  double relative(const Vector2& direction) const;

  /// Whether the warp has the same direction everywhere.
  bool is_uniform() const { return !matters() || (!plane_.empty() && all_.agreement() > 1 - 1e-9); }
  /// The mean direction of the warp; (1, 0) if the direction does not matter.
  Vector2 axis() const { return all_.mean(); }

 private:
  const RestMesh& rest_;
  const DirectedSheet* directed_;
  ByDirection shape_ = all_alike();
  TriangleLookup find_;
  std::vector<Vector2> plane_;     // #V; empty if the sheet is not flat
  std::vector<Vector2> in_plane_;  // #T, the warp in the plane
  std::vector<AxisSum> at_vertex_;
  AxisSum all_;
};

}  // namespace bendlab
