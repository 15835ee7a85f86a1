// Models on hinges are compared with the laws of their papers and with plate theory.
#include <cmath>
#include <numbers>
#include <random>

#include "bendlab/bending/rest_hinges.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::hinge_models_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using test::bent;
using test::energy;

constexpr double pi = std::numbers::pi;

struct Model {
  std::string_view name;
  test::Changed changed = {};
};

BendingConstraints built(const Model& model, const RestMesh& rest) {
  return test::built(model.name, rest, model.changed);
}

// Two flat equilateral triangles of edge 1, which share an edge along x.
RestMesh two_triangles() {
  TriangleMesh mesh;
  mesh.positions.resize(4, 3);
  const double h = std::numbers::sqrt3 / 2;
  mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, -h, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 1, 0, 3;
  return RestMesh(mesh);
}

// The second triangle turned by θ about the edge. Both triangles stay rigid.
Positions folded(const RestMesh& rest, double theta) {
  Positions positions = rest.positions();
  const double h = std::numbers::sqrt3 / 2;
  positions.row(3) << 0.5, -h * std::cos(theta), h * std::sin(theta);
  return positions;
}

double moment(const Model& model, double theta) {
  const RestMesh rest = two_triangles();
  const BendingConstraints constraints = built(model, rest);
  constexpr double step = 1e-5;
  return (energy(constraints, folded(rest, theta + step)) - energy(constraints, folded(rest, theta - step))) /
         (2 * step);
}

// 2 E / (κ² area) of the hinges in the middle of the lattice. Three hinges share the area √3/2 a² of two
// triangles.
double rigidity(const Model& model, double angle) {
  const RestMesh rest(equilateral(1, 1, 48));
  BendingConstraints constraints = built(model, rest);
  std::size_t counted = 0;
  for_each_kind(constraints.elements, [&](auto& list) {
    auto middle = list;
    middle.vertices.clear(), middle.rest.clear(), middle.softness.clear();
    for (std::size_t c = 0; c < list.size(); ++c) {
      // An edge belongs to its end with the lower number, so each vertex has three edges, one of every
      // direction.
      const Vector3 at = rest.position(std::min(list.vertices[c][0], list.vertices[c][1]));
      if (at.cwiseAbs().maxCoeff() > 0.25) continue;
      middle.vertices.push_back(list.vertices[c]);
      middle.rest.push_back(list.rest[c]);
      middle.softness.push_back(list.softness[c]);
    }
    counted += middle.size();
    list = middle;
  });
  const double a = rest.mean_edge_length(), curvature = 0.05 / a;
  const double area = static_cast<double>(counted) * std::numbers::sqrt3 / 6 * a * a;
  return 2 * energy(constraints, bent(rest, curvature, angle)) / (curvature * curvature * area);
}

}  // namespace

TEST_CASE("moments follow the laws of their papers", "[bending]") {
  const double height = std::numbers::sqrt3 / 2;
  for (const double theta : {-3.0, -2.0, -0.5, 0.01, 0.3, 1.0, 1.7, 2.5, 3.1}) {
    // The error of central differences with a step of 1e-5 is about 1e-10 for energies of order one.
    const auto check = [&](const Model& model, double expected) {
      INFO(model.name << " at " << theta);
      CHECK_THAT(moment(model, theta), WithinAbs(expected, 1e-7 * std::abs(expected) + 1e-9));
    };
    check({"dihedral"}, theta);                     // k = 1
    const double weight = 2 / std::numbers::sqrt3;  // edge² / area
    check({"discrete_shells"}, weight * theta);
    check({"bridson"}, weight / 2 * std::sin(theta / 2));
    // |Kx| = 2 edge sin(θ/2), U = ½ q |Kx|² with q = 3 / area.
    check({"isometric"}, 3 * weight * std::sin(theta));
    // U = ½ (½ q |Kx|²)², as libraries implement it.
    const double bergou = 6 * weight * std::pow(std::sin(theta / 2), 2);
    check({"isometric", {{"constraint", std::string("energy")}}}, bergou * 3 * weight * std::sin(theta));
    // The flaps are 2 h cos(θ/2) apart. The moment of a spring between them is cubic in θ near the flat
    // state, and largest when the hinge is folded shut.
    check({"crossover"}, 2 * height * height * (1 - std::cos(theta / 2)) * std::sin(theta / 2));
  }
}

TEST_CASE("a triangle without area has no hinge", "[bending]") {
  // A triangle of height h on an edge of length 1. If h is below 10⁻⁷ of the mesh's size, the triangle counts
  // as a line, because its normal would consist of rounding.
  const auto hinges = [](double h) {
    TriangleMesh mesh;
    mesh.positions = (Positions(4, 3) << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -h, 0).finished();
    mesh.triangles = (Triangles(2, 3) << 0, 1, 2, 1, 0, 3).finished();
    const RestMesh rest(mesh);
    return rest_hinges(rest, make_pins(rest, {}, 0)).size();
  };
  CHECK(hinges(1e-4) == 1);
  CHECK(hinges(1e-9) == 0);
}

TEST_CASE("signed hinges keep the direction of a fold up to 170 degrees", "[bending]") {
  for (const double degrees : {-170.0, -90.0, -5.0, 5.0, 90.0, 170.0}) {
    const double theta = degrees * pi / 180;
    const RestMesh flat = two_triangles();
    TriangleMesh mesh = flat.mesh();
    mesh.positions = folded(flat, theta);
    const RestMesh rest(mesh);
    for (const Model& model : {Model{"dihedral"}, Model{"discrete_shells"}, Model{"bridson"}}) {
      INFO(model.name);
      const BendingConstraints constraints = built(model, rest);
      CHECK_THAT(energy(constraints, rest.positions()), WithinAbs(0, 1e-24));
      CHECK(energy(constraints, folded(flat, -theta)) > energy(constraints, folded(flat, 0.9 * theta)));
      // The energy falls towards the rest angle, also from the flat state.
      CHECK(energy(constraints, folded(flat, 0.1 * theta)) < energy(constraints, folded(flat, 0)));
    }
    // A model without a sign cannot tell the two directions of the fold apart.
    const BendingConstraints blind = built({"isometric"}, rest);
    CHECK_THAT(energy(blind, folded(flat, -theta)), WithinAbs(0, 1e-24));
  }
}

TEST_CASE("flexural rigidities on the equilateral lattice", "[bending]") {
  // The sheet lies on a cylinder in any direction. The constant of each model is k = 1.
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 75.0, 90.0}) {
    const double angle = degrees * pi / 180;
    INFO(degrees);
    CHECK_THAT(rigidity({"dihedral", {{"weight", std::string("area")}}}, angle), WithinRel(1.0, 0.02));
    CHECK_THAT(rigidity({"dihedral", {{"weight", std::string("uniform")}}}, angle),
               WithinRel(std::numbers::sqrt3 / 2, 0.02));
    CHECK_THAT(rigidity({"discrete_shells"}, angle), WithinRel(1.0, 0.02));
    CHECK_THAT(rigidity({"bridson"}, angle), WithinRel(0.25, 0.02));
    CHECK_THAT(rigidity({"isometric"}, angle), WithinRel(3.0, 0.02));
  }
}

TEST_CASE("matched hinge models agree near flat", "[bending]") {
  // On any mesh and for any small deflection, θ, 2 sin(θ/2) and |Kx| / |e| are equal to first order. With
  // matched moduli (D, 6 k, 4 D, D / 3), energies therefore differ by the square of the largest fold angle.
  for (const TriangleMesh& mesh : {delaunay(1, 1, 12, 4), grid(1, 1, 10, 10), equilateral(1, 1, 12)}) {
    const RestMesh rest(mesh);
    double last = 1;
    for (const double height : {1e-2, 1e-3}) {
      Positions positions = rest.positions();
      std::mt19937_64 random(3);
      for (int v = 0; v < rest.vertex_count(); ++v)
        positions(v, 2) += test::uniform(random, -height, height) * rest.mean_edge_length();
      const double expected = energy(built({"dihedral", {{"weight", std::string("area")}}}, rest), positions);
      double worst = 0;
      const auto check = [&](std::string_view name, double matched) {
        worst = std::max(worst, std::abs(matched * energy(built({name}, rest), positions) / expected - 1));
      };
      check("discrete_shells", 1), check("bridson", 4), check("isometric", 1.0 / 3);
      CHECK(worst < 0.02 * last);  // second order: 1/100 for a tenth of the height
      last = std::max(worst, 1e-9);
    }
  }
}

TEST_CASE("a curved rest shape stays still", "[bending]") {
  // A quarter of a tube, a sleeve and a skirt feel no forces: every model takes its rest lengths and rest
  // angles from the rest shape.
  TriangleMesh quarter = grid(1, 1, 12, 12, Diagonal::alternating);
  quarter.positions = bent(RestMesh(quarter), pi / 2, 0.4);
  for (const auto& [shape, mesh] :
       {std::pair("quarter", quarter), std::pair("cylinder", tube(0.3, 0.3, 1, 14)),
        std::pair("cone", tube(0.6, 0.15, 0.8, 16))}) {
    const RestMesh rest(mesh);
    for (const BendingKind* model : bending_models())
      for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
        if (model->prestressed) continue;   // its springs stretch the sheet
        if (model->needs_energy) continue;  // not for pbd
        INFO(model->name << ", " << shape);
        SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), model->name);
        input.bending_stiffness = {.kind = kind, .k = 0.5, .compliance = 1e-4};
        const auto simulation = make_simulation<double>(input, {});
        for (int s = 0; s < 100; ++s) REQUIRE(simulation->step());
        // Rounding of about 10⁶ projections, each with an error of 10⁻¹⁶. Constraints that only push turn
        // this error into a speed that nothing stops.
        const double drift = model->name == "choi_ko" ? 1e-10 : 1e-11;
        CHECK((simulation->positions() - rest.positions()).norm() <= drift);
      }
  }
}

}  // namespace bendlab::hinge_models_test
