#include "bendlab/bending/warp_field.hpp"

#include <Eigen/Dense>

#include "bendlab/bending/unit_bend.hpp"
#include "bendlab/mesh/bad_triangles.hpp"

namespace bendlab {
namespace {

// A vector in coordinates along an axis and across it.
Vector2 in_axis(const Vector2& axis, const Vector2& v) {
  return {axis.dot(v), axis.x() * v.y() - axis.y() * v.x()};
}

// The inverse of in_axis().
Vector2 out_of_axis(const Vector2& axis, const Vector2& v) {
  return {axis.x() * v.x() - axis.y() * v.y(), axis.y() * v.x() + axis.x() * v.y()};
}

}  // namespace

WarpField::WarpField(const RestMesh& rest, const DirectedSheet* directed) : rest_(rest), directed_(directed) {
  if (!matters()) return;
  find_ = TriangleLookup(rest);
  shape_ = in_all_directions(
      [&](const Vector2& d) { return directed->rigidity.cylinder(d) / directed->rigidity.mean(); });
  const std::vector<char> degenerate = triangles_without_area(rest.mesh());
  plane_ = plane_coordinates(rest);
  at_vertex_.resize(plane_.size());
  in_plane_.assign(degenerate.size(), Vector2::Zero());
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto at = static_cast<std::size_t>(t);
    if (degenerate[at] != 0) continue;
    const auto corner = rest.triangles().row(t);
    if (plane_.empty()) continue;
    // The warp as a sum of the triangle's edges, in space and then in the plane.
    Eigen::Matrix<double, 3, 2> edges;
    Eigen::Matrix2d flat;
    for (int i = 0; i < 2; ++i) {
      edges.col(i) = rest.position(corner(i + 1)) - rest.position(corner(0));
      flat.col(i) =
          plane_[static_cast<std::size_t>(corner(i + 1))] - plane_[static_cast<std::size_t>(corner(0))];
    }
    const Eigen::Vector2d parts =
        (edges.transpose() * edges).inverse() * (edges.transpose() * directed->warp[at]);
    in_plane_[at] = (flat * parts).normalized();
    all_.add(in_plane_[at], rest.areas()[at]);
    for (const int v : corner) at_vertex_[static_cast<std::size_t>(v)].add(in_plane_[at], rest.areas()[at]);
  }
}

std::array<Vector2, 4> WarpField::unfolded_along_warp(const std::array<int, 4>& hinge) const {
  std::array<Vector3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = rest_.position(hinge[i]);
  const Vector3 edge = (p[1] - p[0]).normalized();
  AxisSum sum;
  for (const std::size_t side : {2U, 3U}) {
    const int found = find_(hinge[0], hinge[1], hinge[side]);
    if (found < 0) continue;
    const Vector3 offset = p[side] - p[0], across = (offset - offset.dot(edge) * edge).normalized(),
                  &warp = directed_->warp[static_cast<std::size_t>(found)];
    sum.add({warp.dot(edge), (side == 2 ? 1 : -1) * warp.dot(across)});
  }
  std::array<Vector2, 4> flat = unfolded(p);
  for (Vector2& q : flat) q = in_axis(sum.mean(), q);
  return flat;
}

Vector2 WarpField::in_plane(int a, int b, const Vector2& d) const {
  AxisSum both;
  for (const int v : {a, b}) both.add(at_vertex_[static_cast<std::size_t>(v)].mean());
  return out_of_axis(both.mean(), d);
}

double WarpField::relative(const Vector2& direction) const {
  if (!matters()) return 1;
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < in_plane_.size(); ++t) {
    if (in_plane_[t].isZero(0)) continue;
    sum += rest_.areas()[t] * directed_->rigidity.cylinder(in_axis(in_plane_[t], direction));
    area += rest_.areas()[t];
  }
  return sum / area / directed_->rigidity.mean();
}

}  // namespace bendlab
