#include "bendlab/effects/revolved.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace bendlab {
namespace {

constexpr int around = 96;   // corners on a circle
constexpr int quarter = 24;  // edges on a quarter of a circle

}  // namespace

std::vector<ProfilePoint> arc(double radius, int first, int last) {
  std::vector<ProfilePoint> points;
  for (int i = first * quarter; i <= last * quarter; ++i) {
    const double angle = std::numbers::pi / 2 * i / quarter;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

TriangleMesh revolved(const std::vector<ProfilePoint>& profile, const Vector3& origin, const Vector3& axis) {
  const Vector3 right = axis.unitOrthogonal(), forward = axis.cross(right);
  const int rings = static_cast<int>(profile.size()) - 2, bottom = rings * around, top = bottom + 1;
  TriangleMesh mesh{Positions(top + 1, 3), Triangles(2 * around * rings, 3), {}};
  mesh.positions.row(bottom) = origin + profile.front()[1] * axis;
  mesh.positions.row(top) = origin + profile.back()[1] * axis;
  int t = 0;
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      const auto [radius, height] = profile[static_cast<std::size_t>(ring) + 1];
      const int here = ring * around + i, beside = ring * around + (i + 1) % around;
      mesh.positions.row(here) =
          origin + radius * (std::cos(angle) * right + std::sin(angle) * forward) + height * axis;
      if (ring == 0) mesh.triangles.row(t++) << bottom, beside, here;
      if (ring == rings - 1) {
        mesh.triangles.row(t++) << here, beside, top;
      } else {
        mesh.triangles.row(t++) << here, beside, beside + around;
        mesh.triangles.row(t++) << here, beside + around, here + around;
      }
    }
  return mesh;
}

}  // namespace bendlab
