// Aligns poses: finds the rigid motion or the rotation that brings a pose nearest to another pose, and the
// distance of a cloth from its rest shape apart from a rigid motion.
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

/// The rigid motion (no reflection) with the least Σ weight |moved from - to|² (Kabsch 1976). `from` and `to`
/// are #V by 3 in m, `weight` is #V and not negative.
RigidMotion nearest_motion(const Positions& from, const Positions& to, std::span<const double> weight);

/// The same, but only among the rotations about the line through `centre` along `axis` (unit length).
RigidMotion nearest_turn(const Positions& from, const Positions& to, std::span<const double> weight,
                         const Vector3& centre, const Vector3& axis);

/// Compares poses with a rest shape, after the rotation and translation that bring the rest shape nearest to
/// the pose (Kabsch 1976). Reflections are not allowed, so a mirrored shape keeps a distance. Parts of the
/// mesh that share no edge move independently, so each part is aligned by itself. Vertices in no triangle do
/// not count.
class Alignment {
 public:
  explicit Alignment(const RestMesh& rest);

  /// Root mean square over the vertices of the remaining distance, m; NaN if a position is not finite.
  double distance(const Positions& positions) const;

 private:
  Positions rest_;
  std::vector<std::vector<int>> parts_;  // vertices
};

}  // namespace bendlab
