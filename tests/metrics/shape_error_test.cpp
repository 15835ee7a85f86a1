// Distances between poses, compared with known values.
#include "bendlab/metrics/shape_error.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "bendlab/mesh/box_tree.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/metrics/alignment.hpp"
#include "tests/catch.hpp"

namespace bendlab::shape_error_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double rounding = 1e-12;  // m: about a hundred additions of numbers near 1

// A third of the area of its triangles for each vertex.
std::vector<double> shares(const RestMesh& rest) {
  std::vector<double> share(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (const int v : rest.triangles().row(t))
      share[static_cast<std::size_t>(v)] += rest.areas()[static_cast<std::size_t>(t)] / 3;
  return share;
}

Positions turned(const Positions& positions, double angle, const Vector3& axis, const Vector3& centre) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return ((positions.rowwise() - centre.transpose()) * rotation.transpose()).rowwise() + centre.transpose();
}

// A sheet that is curved everywhere.
Positions wavy(const RestMesh& rest) {
  Positions pose = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v)
    pose(v, 2) = 0.1 * std::sin(7 * pose(v, 0)) + 0.05 * pose(v, 1) * pose(v, 1);
  return pose;
}

}  // namespace

TEST_CASE("shape error: a shifted sheet has the same distance everywhere", "[metrics]") {
  const RestMesh rest(delaunay(2, 1, 12, 3));
  const Vector3 by(0.03, -0.04, 0.12);  // 0.13 m long
  const Positions shifted = rest.positions().rowwise() + by.transpose();
  const ShapeError error = shape_error(shifted, rest.positions(), shares(rest));
  CHECK_THAT(error.rms, WithinAbs(0.13, rounding));
  CHECK_THAT(error.largest, WithinAbs(0.13, rounding));
}

TEST_CASE("shape error: parts of the cloth count by their area, not by their number of vertices",
          "[metrics]") {
  // Cells of the left half are a quarter as wide as cells of the right half. Only the right half moves, by
  // its distance u from the middle. ∫ u² du over [0, 1/2] is 1/24 for a sheet of area 1.
  TriangleMesh mesh = grid(1, 1, 50, 10);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    if (double& x = mesh.positions(v, 0); x < 0.3 - 1e-9)
      x = -0.5 + (x + 0.5) * 0.5 / 0.8;
    else
      x = (x - 0.3) * 0.5 / 0.2;
  const RestMesh rest(mesh);
  Positions moved = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v) moved(v, 2) += std::max(0.0, moved(v, 0));
  const ShapeError error = shape_error(moved, rest.positions(), shares(rest));
  // The trapezoidal rule with cells h = 1/20 has an error of h²/12 · Δ(2u) / ½∫u² ≈ 1/2 % of the square.
  CHECK_THAT(error.rms, WithinRel(std::sqrt(1.0 / 24), 4e-3));
  CHECK_THAT(error.largest, WithinAbs(0.5, rounding));
}

TEST_CASE("shape error: the error of a turned pose is zero after the best turn or the best rigid motion",
          "[metrics]") {
  const RestMesh rest(delaunay(2, 1, 12, 3));
  const Positions pose = wavy(rest);
  const std::vector<double> share = shares(rest);
  const Vector3 centre(0.3, -0.4, 5), up = Vector3::UnitZ();
  for (const double angle : {0.1, 2.0, -3.0}) {
    const Positions reference = turned(pose, angle, up, centre);
    const auto left = [&](const RigidMotion& motion) {
      return shape_error(pose, motion.moved(reference), share).largest;
    };
    CHECK_THAT(left(nearest_turn(reference, pose, share, centre, up)), WithinAbs(0, rounding));
    CHECK_THAT(left(nearest_turn(reference, pose, share, centre, -up)), WithinAbs(0, rounding));
    CHECK_THAT(left(nearest_motion(reference, pose, share)), WithinAbs(0, rounding));
  }
  // No turn about the vertical removes a turn about another axis through the centre, but a rigid motion does.
  const Positions tilted = turned(pose, 0.5, Vector3::UnitX(), centre);
  CHECK(shape_error(pose, nearest_turn(tilted, pose, share, centre, up).moved(tilted), share).rms > 0.1);
  CHECK_THAT(shape_error(pose, nearest_motion(tilted, pose, share).moved(tilted), share).rms,
             WithinAbs(0, rounding));
}

TEST_CASE("shape error: the best turn is better than slightly larger and smaller turns", "[metrics]") {
  // The pose is not just a turned copy.
  const RestMesh rest(delaunay(1, 1, 10, 5));
  const Positions pose = wavy(rest);
  const Positions other = turned(1.2 * rest.positions(), 0.7, Vector3(1, 2, 3).normalized(), {0, 0, 0});
  const std::vector<double> share = shares(rest);
  const Vector3 centre(0.1, 0.2, 0), down = -Vector3::UnitZ();
  const Positions best = nearest_turn(other, pose, share, centre, down).moved(other);
  const double rms = shape_error(pose, best, share).rms;
  for (const double angle : {-0.01, 0.01, 1.0, 2.0, 3.0, 4.0, 5.0})
    CHECK(shape_error(pose, turned(best, angle, down, centre), share).rms > rms);
}

TEST_CASE("shape error: the distance of two concentric spheres is the difference of their radii",
          "[metrics]") {
  const double radius = 0.5, apart = 0.03;
  const TriangleMesh small = sphere(radius, 10), large = sphere(radius + apart, 14);
  // Triangles are flat, so a vertex of the large sphere may be farther from the small mesh by the sagitta:
  // the middle of a triangle with edges of up to e is e²/6r below the sphere. The edges come from an
  // octahedron with edges of √2 r, divided into ten. In the middle of its face, r/√3 from the centre,
  // projection on the sphere makes them √3 times as long.
  const double edge = std::numbers::sqrt2 * std::numbers::sqrt3 * radius / 10,
               sagitta = edge * edge / 6 / radius;
  const double distance = hausdorff_distance(small, large);
  CHECK(distance >= apart);
  CHECK(distance <= apart + sagitta);
  CHECK(hausdorff_distance(large, small) == distance);
  CHECK_THAT(hausdorff_distance(small, small), WithinAbs(0, rounding));
}

TEST_CASE("shape error: distances are measured in both directions, so a larger surface counts", "[metrics]") {
  // The wide sheet contains the narrow sheet. Only points of the wide sheet have a distance, 0.5 at its short
  // sides.
  const TriangleMesh wide = grid(2, 1, 10, 5), narrow = grid(1, 1, 7, 7);
  CHECK_THAT(hausdorff_distance(wide, narrow), WithinAbs(0.5, rounding));
  CHECK_THAT(hausdorff_distance(narrow, wide), WithinAbs(0.5, rounding));
  TriangleMesh lonely = narrow;  // vertices in no triangle do not belong to the surface
  lonely.positions.conservativeResize(lonely.positions.rows() + 1, 3);
  lonely.positions.bottomRows(1) << 9, 9, 9;
  CHECK_THAT(hausdorff_distance(lonely, narrow), WithinAbs(0, rounding));
  CHECK_THROWS_AS(hausdorff_distance(wide, TriangleMesh{}), std::invalid_argument);
}

TEST_CASE("shape error: the strain of a stretched and of a sheared sheet is right", "[metrics]") {
  // F = diag(s, 1) and E = diag((s² - 1)/2, 0) in every triangle, for any direction of its sides.
  const RestMesh rest(delaunay(2, 1, 12, 3));
  for (const double s : {0.9, 1.05, 2.0}) {
    Positions stretched = rest.positions();
    stretched.col(0) *= s;
    stretched = turned(stretched, 1.1, Vector3(1, 2, -1).normalized(), {3, 0, 0});
    const double strain = std::abs(s * s - 1) / 2;
    CHECK_THAT(strain_error(rest, stretched), WithinRel(strain, 1e-10));
    CHECK_THAT(strain_error(rest, stretched, rest.positions()), WithinRel(strain, 1e-10));
    CHECK_THAT(strain_error(rest, stretched, stretched), WithinAbs(0, rounding));
  }
  // Simple shear by γ: E = [0 γ/2; γ/2 γ²/2].
  Positions sheared = rest.positions();
  sheared.col(0) += 0.2 * rest.positions().col(1);
  CHECK_THAT(strain_error(rest, sheared), WithinRel(std::sqrt(2 * 0.1 * 0.1 + 0.02 * 0.02), 1e-10));
  // If half of the area is stretched, the result is the root of half the square.
  Positions half = rest.positions();
  const RestMesh even(grid(2, 1, 8, 4));
  half = even.positions();
  for (int v = 0; v < even.vertex_count(); ++v)
    if (half(v, 0) > 0) half(v, 0) *= 2;
  CHECK_THAT(strain_error(even, half), WithinRel(1.5 / std::sqrt(2), 1e-10));
}

TEST_CASE("box tree: the nearest element agrees with a search through all elements", "[mesh]") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  Positions points(57, 3);
  for (double& x : points.reshaped()) x = anywhere(random);
  BoxTree tree(points);
  std::vector<Box> boxes(57);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(points(static_cast<Eigen::Index>(i), axis));
      boxes[i].low(axis) = std::nextafter(x, -2.f), boxes[i].high(axis) = std::nextafter(x, 2.f);
    }
  tree.renew(boxes);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 at(anywhere(random), 3 * anywhere(random), anywhere(random));
    const double searched = (points.rowwise() - at.transpose()).rowwise().squaredNorm().minCoeff();
    const auto squared_distance = [&](int i) { return (points.row(i) - at.transpose()).squaredNorm(); };
    CHECK_THAT(tree.least_squared_distance(at, squared_distance), WithinRel(searched, rounding));
  }
  CHECK(std::isinf(BoxTree(Positions(0, 3)).least_squared_distance({0, 0, 0}, [](int) { return 0.0; })));
}

}  // namespace bendlab::shape_error_test
