// Aligns poses: finds the rigid motion, or the rotation about an axis, that brings a pose nearest to another
// pose. Also measures how far a cloth is from a rigidly moved rest shape.
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

/// The rigid motion M, without reflection, with the least Σ weight |M(from) - to|² (Kabsch 1976). `from` and
/// `to` are #V by 3 in m, `weight` is #V and not negative.
RigidMotion nearest_motion(const Positions& from, const Positions& to, std::span<const double> weight);

/// Like nearest_motion(), but only rotations about the line through `centre` along `axis` (unit length) are
/// allowed.
RigidMotion nearest_turn(const Positions& from, const Positions& to, std::span<const double> weight,
                         const Vector3& centre, const Vector3& axis);

/// Compares poses with a rest shape that is first rotated and moved as near to the pose as possible (Kabsch
/// 1976). Reflections are not allowed, so a mirrored pose has a distance above 0. Each connected part of the
/// mesh is aligned separately, because the parts move independently. Vertices in no triangle do not count.
class Alignment {
 public:
  explicit Alignment(const RestMesh& rest);

  /// Distance of the vertices from the aligned rest shape, m, as a root mean square; NaN if a position is not
  /// finite.
  double distance(const Positions& positions) const;

 private:
  Positions rest_;
  std::vector<std::vector<int>> parts_;  // vertices
};

}  // namespace bendlab
