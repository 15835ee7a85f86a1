// Poses brought over each other: the rigid motion or the turn that brings one nearest to another, and how far
// a cloth is from its rest shape, wherever it has gone and however it has turned.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// x → rotation x + translation (m).
struct RigidMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3 translation = Vector3::Zero();

  Positions moved(const Positions& positions) const {
    return (positions * rotation.transpose()).rowwise() + translation.transpose();
  }
};

/// The rigid motion (no reflection) with the least Σ weight |moved from - to|² (Kabsch 1976); `from` and `to`
/// #V by 3 in m, `weight` #V, not negative.
RigidMotion nearest_motion(const Positions& from, const Positions& to, std::span<const double> weight);

/// The same among the turns about the line through `centre` along `axis` (unit length).
RigidMotion nearest_turn(const Positions& from, const Positions& to, std::span<const double> weight,
                         const Vector3& centre, const Vector3& axis);

/// Compares poses with a rest shape after the rotation and translation that bring them nearest (Kabsch 1976;
/// without reflections: a mirrored shape stays away). Parts that no common edge joins move freely of each
/// other and are aligned each by itself; vertices in no triangle do not count.
class Alignment {
 public:
  explicit Alignment(const RestMesh& rest);

  /// Root mean square over the vertices of the distance that is left, m; NaN where a position is not finite.
  double distance(const Positions& positions) const;

 private:
  Positions rest_;
  std::vector<std::vector<int>> parts_;  // vertices
};

}  // namespace bendlab
