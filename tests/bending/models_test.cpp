// Properties that every registered model must have on every shape, and spring counts computed by hand.
#include <algorithm>
#include <set>

#include "bendlab/mesh/rings.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::models_test {
namespace {

using test::built;

std::size_t count(std::string_view model, const RestMesh& rest, const Pins& pins,
                  const test::Changed& changed = {}) {
  return built(model, rest, pins, changed).distance.size();
}

Pins no_pins(const RestMesh& rest) {
  return make_pins(rest, {}, 0);
}
Pins corner_pin(const RestMesh& rest, int ring) {
  return make_pins(rest, select_vertices(rest, Place::upper_right), ring);
}

std::set<std::array<int, 2>> pair_set(const DistanceConstraints& springs) {
  std::set<std::array<int, 2>> pairs;
  for (const auto& [a, b] : springs.vertices) pairs.insert({std::min(a, b), std::max(a, b)});
  return pairs;
}

}  // namespace

TEST_CASE("every model keeps its contract on every shape", "[bending]") {
  for (const TriangleMesh& mesh :
       {grid(1, 1, 9, 9), grid(1, 1, 5, 5, Diagonal::both), grid(2, 1, 8, 4, Diagonal::alternating),
        equilateral(1, 1, 9), delaunay(1, 1, 9, 7), disc(0.5, 5), grid(3, 1, 3, 1)}) {
    const RestMesh rest(mesh);
    for (const int ring : {0, 1}) {
      const Pins pins = corner_pin(rest, ring);
      for (const BendingKind* model : bending_models()) {
        INFO(model->name);
        const BendingConstraints constraints = constraints_of(BendingModel(*model), {rest, pins});
        const DistanceConstraints& springs = constraints.distance;
        CHECK(pair_set(springs).size() == springs.size());  // no pair twice
        for (std::size_t s = 0; s < springs.size(); ++s) {
          const auto [a, b] = springs.vertices[s];
          REQUIRE((a >= 0 && b >= 0 && a < rest.vertex_count() && b < rest.vertex_count()));
          CHECK(a != b);
          CHECK_FALSE((pins.pinned(a) && pins.pinned(b)));
          // At rest nothing is corrected: the rest length is the distance, or 2 % more if the model's springs
          // are meant to push.
          CHECK_THAT(
              springs.rest(s),
              Catch::Matchers::WithinRel(
                  (model->prestressed ? 1.02 : 1) * (rest.position(a) - rest.position(b)).norm(), 1e-14));
        }
        CHECK(constraints_of(BendingModel(*model), {rest, pins}).distance.vertices ==
              springs.vertices);  // building twice gives the same springs
        CHECK_FALSE(model->summary.empty());
        CHECK_FALSE(model->source.empty());
        CHECK_FALSE(model->limits.empty());
      }
    }
  }
}

TEST_CASE("no model corrects anything after a rigid motion", "[bending]") {
  const RestMesh rest(delaunay(1, 1, 9, 7));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const BendingKind* model : bending_models())
    for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
      if (model->prestressed) continue;  // its springs stretch the sheet
      INFO(model->name);
      SimulationInput input = test::sheet(rest, no_pins(rest), model->name);
      input.bending_stiffness = {.kind = kind, .k = 1, .compliance = 1e-6};
      input.positions = (rest.positions() * turn.transpose()).rowwise() + Eigen::RowVector3d(0.3, -0.2, 0.5);
      const auto simulation = make_simulation<double>(input, {});
      for (int s = 0; s < 20; ++s) REQUIRE(simulation->step());
      // Rounding of coordinates of order 1 in about 10⁴ projections, including strain constraints.
      CHECK((simulation->positions() - input.positions).cwiseAbs().maxCoeff() <= 1e-12);
    }
}

TEST_CASE("models state whether they consist of springs alone, and whether they only push", "[bending]") {
  const RestMesh rest(grid(1, 1, 6, 6));
  for (const BendingKind* model : bending_models()) {
    INFO(model->name);
    const BendingConstraints built = constraints_of(BendingModel(*model), {rest, make_pins(rest, {0}, 0)});
    CHECK(model->springs_only == (element_count(built.elements) + built.own.size() == 0));
    std::size_t one_sided = 0;
    for_each_kind(built.elements, [&]<class Kind>(const ElementList<Kind>& list) {
      if constexpr (OneSided<Kind>) one_sided += list.size();
    });
    CHECK(model->one_sided == (one_sided > 0));
  }
}

TEST_CASE("a model of constraints that differ in softness is refused with k, unless it allows k",
          "[bending]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  const BendingKind own{.name = "own"}, declared{.name = "own", .softness_needs_compliance = true};
  BendingConstraints constraints;
  constraints.distance.vertices.push_back({0, 1});
  constraints.distance.rest_length = {0.5};
  CHECK_FALSE(unknown_to_k(own, constraints));  // without a list of softness, every softness is 1
  constraints.distance.softness = {1};
  CHECK_FALSE(unknown_to_k(own, constraints));
  constraints.distance.softness = {2};  // half as stiff, which k cannot express
  REQUIRE(unknown_to_k(own, constraints));
  CHECK(unknown_to_k(own, constraints)->find("'own'") != std::string::npos);
  CHECK_FALSE(unknown_to_k(declared, constraints));
  // Every registered model can be used with k, which is the paper's stiffness.
  const Pins pins = no_pins(rest);
  for (const BendingKind* model : bending_models()) {
    INFO(model->name);
    CHECK_FALSE(unknown_to_k(*model, built(model->name, rest, pins)));
  }
}

TEST_CASE("spring counts agree with counts by hand", "[bending]") {
  for (const int n : {3, 8, 16}) {
    const RestMesh rest(grid(1, 1, n, n));
    const auto cells = static_cast<std::size_t>(n);
    const std::size_t edges = 3 * cells * cells + 2 * cells, boundary = 4 * cells;
    CHECK(count("none", rest, no_pins(rest)) == 0);
    CHECK(count("crossover", rest, no_pins(rest)) == edges - boundary);  // one per interior edge
    CHECK(count("k_ring", rest, no_pins(rest), {{"k", std::int64_t{1}}}) == edges);
    CHECK(count("k_ring", rest, no_pins(rest),
                {{"k", std::int64_t{1}}, {"rings", std::string("beyond_edges")}}) == 0);
    // A ring wider than the mesh gives every pair of vertices once.
    const std::size_t vertices = (cells + 1) * (cells + 1);
    CHECK(count("k_ring", rest, no_pins(rest), {{"k", std::int64_t{1000}}}) == vertices * (vertices - 1) / 2);
    // Straight lines of two edges: three through each interior vertex, one through each vertex of the
    // boundary except the corners.
    const std::size_t interior = (cells - 1) * (cells - 1);
    CHECK(count("crossover", rest, no_pins(rest), {{"pairs", std::string("straight")}}) ==
          3 * interior + 4 * (cells - 1));
  }
}

TEST_CASE("rings of a hexagonal neighbourhood have 3 r springs per vertex", "[bending]") {
  // On a disc of triangles, ring r of the centre has 6 r vertices.
  const RestMesh rest(disc(1, 6));
  for (const std::int64_t k : {1, 2, 3, 5}) {
    const auto springs =
        built("k_ring", rest, no_pins(rest), {{"k", k}, {"rings", std::string("last")}}).distance;
    const auto of_centre = std::count_if(springs.vertices.begin(), springs.vertices.end(),
                                         [](const auto& pair) { return pair[0] == 0 || pair[1] == 0; });
    CHECK(of_centre == 6 * k);
  }
}

TEST_CASE("adaptive and LOD counts agree with an independent implementation", "[bending]") {
  // Spring counts of a separate implementation of the paper (unit square, parallel diagonals, one corner and
  // its 1-ring pinned).
  struct Case {
    const char* model;
    int cells;
    std::size_t springs;
    double m, n;
  };
  for (const Case& c : {Case{"adaptive", 32, 3185, 1, 3}, Case{"adaptive", 64, 36849, 2, 5},
                        Case{"lod", 64, 24366, 2, 5}, Case{"adaptive", 128, 484179, 4, 9}}) {
    const RestMesh rest(grid(1, 1, c.cells, c.cells));
    const BendingConstraints constraints = built(c.model, rest, corner_pin(rest, 1));
    CHECK(constraints.distance.size() == c.springs);
    CHECK(constraints.facts[1].value == c.m);
    CHECK(constraints.facts[2].value == c.n);
  }
}

TEST_CASE("LOD levels follow their settings", "[bending]") {
  const RestMesh rest(grid(1, 1, 16, 16));  // m = 1.50 before rounding
  const auto levels = [&](const test::Changed& changed) {
    const auto facts = built("adaptive", rest, no_pins(rest), changed).facts;
    return std::pair(static_cast<int>(facts[1].value), static_cast<int>(facts[2].value));
  };
  CHECK(levels({}) == std::pair(1, 3));
  CHECK(levels({{"m_rounding", std::string("ceil")}}) == std::pair(2, 5));
  CHECK(levels({{"m_min", std::int64_t{3}}}) == std::pair(3, 7));
  CHECK(levels({{"n_multiplier", std::int64_t{4}}}) == std::pair(1, 12));
}

TEST_CASE("ring options have their documented effect", "[bending]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  const Pins pins = corner_pin(rest, 1);
  const auto k = std::pair<std::string, Value>{"k", std::int64_t{2}};
  const DistanceConstraints plain = built("k_ring", rest, pins, {k}).distance;

  const DistanceConstraints twice =
      built("k_ring", rest, pins, {k, {"shared_pairs", std::string("twice")}}).distance;
  CHECK(twice.size() == 2 * plain.size());
  CHECK(pair_set(twice) == pair_set(plain));

  // Pinned are the corner, its two neighbours on the boundary and its neighbour along the diagonal: C(4, 2)
  // pairs, all within two rings.
  const std::size_t pinned = pins.all.size();
  const DistanceConstraints kept =
      built("k_ring", rest, pins, {k, {"pinned_pairs", std::string("keep")}}).distance;
  CHECK(kept.size() == plain.size() + pinned * (pinned - 1) / 2);

  // With straight distances: all pairs within k mean edge lengths. Across the diagonals of this grid a vertex
  // is up to √2 times as many edges away.
  const RestMesh large(grid(1, 1, 24, 24));
  for (const int level : {2, 4, 8}) {
    const DistanceConstraints straight =
        built("k_ring", large, no_pins(large),
              {{"k", std::int64_t{level}}, {"distance", std::string("euclidean")}})
            .distance;
    std::size_t expected = 0;
    for (int a = 0; a < large.vertex_count(); ++a)
      for (int b = a + 1; b < large.vertex_count(); ++b)
        expected += (large.position(a) - large.position(b)).norm() <= level * large.mean_edge_length();
    CHECK(straight.size() == expected);
  }

  // Lengths along edges are never shorter than straight ones, and a knight's move is as long as an edge and a
  // diagonal.
  const DistanceConstraints path =
      built("k_ring", rest, no_pins(rest), {k, {"rest_length", std::string("path")}}).distance;
  const double cell = 1.0 / 8;
  for (std::size_t s = 0; s < path.size(); ++s) {
    const Vector3 d = (rest.position(path.vertices[s][0]) - rest.position(path.vertices[s][1])) / cell;
    CHECK(path.rest(s) >= d.norm() * cell * (1 - 1e-12));
    if (std::abs(std::abs(d.x() * d.y()) - 2) < 1e-9 && d.x() * d.y() > 0)
      CHECK_THAT(path.rest(s), Catch::Matchers::WithinRel((1 + std::sqrt(2.0)) * cell, 1e-12));
  }
}

TEST_CASE("LOD with ring_1 has the springs of ring t and all mesh edges, without duplicates", "[bending]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  const Pins pins = no_pins(rest);
  const int t = GENERATE(1, 2, 3, 5);
  const auto level = std::pair<std::string, Value>{"t", std::int64_t{t}};
  const DistanceConstraints alone = built("lod", rest, pins, {level}).distance;
  const DistanceConstraints both = built("lod", rest, pins, {level, {"ring_1", true}}).distance;
  auto expected = pair_set(alone);
  for (const auto edge : rest.edges().rowwise()) expected.insert({edge.minCoeff(), edge.maxCoeff()});
  CHECK(pair_set(both) == expected);
  CHECK(both.size() == expected.size());
}

TEST_CASE("vertices of the pinned ring count as pinned unless a setting excludes them", "[bending]") {
  const RestMesh rest(grid(1, 1, 32, 32));
  const Pins pins = corner_pin(rest, 1);
  CHECK(count("adaptive", rest, pins) > count("adaptive", rest, pins, {{"pinned_ring_is_pinned", false}}));
}

}  // namespace bendlab::models_test
