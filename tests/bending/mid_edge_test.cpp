// Models that bend triangles, against closed forms of plates: their energies on cylinders and spheres
// converge to those of the smooth surface, on every kind of mesh.
#include <cmath>
#include <numbers>

#include "bendlab/mesh/surface.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::mid_edge_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double radius = 0.0325, height = 0.122, width = std::numbers::pi * radius;

BendingConstraints built(std::string_view model, const RestMesh& rest, double poisson_ratio = 0,
                         bool is_flat = false) {
  const Pins none = make_pins(rest, {}, 0);
  BendingInput input{rest, none};
  input.poisson_ratio = poisson_ratio, input.is_flat = is_flat;
  return constraints_of(BendingModel(*find_bending_model(model)), input);
}

// The energy of the sheet rolled up to a half-cylinder, divided by D π H / 2 R.
double half_cylinder(std::string_view model, const TriangleMesh& mesh, double poisson_ratio = 0) {
  const RestMesh rest(mesh);
  const Positions rolled = on_surface({.shape = SurfaceShape::cylinder, .radius = radius}, rest.positions());
  return test::energy(built(model, rest, poisson_ratio), rolled) / (std::numbers::pi * height / (2 * radius));
}

std::vector<TriangleMesh> meshes(int cells) {
  const int rows = static_cast<int>(std::lround(cells * height / width));
  return {grid(width, height, cells, rows, Diagonal::same),
          grid(width, height, cells, rows, Diagonal::alternating),
          grid(width, height, cells, rows, Diagonal::both), delaunay(width, height, cells, 3)};
}

}  // namespace

TEST_CASE("the bending energy of a half-cylinder converges to that of a plate", "[bending]") {
  // An inscribed polygon of n cells has an angle error of second order in 1/n. At the ends of the sheet, half
  // a cell is straight or badly resolved, so that the whole error is of first order: 2/n bounds it.
  for (const std::string_view model : {"mid_edge", "dkt"})
    for (const int cells : {8, 16})
      for (const TriangleMesh& mesh : meshes(cells)) {
        INFO(model << " " << cells);
        CHECK_THAT(half_cylinder(model, mesh), WithinAbs(1, 2.0 / cells));
      }
  // These models see no curvature at the border, which is a strip of half a cell on each side.
  for (const std::string_view model : {"mid_edge_average", "corotational_face", "laplacian"}) {
    const double coarse = half_cylinder(model, meshes(8)[0]), fine = half_cylinder(model, meshes(32)[0]);
    INFO(model << " " << coarse << " " << fine);
    CHECK(std::abs(fine - 1) < std::abs(coarse - 1) / 2);
    CHECK_THAT(fine, WithinAbs(1, 2.0 / 32));
  }
}

TEST_CASE("the energy of a cylinder does not depend on Poisson's ratio, that of a sphere does", "[bending]") {
  // The energy of a cylinder is ½ D κ² at every ν. A sheet on a sphere, whose rest shape is the sphere but
  // which is unbent when flat, has ½ D (2 (1 - ν) + 4 ν) / R² per area: 4 π (1 + ν) D on the whole sphere.
  for (const std::string_view model : {"mid_edge", "mid_edge_average", "corotational_face", "dkt"}) {
    const TriangleMesh mesh = meshes(12)[1];
    INFO(model);
    // Directors at the border relax within half a cell, which is a share of 1/12 of the sheet at each end.
    CHECK_THAT(half_cylinder(model, mesh, 0.3), WithinAbs(half_cylinder(model, mesh), 0.5 / 12));
    const RestMesh ball(sphere(0.7, 12));
    for (const double poisson_ratio : {0.0, 0.3}) {
      const double energy = test::energy(built(model, ball, poisson_ratio, true), ball.positions());
      // 12 cells on an edge of an octahedron: chords of a quarter circle are 0.3 % too short.
      CHECK_THAT(energy, WithinRel(4 * std::numbers::pi * (1 + poisson_ratio), 0.02));
    }
    // Bent from its own rest shape it has none, up to rounding of the turns.
    CHECK(test::energy(built(model, ball), ball.positions()) < 1e-12);
  }
}

TEST_CASE("the energy of a sheet that is bent a little converges to that of the smooth sheet", "[bending]") {
  // Linearised, the mid-edge model is the Morley triangle, which is exact for constant curvature. Directors
  // at the border are free, and lower the energy within half a cell, so that the error is halved with the
  // cells.
  const double kxx = 1e-4, kyy = -2e-4, kxy = 0.5e-4;
  const double squares = kxx * kxx + kyy * kyy + 2 * kxy * kxy, trace = kxx + kyy;
  for (const std::string_view model : {"mid_edge", "dkt"})
    for (const double nu : {0.0, 0.3}) {
      const auto error = [&](const TriangleMesh& mesh) {
        const RestMesh rest(mesh);
        Positions bent = rest.positions();
        for (auto p : bent.rowwise())
          p(2) = 0.5 * (kxx * p(0) * p(0) + kyy * p(1) * p(1)) + kxy * p(0) * p(1);
        const double smooth = 0.5 * ((1 - nu) * squares + nu * trace * trace);
        return 1 - test::energy(built(model, rest, nu), bent) / smooth;
      };
      const double coarse = error(grid(1, 1, 6, 6)), fine = error(grid(1, 1, 12, 12));
      INFO(model << " " << nu << " " << coarse << " " << fine);
      CHECK(coarse > 0);
      CHECK(fine > 0);
      CHECK(fine < 0.65 * coarse);
      CHECK(error(delaunay(1, 1, 12, 5)) < 3 * fine);  // irregular, but of the same order
    }
}

TEST_CASE("bent triangles do not depend on the orientation of triangles", "[bending]") {
  TriangleMesh mixed = meshes(8)[3];
  const TriangleMesh sound = mixed;
  for (Eigen::Index t = 0; t < mixed.triangles.rows(); t += 2)
    std::swap(mixed.triangles(t, 1), mixed.triangles(t, 2));
  for (const std::string_view model : {"mid_edge", "mid_edge_average", "corotational_face", "laplacian"}) {
    INFO(model);
    CHECK_THAT(half_cylinder(model, mixed), WithinRel(half_cylinder(model, sound), 1e-9));  // rounding
  }
}

TEST_CASE("laplacian names the vertex that has too many neighbours", "[bending]") {
  // A fan of 20 triangles.
  TriangleMesh fan;
  fan.positions.resize(21, 3);
  fan.triangles.resize(20, 3);
  fan.positions.row(0).setZero();
  for (int i = 0; i < 20; ++i) {
    const double angle = 2 * std::numbers::pi * i / 20;
    fan.positions.row(i + 1) << std::cos(angle), std::sin(angle), 0;
    fan.triangles.row(i) << 0, i + 1, (i + 1) % 20 + 1;
  }
  CHECK_THROWS_WITH(built("laplacian", RestMesh(fan)),
                    Catch::Matchers::ContainsSubstring("vertex 0 has 20") &&
                        Catch::Matchers::ContainsSubstring("choose another model"));
}

}  // namespace bendlab::mid_edge_test
