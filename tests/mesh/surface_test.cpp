// Named surfaces: lengths and areas of the mapped meshes.
#include "bendlab/mesh/surface.hpp"

#include <cmath>
#include <numbers>

#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/refined.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "tests/catch.hpp"

namespace bendlab::surface_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
constexpr double pi = std::numbers::pi;

double area_of(const Positions& positions, const Triangles& triangles) {
  double area = 0;
  const RestMesh rest({positions, triangles, {}});
  for (const double a : rest.areas()) area += a;
  return area;
}

// The largest relative change of an edge's length.
double largest_change(const Positions& before, const Positions& after, const Triangles& triangles) {
  double largest = 0;
  const RestMesh rest({before, triangles, {}});
  for (const auto edge : rest.edges().rowwise()) {
    const double length = (before.row(edge(0)) - before.row(edge(1))).norm();
    largest = std::max(largest, std::abs((after.row(edge(0)) - after.row(edge(1))).norm() / length - 1));
  }
  return largest;
}

}  // namespace

TEST_CASE("a sheet rolled up, folded, or developed from a helix keeps its lengths", "[mesh]") {
  const TriangleMesh sheet = grid(1, 0.5, 64, 32);
  const auto on = [&](const NamedSurface& surface) { return on_surface(surface, sheet.positions); };
  // Chords of a cylinder of radius R are shorter by κ² a² / 24, along diagonals twice as much.
  for (const double direction : {0.0, 90.0, 30.0})
    CHECK(largest_change(sheet.positions,
                         on({.shape = SurfaceShape::cylinder, .radius = 0.4, .direction = direction}),
                         sheet.triangles) < 2 * std::pow(1.0 / 64 / 0.4, 2) / 24 * 1.01);
  CHECK(largest_change(sheet.positions, on({.shape = SurfaceShape::vee, .sweep = 150}), sheet.triangles) <
        1e-12);
  const NamedSurface helix{.shape = SurfaceShape::helix, .radius = 1, .pitch = 0.7, .ruling = 0.5};
  NamedSurface flat = helix;
  flat.shape = SurfaceShape::helix_flat;
  CHECK(largest_change(on(flat), on(helix), sheet.triangles) < 1e-2);  // chords of angles of 2π / 64
  CHECK(on(flat).col(2).isZero(0));
}

TEST_CASE("a tube that was refined becomes round", "[mesh]") {
  const TriangleMesh coarse = refined(tube(2, 2, 3, 6), 2);
  const Positions round = on_surface({.shape = SurfaceShape::cylinder, .radius = 5}, coarse.positions);
  CHECK((round.leftCols(2).rowwise().norm().array() - 5).abs().maxCoeff() < 1e-12);
  CHECK(round.col(2).isApprox(coarse.positions.col(2), 1e-12));
  CHECK(round.row(0).isApprox(Eigen::RowVector3d(5, 0, -1.5), 1e-12));
}

TEST_CASE("surfaces have the areas of their formulas", "[mesh]") {
  const TriangleMesh sheet = grid(1, 1, 128, 64);
  const auto area = [&](const NamedSurface& surface) {
    return area_of(on_surface(surface, sheet.positions), sheet.triangles);
  };
  // Facets of an angle δ lose about δ² / 6 of the area: 4e-4 for 2π / 128.
  CHECK_THAT(area({.shape = SurfaceShape::annulus, .radius = 2, .inner_radius = 1}), WithinRel(3 * pi, 1e-3));
  CHECK_THAT(area({.shape = SurfaceShape::sphere, .radius = 0.5, .polar_from = 18, .polar_to = 90}),
             WithinRel(2 * pi * 0.25 * std::cos(pi / 10), 1e-3));
  CHECK_THAT(area({.shape = SurfaceShape::torus, .radius = 1, .inner_radius = 0.3}),
             WithinRel(2 * pi * 0.3 * pi, 1e-3));
  const TriangleMesh round = disc(0.5, 32);
  CHECK_THAT(area_of(on_surface({.shape = SurfaceShape::dome, .radius = 2, .polar_to = 90}, round.positions),
                     round.triangles),
             WithinRel(2 * pi * 4, 3e-3));
}

TEST_CASE("a tube becomes a closed surface without a seam", "[mesh]") {
  const TriangleMesh side = tube(1, 1, 1, 48);
  const Positions points = on_surface(
      {.shape = SurfaceShape::sphere, .radius = 3, .polar_from = 60, .polar_to = 90}, side.positions);
  CHECK_THAT(area_of(points, side.triangles), WithinRel(2 * pi * 9 * 0.5, 1e-2));
  for (const auto p : points.rowwise()) CHECK_THAT(p.norm(), WithinAbs(3, 1e-12));
}

TEST_CASE("a twisted sheet turns its ends against each other", "[mesh]") {
  const TriangleMesh sheet = grid(12, 1.1, 12, 2);
  const Positions points = on_surface({.shape = SurfaceShape::twist, .sweep = 90}, sheet.positions);
  const RestMesh flat(sheet);
  for (int v = 0; v < flat.vertex_count(); ++v) {
    const double x = flat.position(v).x() - flat.centre().x(), y = flat.position(v).y() - flat.centre().y();
    const double angle = (x / 12 - 0.5) * pi / 2;  // 0 at the right end
    CHECK((points.row(v).transpose() - Vector3(x, y * std::cos(angle), y * std::sin(angle))).norm() < 1e-12);
  }
}

TEST_CASE("places keep the names of the flat mesh", "[mesh]") {
  const TriangleMesh sheet = grid(1, 1, 8, 8);
  const RestMesh flat(sheet);
  const RestMesh rolled(
      {on_surface({.shape = SurfaceShape::cylinder, .radius = 0.2}, sheet.positions), sheet.triangles, {}},
      sheet.positions);
  for (const Place place : {Place::left, Place::top, Place::upper_right, Place::centre})
    CHECK(select_vertices(rolled, place) == select_vertices(flat, place));
}

}  // namespace bendlab::surface_test
