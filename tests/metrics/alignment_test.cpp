#include "bendlab/metrics/alignment.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::alignment_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double rounding = 1e-12;  // m: about a hundred additions of numbers near 1

Positions moved(const Positions& positions, const Eigen::Matrix3d& linear, const Vector3& by) {
  return (positions * linear.transpose()).rowwise() + by.transpose();
}

Eigen::Matrix3d turn() {
  return Eigen::AngleAxisd(2.2, Vector3(1, -2, 3).normalized()).toRotationMatrix();
}

}  // namespace

TEST_CASE("alignment: the distance to a moved sheet and to the mirror image of a flat sheet is zero",
          "[metrics]") {
  const RestMesh rest(delaunay(2, 1, 12, 3));
  const Alignment alignment(rest);
  CHECK_THAT(alignment.distance(rest.positions()), WithinAbs(0, rounding));
  CHECK_THAT(alignment.distance(moved(rest.positions(), turn(), {3, 4, 5})), WithinAbs(0, rounding));
  // A flat sheet turned over about the y axis is its mirror image in x.
  CHECK_THAT(alignment.distance(moved(rest.positions(), Vector3(-1, 1, 1).asDiagonal(), {0, 0, 0})),
             WithinAbs(0, rounding));
}

TEST_CASE("alignment: a mirrored solid keeps the distance that no rotation removes", "[metrics]") {
  // The covariance of a ball's mirror image has the singular values s, s, s', one of them with the wrong
  // sign. The best rotation leaves 4 Σ x² along the axis of the smallest extent. The octahedral ball is the
  // same along x, y and z, so this is 4/3 r².
  const double radius = 0.5;
  const RestMesh rest(sphere(radius, 6));
  const double mirrored =
      Alignment(rest).distance(moved(rest.positions(), -Eigen::Matrix3d::Identity(), {1, 2, 3}));
  CHECK_THAT(mirrored, WithinRel(radius * std::sqrt(4.0 / 3), 1e-9));
}

TEST_CASE("alignment: the distance after a uniform stretch has a closed form", "[metrics]") {
  // After a stretch by s about the centre, each vertex is away by (s - 1) times its distance from the centre.
  // No rotation helps.
  const RestMesh rest(grid(2, 1, 8, 4));
  const Eigen::RowVector3d mean = rest.positions().colwise().mean();
  const double spread = std::sqrt((rest.positions().rowwise() - mean).rowwise().squaredNorm().mean());
  const Positions stretched = moved(1.3 * rest.positions(), turn(), {0, 0, 9});
  CHECK_THAT(Alignment(rest).distance(stretched), WithinRel(0.3 * spread, 1e-12));

  TriangleMesh triangle;
  triangle.positions = (Positions(3, 3) << 0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0).finished();
  triangle.triangles = (Triangles(1, 3) << 0, 1, 2).finished();
  // Corners of an equilateral triangle are 1/√3 of its edge from its centre.
  CHECK_THAT(Alignment(RestMesh(triangle)).distance(moved(1.3 * triangle.positions, turn(), {0, 0, 9})),
             WithinRel(0.3 / std::sqrt(3.0), 1e-12));
}

TEST_CASE("alignment: parts that no edge joins are aligned independently", "[metrics]") {
  const RestMesh rest(with_flaw(grid(1, 1, 8, 8), "pieces"));
  Positions torn = rest.positions(), apart = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const bool of_the_right_seam = v >= 81;  // the copies come last
    if (of_the_right_seam) torn(v, 2) += 5;
    if (of_the_right_seam || rest.position(v).x() > 1e-9) apart(v, 2) += 5;
  }
  CHECK(Alignment(rest).distance(torn) > 0.1);
  CHECK_THAT(Alignment(rest).distance(apart), WithinAbs(0, rounding));

  const RestMesh lonely(with_flaw(grid(1, 1, 8, 8), "isolated_vertices"));
  Positions away = lonely.positions();
  away.bottomRows(5).array() += 100;
  CHECK_THAT(Alignment(lonely).distance(away), WithinAbs(0, rounding));
}

TEST_CASE("alignment: the distance to positions with NaN is NaN", "[metrics]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  Positions broken = rest.positions();
  broken(4, 1) = std::nan("");
  CHECK(std::isnan(Alignment(rest).distance(broken)));
}

}  // namespace bendlab::alignment_test
