#include "bendlab/metrics/shape_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/box_tree.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/proximity.hpp"

namespace bendlab {
namespace {

// The triangles of a mesh in a tree. Finds the distance of a point from the nearest triangle.
class Surface {
 public:
  explicit Surface(const TriangleMesh& mesh) : mesh_(mesh), tree_(centres(mesh)) {
    std::vector<Box> boxes(static_cast<std::size_t>(mesh.triangle_count()));
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const int v : mesh.triangles.row(static_cast<Eigen::Index>(t)))
        boxes[t].include(Box::around(vertex(v)));
    tree_.renew(boxes);
  }

  double squared_distance(const Vector3& point) const {
    return tree_.least_squared_distance(point, [&](int t) {
      const auto corner = mesh_.triangles.row(t);
      const Corners corners = {point, vertex(corner(0)), vertex(corner(1)), vertex(corner(2))};
      return shortest_gap(Pairing::vertex_triangle, corners).vector.squaredNorm();
    });
  }

 private:
  static Positions centres(const TriangleMesh& mesh) {
    Positions centres(mesh.triangle_count(), 3);
    for (Eigen::Index t = 0; t < centres.rows(); ++t) {
      const auto corner = mesh.triangles.row(t);
      centres.row(t) =
          (mesh.positions.row(corner(0)) + mesh.positions.row(corner(1)) + mesh.positions.row(corner(2))) / 3;
    }
    return centres;
  }

  Vector3 vertex(int v) const { return mesh_.positions.row(v).transpose(); }

  const TriangleMesh& mesh_;
  BoxTree tree_;
};

double farthest_from(const TriangleMesh& mesh, const Surface& surface) {
  std::vector<char> used(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const int v : mesh.triangles.reshaped()) used[static_cast<std::size_t>(v)] = 1;
  double squared = 0;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    if (used[static_cast<std::size_t>(v)])
      squared = std::max(squared, surface.squared_distance(mesh.positions.row(v).transpose()));
  return std::sqrt(squared);
}

// The Green strain (FᵀF - 1)/2 of a triangle, with F = [x1 - x0, x2 - x0] Q⁻¹.
Eigen::Matrix2d green_strain(const Positions& positions, const Eigen::Vector3i& corner,
                             const InverseRest& q) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << (positions.row(corner(1)) - positions.row(corner(0))).transpose(),
      (positions.row(corner(2)) - positions.row(corner(0))).transpose();
  const Eigen::Matrix2d inverse = (Eigen::Matrix2d() << q[0], q[1], q[2], q[3]).finished();
  const Eigen::Matrix<double, 3, 2> gradient = sides * inverse;
  return 0.5 * (gradient.transpose() * gradient - Eigen::Matrix2d::Identity());
}

double rms_strain(const RestMesh& rest, const Positions& pose, const Positions* reference) {
  const std::vector<InverseRest> inverse_rest = inverse_rest_from_warp(rest.mesh(), Vector3::UnitX());
  const std::vector<char> without_area = triangles_without_area(rest.mesh());
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < inverse_rest.size(); ++t) {
    if (without_area[t]) continue;
    const Eigen::Vector3i corner = rest.triangles().row(static_cast<Eigen::Index>(t)).transpose();
    Eigen::Matrix2d strain = green_strain(pose, corner, inverse_rest[t]);
    if (reference) strain -= green_strain(*reference, corner, inverse_rest[t]);
    sum += rest.areas()[t] * strain.squaredNorm();
    area += rest.areas()[t];
  }
  return area > 0 ? std::sqrt(sum / area) : 0;
}

}  // namespace

ShapeError shape_error(const Positions& pose, const Positions& reference, std::span<const double> weight) {
  double sum = 0, weights = 0, largest = 0;
  for (std::size_t v = 0; v < weight.size(); ++v) {
    if (!(weight[v] > 0)) continue;
    const auto row = static_cast<Eigen::Index>(v);
    const double squared = (pose.row(row) - reference.row(row)).squaredNorm();
    sum += weight[v] * squared, weights += weight[v];
    largest = std::max(largest, squared);
  }
  return {weights > 0 ? std::sqrt(sum / weights) : 0, std::sqrt(largest)};
}

double hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second) {
  if (first.triangle_count() == 0 || second.triangle_count() == 0)
    throw std::invalid_argument("Hausdorff distance: a surface has no triangles");
  return std::max(farthest_from(first, Surface(second)), farthest_from(second, Surface(first)));
}

double strain_error(const RestMesh& rest, const Positions& pose, const Positions& reference) {
  return rms_strain(rest, pose, &reference);
}

double strain_error(const RestMesh& rest, const Positions& pose) {
  return rms_strain(rest, pose, nullptr);
}

}  // namespace bendlab
