#include "bendlab/mesh/material_coordinates.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::material_coordinates_test {
using Catch::Matchers::WithinAbs;

namespace {

Vector3 corner(const TriangleMesh& mesh, Eigen::Index t, int c) {
  return mesh.positions.row(mesh.triangles(t, c)).transpose();
}

// Warp and weft axis in space: the columns of F = P Q⁻¹ for the rest shape.
Eigen::Matrix<double, 3, 2> axes(const TriangleMesh& mesh, Eigen::Index t, const InverseRest& q) {
  Eigen::Matrix<double, 3, 2> p;
  p << corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 0);
  Eigen::Matrix2d inverse;
  inverse << q[0], q[1], q[2], q[3];
  return p * inverse;
}

}  // namespace

TEST_CASE("the warp projected onto a tube is orthonormal in every triangle", "[mesh]") {
  for (const TriangleMesh& mesh : {tube(0.3, 0.3, 1, 12), tube(0.6, 0.1, 0.7, 9)})
    for (const Vector3& warp : {Vector3(1, 0, 0), Vector3(0, 0, 5), Vector3(1, 2, 3)}) {
      const std::vector<InverseRest> inverses = inverse_rest_from_warp(mesh, warp);
      for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
        const auto f = axes(mesh, t, inverses[static_cast<std::size_t>(t)]);
        // Lengths near 0.1 m come from coordinates near 1 m and have a relative rounding of 10⁻¹⁵, in a few
        // operations.
        CHECK_THAT((f.transpose() * f - Eigen::Matrix2d::Identity()).norm(), WithinAbs(0, 1e-13));
        CHECK(warp.dot(f.col(0)) > 0);
        CHECK_THAT(warp.normalized().dot(f.col(1)), WithinAbs(0, 1e-13));  // the projection is the warp axis
      }
    }
}

TEST_CASE("the warp along a tube has the slope of the tube's side", "[mesh]") {
  const TriangleMesh mesh = tube(0.6, 0.1, 0.7, 60);
  const std::vector<InverseRest> inverses = inverse_rest_from_warp(mesh, Vector3::UnitZ());
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    // Triangles are tilted against the cone by about π / (2√3 · 60), 0.015.
    CHECK_THAT(axes(mesh, t, inverses[static_cast<std::size_t>(t)])(2, 0),
               WithinAbs(0.7 / std::hypot(0.7, 0.5), 0.02));
}

TEST_CASE("if the warp is normal to a triangle, its first edge is used instead", "[mesh]") {
  const TriangleMesh mesh = tube(0.3, 0.3, 1, 12);
  for (const Eigen::Index t : {0, 1, 40}) {
    const Vector3 e1 = corner(mesh, t, 1) - corner(mesh, t, 0), e2 = corner(mesh, t, 2) - corner(mesh, t, 0);
    const InverseRest q = inverse_rest_from_warp(mesh, e1.cross(e2))[static_cast<std::size_t>(t)];
    CHECK_THAT((axes(mesh, t, q).col(0) - e1.normalized()).norm(), WithinAbs(0, 1e-13));
  }
}

TEST_CASE("the gradient of a stretch is exactly zero at a corner that the stretch does not depend on",
          "[mesh]") {
  // If the warp runs along the tube, a triangle's side on a circle of the tube is weft. Then the weft stretch
  // does not depend on the third corner. If its gradient there were a rounding error and the side were
  // pinned, the corner would fly off to infinity.
  for (const TriangleMesh& mesh : {tube(0.45, 0.13, 0.3, 120), tube(0.3, 0.3, 1, 12)}) {
    const std::vector<InverseRest> inverses = inverse_rest_from_warp(mesh, Vector3::UnitZ());
    for (const InverseRest& q : inverses)
      for (const int column : {0, 1}) {
        const double b = q[static_cast<std::size_t>(column)], c = q[static_cast<std::size_t>(2 + column)];
        // The parts of a generic stretch are of the same order, in float and in double.
        const double least = 1e-4 * std::max(std::abs(b), std::abs(c));
        for (const double part : {b, c, static_cast<double>(static_cast<float>(b) + static_cast<float>(c))})
          CHECK((part == 0 || std::abs(part) > least));
      }
  }
}

}  // namespace bendlab::material_coordinates_test
