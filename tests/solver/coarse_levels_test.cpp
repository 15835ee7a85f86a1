// Coarse levels of the solver: shapes that they do not change, momentum that they keep, and stretch that they
// reduce.
#include "bendlab/solver/coarse_levels.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "bendlab/solver/method.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::coarse_levels_test {
namespace {

using Catch::Matchers::ContainsSubstring;

constexpr int as_many_as_there_are = 12;

Points<double> points_at(const SimulationInput& input, const Positions& at) {
  Points<double> points(input.mass.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v].set(at.row(static_cast<Eigen::Index>(v)).transpose());
    points[v].w = input.is_pinned[v] ? 0 : 1 / input.mass[v];
  }
  return points;
}

// How one correction in a substep of 1 ms moves the vertices from `at`, m.
Positions moves_by_levels(const SimulationInput& input, const Positions& at) {
  CoarseLevels<double> levels(input, as_many_as_there_are);
  REQUIRE(levels.count() >= 2);
  Points<double> points = points_at(input, at);
  Workers workers(1);
  levels.correct(points.data(), 1e-3, workers);
  Positions moves(at.rows(), 3);
  for (Eigen::Index v = 0; v < at.rows(); ++v)
    moves.row(v) = points[static_cast<std::size_t>(v)].vector().transpose() - at.row(v);
  return moves;
}

// The flat mesh rolled up: x runs along an arc. The surface is developable.
Positions rolled(const Positions& flat, double radius) {
  Positions x = flat;
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    x.row(v) << radius * std::sin(flat(v, 0) / radius), flat(v, 1),
        radius * (1 - std::cos(flat(v, 0) / radius));
  return x;
}

// Folded flat onto itself at x = 0.
Positions folded(const Positions& flat) {
  Positions x = flat;
  x.col(0) = x.col(0).cwiseAbs();
  return x;
}

RestMesh with_a_hole() {
  TriangleMesh mesh = grid(1, 1, 20, 20);
  std::vector<int> kept;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Vector3 centre = Vector3::Zero();
    for (int c = 0; c < 3; ++c) centre += mesh.positions.row(mesh.triangles(t, c)).transpose() / 3;
    if (centre.head<2>().cwiseAbs().maxCoeff() > 0.2) kept.push_back(static_cast<int>(t));
  }
  Triangles triangles(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t t = 0; t < kept.size(); ++t)
    triangles.row(static_cast<Eigen::Index>(t)) = mesh.triangles.row(kept[t]);
  mesh.triangles = triangles;
  return RestMesh(mesh);
}

// A sheet that hangs by its upper side, straight down from 0.5 m to -0.5 m.
SimulationInput hanging(const RestMesh& rest, StiffnessKind kind, double compliance) {
  SimulationInput input = test::sheet(rest, make_pins(rest, select_vertices(rest, Place::top), 0), "none");
  input.strain_stiffness = {.form = StrainForm::angle, .kind = kind, .compliance = compliance};
  input.positions.col(2) = input.positions.col(1), input.positions.col(1).setZero();
  return input;
}

Triangles triangles_of(const SimulationInput& input) {
  Triangles triangles(static_cast<Eigen::Index>(input.strain.size()), 3);
  for (std::size_t t = 0; t < input.strain.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(c)) = input.strain.vertices[t][c];
  return triangles;
}

// By how much, on average, the lower side comes to rest below -0.5 m.
double stretch_after(SimulationInput input, int levels, int substeps, double seconds) {
  input.settings.substeps = substeps, input.settings.iterations = 1;
  input.method = Pbd{.levels = levels};
  std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
  const RestMesh rest({input.rest, triangles_of(input), {}});
  const Pins pins{.seeds = {}, .all = {}, .is_pinned = input.is_pinned};
  passes.push_back(test::effect_passes<double>("viscous_drag", rest, pins, "coefficient", 5.0).front());
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int step = 0; step < seconds * 60; ++step) REQUIRE(simulation->step());
  double sum = 0;
  int count = 0;
  for (Eigen::Index v = 0; v < input.rest.rows(); ++v)
    if (input.rest(v, 1) < -0.5 + 1e-9) sum += simulation->positions()(v, 2), ++count;
  return -0.5 - sum / count;
}

}  // namespace

TEST_CASE("coarse levels do not move cloth that is bent without stretch", "[solver]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 16, 16), grid(1, 1, 15, 15, Diagonal::both),
                                   equilateral(1, 1, 16), delaunay(1, 1, 16, 3), disc(0.5, 8)}) {
    const RestMesh rest(mesh);
    const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "none");
    // Geodesics are exact to 1e-9 (geodesics_test.cpp).
    for (const Positions& shape : {rest.positions(), rolled(rest.positions(), 0.1), folded(rest.positions())})
      CHECK(moves_by_levels(input, shape).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("coarse levels of a cloth with a hole do not move its rest shape", "[solver]") {
  const RestMesh rest = with_a_hole();
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "none");
  CHECK(moves_by_levels(input, rest.positions()).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("coarse levels keep the momentum of a free cloth", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 18, 5));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "none");
  Positions stretched = rest.positions();
  stretched.col(0) *= 1.2, stretched.col(1) *= 1.1;
  const Positions moves = moves_by_levels(input, stretched);
  CHECK(moves.cwiseAbs().maxCoeff() > 0.01);
  Vector3 moved = Vector3::Zero();
  for (Eigen::Index v = 0; v < moves.rows(); ++v)
    moved += input.mass[static_cast<std::size_t>(v)] * moves.row(v).transpose();
  CHECK(moved.norm() < 1e-15 * static_cast<double>(moves.rows()));  // roundings of sums
}

TEST_CASE("coarse levels do not move pinned vertices, and pull the cloth towards them", "[solver]") {
  const RestMesh rest(grid(1, 1, 24, 24));
  const SimulationInput input =
      test::sheet(rest, make_pins(rest, select_vertices(rest, Place::top), 0), "none");
  Positions fallen = rest.positions();
  for (Eigen::Index v = 0; v < fallen.rows(); ++v)
    if (!input.is_pinned[static_cast<std::size_t>(v)]) fallen(v, 1) -= 0.05;
  const Positions moves = moves_by_levels(input, fallen);
  for (Eigen::Index v = 0; v < moves.rows(); ++v)
    if (input.is_pinned[static_cast<std::size_t>(v)])
      CHECK(moves.row(v).norm() == 0);
    else
      CHECK(moves(v, 1) >= -1e-12);
  // One correction moves the lower half. Without levels this would take ten iterations.
  Vector3 lower = Vector3::Zero();
  int count = 0;
  for (Eigen::Index v = 0; v < moves.rows(); ++v)
    if (rest.positions()(v, 1) < 0) lower += moves.row(v).transpose(), ++count;
  CHECK(lower.y() / count > 0.01);
}

TEST_CASE("with coarse levels, few substeps keep a hanging sheet from stretching", "[solver]") {
  const RestMesh rest(grid(1, 1, 24, 24));
  for (const auto& [kind, compliance] :
       {std::pair(StiffnessKind::k, 0.0), std::pair(StiffnessKind::compliance, 1e-7)}) {
    const SimulationInput input = hanging(rest, kind, compliance);
    const double with = stretch_after(input, as_many_as_there_are, 2, 4),
                 without = stretch_after(input, 0, 2, 4);
    CHECK(with < 0.25 * without);
    const double finer = stretch_after(input, as_many_as_there_are, 8, 4);
    CHECK(finer < 0.25 * with);  // of second order in h, 1/16; half of that is enough
    CHECK(finer > -1e-6);
  }
}

TEST_CASE("coarse levels keep most of the stretch of a soft membrane", "[solver]") {
  // At rest under its own weight, a strip of Y = 20 N/m is ρ g L² / 2Y = 0.05 m longer. Spans of coarse
  // levels resist, too: each level has a sixtieth of the triangles' stiffness, along several directions.
  const RestMesh rest(grid(1, 1, 12, 12));
  const SimulationInput input = hanging(rest, StiffnessKind::compliance, 1.0 / 20);
  const double stretch = 0.2 * 9.81 / (2 * 20);
  const double without = stretch_after(input, 0, 12, 4), with = stretch_after(input, 12, 12, 4);
  CHECK(std::abs(without / stretch - 1) < 0.05);
  CHECK(with > 0.8 * stretch);
  CHECK(with < without);
}

// The diagonal of the cloth is √2 / 0.095 = 14.9 mean edges long.
TEST_CASE("there are no coarse levels if substeps are at least as many as edges across the cloth",
          "[solver]") {
  const RestMesh rest(grid(1, 1, 12, 12));
  const SimulationInput input = hanging(rest, StiffnessKind::compliance, 1e-4);
  CHECK(stretch_after(input, 12, 14, 0.5) != stretch_after(input, 0, 14, 0.5));
  CHECK(stretch_after(input, 12, 15, 0.5) == stretch_after(input, 0, 15, 0.5));
}

TEST_CASE("coarse levels refuse a membrane that does not resist all strain", "[solver]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "none");
  input.strain_stiffness.shear = 0;
  CHECK_THROWS_WITH(CoarseLevels<double>(input, 1), ContainsSubstring("/solver/levels to 0"));
  CHECK(CoarseLevels<double>(input, 0).count() == 0);
}

TEST_CASE("the coarsest level has a few points", "[solver]") {
  const RestMesh small(grid(1, 1, 2, 2)), large(grid(1, 1, 32, 32));
  const auto count = [](const RestMesh& rest, int most) {
    return CoarseLevels<double>(test::sheet(rest, make_pins(rest, {}, 0), "none"), most).count();
  };
  CHECK(count(small, as_many_as_there_are) <= 1);
  CHECK(count(large, 1) == 1);
  CHECK(count(large, as_many_as_there_are) >= 3);
  CHECK(count(large, as_many_as_there_are) <= 5);  // 1024 vertices; each level has a quarter of the points
}

TEST_CASE("coarse levels give the same bits with one thread and with two", "[solver]") {
  const RestMesh rest(grid(1, 1, 140, 140));  // so many points that a second thread is used
  const auto last = [&](int threads) {
    SimulationInput input = hanging(rest, StiffnessKind::compliance, 1e-4);
    input.settings.threads = threads, input.settings.substeps = 2, input.settings.iterations = 1;
    input.method = Pbd{.levels = as_many_as_there_are};
    const auto simulation = make_simulation<float>(input, test::effect_passes<float>("gravity"));
    for (int step = 0; step < 5; ++step) REQUIRE(simulation->step());
    return simulation->positions();
  };
  CHECK(last(1) == last(2));
}

}  // namespace bendlab::coarse_levels_test
