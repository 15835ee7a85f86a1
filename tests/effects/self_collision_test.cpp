// Collisions of cloth with itself: no crossings at any speed, and no change of momenta or of results
// elsewhere.
#include <numeric>
#include <set>

#include "bendlab/effects/near_pairs.hpp"
#include "bendlab/mesh/self_intersections.hpp"
#include "bendlab/metrics/motion.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::self_collision_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double thickness = 0.005;  // m, the default

template <class Real>
void append(std::vector<Pass<Real>>& passes, std::vector<Pass<Real>> more) {
  for (Pass<Real>& pass : more) passes.push_back(std::move(pass));
}

template <class Real>
std::vector<Pass<Real>> collision(const RestMesh& rest, double h = thickness,
                                  std::vector<int> permutation = {}) {
  return passes_of<Real>(SelfCollision{.thickness = h}, {rest, make_pins(rest, {}, 0), permutation});
}

// Two triangles far from each other at rest.
RestMesh two_triangles() {
  TriangleMesh mesh;
  mesh.positions.resize(6, 3);
  mesh.positions << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 1, 0, 0, 1.1, 0, 0, 1, 0.1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  return RestMesh(std::move(mesh));
}

// The state within a substep, in which vertices move from `from` to `to`.
template <class Real>
State<Real> state_on_the_way(const Positions& from, const Positions& to, const std::vector<double>& mass,
                             const std::vector<int>& permutation = {}) {
  State<Real> state;
  const auto count = static_cast<std::size_t>(from.rows());
  state.vertex_count = static_cast<int>(count);
  state.mass.resize(count);
  state.position.resize(count), state.velocity.resize(count);
  state.previous.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    const std::size_t at = permutation.empty() ? v : static_cast<std::size_t>(permutation[v]);
    state.mass[at] = mass[v];
    state.previous[at].set(from.row(row).transpose().template cast<Real>());
    state.position[at].set(to.row(row).transpose().template cast<Real>());
    state.position[at].w = state.previous[at].w = static_cast<Real>(1 / mass[v]);
  }
  return state;
}

template <class Real>
Positions positions_of(const State<Real>& state, const std::vector<int>& permutation = {}) {
  Positions positions(state.vertex_count, 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const auto at =
        static_cast<std::size_t>(permutation.empty() ? v : permutation[static_cast<std::size_t>(v)]);
    positions.row(v) = state.position[at].vector().template cast<double>().transpose();
  }
  return positions;
}

// Runs the passes of a stage, and returns how many pairs they corrected by their own count.
template <class Real>
std::uint64_t run(std::vector<Pass<Real>>& passes, Stage stage, State<Real>& state,
                  double substep = 1.0 / 60) {
  const Constraints<Real> none;
  PassContext<Real> context{state, none, static_cast<Real>(substep)};
  for (Pass<Real>& pass : passes)
    if (pass.stage == stage) pass.run(context);
  return context.acted;
}

// A crumpled sheet: triangles are near each other everywhere, but none intersect.
Positions crumpled(const RestMesh& rest, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double height = test::uniform(random, 0.02, 0.05), waves = test::uniform(random, 20, 40);
  Positions positions = rest.positions();
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    positions(v, 2) = height * std::sin(waves * positions(v, 0));
    positions(v, 0) *= 0.05;
  }
  return positions;
}

Corners rows(const Positions& positions, const std::array<int, 4>& vertices) {
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = positions.row(vertices[i]).transpose();
  return corners;
}

// Every vertex and triangle, and every two edges, of a mesh without a common vertex.
std::vector<std::pair<Pairing, std::array<int, 4>>> all_pairs(const RestMesh& rest) {
  std::vector<std::pair<Pairing, std::array<int, 4>>> pairs;
  const Triangles& t = rest.triangles();
  for (int v = 0; v < rest.vertex_count(); ++v)
    for (Eigen::Index i = 0; i < t.rows(); ++i)
      if (v != t(i, 0) && v != t(i, 1) && v != t(i, 2))
        pairs.push_back({Pairing::vertex_triangle, {v, t(i, 0), t(i, 1), t(i, 2)}});
  const Edges& e = rest.edges();
  for (Eigen::Index i = 0; i < e.rows(); ++i)
    for (Eigen::Index j = i + 1; j < e.rows(); ++j)
      if (e(i, 0) != e(j, 0) && e(i, 0) != e(j, 1) && e(i, 1) != e(j, 0) && e(i, 1) != e(j, 1))
        pairs.push_back({Pairing::edge_edge, {e(i, 0), e(i, 1), e(j, 0), e(j, 1)}});
  return pairs;
}

// A unique name of a pair. It depends neither on the order of vertices within an edge or triangle, nor on the
// order of two edges.
std::array<int, 4> sorted_name(Pairing pairing, std::array<int, 4> v) {
  if (pairing == Pairing::vertex_triangle) {
    std::sort(v.begin() + 1, v.end());
    return v;
  }
  if (v[0] > v[1]) std::swap(v[0], v[1]);
  if (v[2] > v[3]) std::swap(v[2], v[3]);
  if (v[0] > v[2]) std::swap(v[0], v[2]), std::swap(v[1], v[3]);
  return v;
}

// A sheet folded back and forth along x into layers about `gap` apart. It has no intersections and is close
// to its rest shape.
Positions accordion(const RestMesh& rest, int folds, double gap) {
  Positions positions = rest.positions();
  const double left = rest.box_min().x(), layer = (rest.box_max().x() - left) / (folds + 1);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double along = positions(v, 0) - left;
    const int below = std::min(folds, static_cast<int>(along / layer + 1e-9));
    const double within = along - below * layer;
    positions(v, 0) = below % 2 == 0 ? within : layer - within;
    positions(v, 2) = gap * along / layer;  // layers rise evenly, so they are `gap` apart on average
  }
  return positions;
}

template <class Real>
Pass<Real> floor_at(Real height) {
  return {"floor", Stage::contact, [height](PassContext<Real>& context) {
            for (Point<Real>& p : context.state.position)
              if (p.w > 0) p.z = std::max(p.z, height);
          }};
}

}  // namespace

TEMPLATE_TEST_CASE("a vertex shot at a triangle at 50 m/s stays on its side", "[effects][self_collision]",
                   float, double) {
  const RestMesh rest = two_triangles();
  for (int seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(test::uniform(random, -1, 1), test::uniform(random, -1, 1),
                           test::uniform(random, -1, 1), test::uniform(random, -1, 1))
            .normalized();
    SimulationInput input{.method = Pbd{}};
    input.size = rest.size();
    input.is_pinned.assign(6, 0);
    input.positions = rest.positions();
    // A vertex is shot at the middle of the other triangle, or drags an edge across an edge of this triangle.
    const bool edges = seed % 2 == 1;
    input.positions.bottomRows(3) << 0.03, 0.03, 0.3, 0.02, 0.05, 0.4, 0.05, 0.02, 0.4;
    if (edges) input.positions.bottomRows(3) << 0.05, -0.06, 0.3, 0.05, 0.04, 0.2, 0.05, -0.01, 0.4;
    input.velocities = Positions::Zero(6, 3);
    input.velocities(3, 2) = -50;
    input.positions = (input.positions * turn.toRotationMatrix().transpose()).eval();
    input.velocities = (input.velocities * turn.toRotationMatrix().transpose()).eval();
    for (int v = 0; v < 6; ++v) input.mass.push_back(test::uniform(random, 0.01, 0.02));

    const Motion before = motion_of(input.mass, input.positions, input.velocities);
    const auto simulation = make_simulation<TestType>(input, collision<TestType>(rest));
    REQUIRE(simulation->step());
    INFO("seed " << seed);
    const Corners x = rows(simulation->positions(), edges ? std::array{3, 4, 0, 1} : std::array{3, 0, 1, 2});
    const Vector3 gap = shortest_gap(edges ? Pairing::edge_edge : Pairing::vertex_triangle, x).vector;
    CHECK(gap.dot(turn * Vector3::UnitZ()) > 0);  // still on its own side
    // The tolerance allows for ten iterations on triangles that turn meanwhile. The dragged edge turns by 45
    // degrees, away from the other edge, so its gap may be larger.
    CHECK(gap.norm() >= 0.99 * thickness);
    if (!edges) CHECK(gap.norm() <= 1.01 * thickness);
    CHECK(simulation->passes().back().acted + simulation->passes()[1].acted > 0);
    const Motion after = motion_of(input.mass, simulation->positions(), simulation->velocities());
    const double eps = static_cast<double>(std::numeric_limits<TestType>::epsilon());
    // kg m/s over eps: the momentum of the heaviest vertex if rounding moves it by eps m in 1/60 s.
    const double scale = 60 * 0.02;
    CHECK((after.linear_momentum - before.linear_momentum).norm() <= 6 * eps * scale);
    REQUIRE((simulation->step() && simulation->step()));
    CHECK(self_intersections(simulation->positions(), rest.triangles()).empty());
    CHECK(after.kinetic_energy < before.kinetic_energy);  // nothing bounces
  }
}

TEMPLATE_TEST_CASE("a correction keeps both momenta", "[effects][self_collision]", float, double) {
  const RestMesh rest = two_triangles();
  const double eps = static_cast<double>(std::numeric_limits<TestType>::epsilon());
  int corrected = 0;
  for (int seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    Positions from(6, 3), to;
    for (Eigen::Index v = 0; v < 6; ++v)
      from.row(v) = (Vector3(0, 0, v < 3 ? 0 : 0.011) +
                     test::random_vector(random, 1).cwiseProduct(Vector3(0.1, 0.1, 0.002)))
                        .transpose();
    to = from;
    to.bottomRows(3).col(2).array() -= 0.006;  // nearer than the thickness, but on the same side
    std::vector<double> mass;
    for (int v = 0; v < 6; ++v) mass.push_back(test::uniform(random, 0.5, 2));
    State<TestType> state = state_on_the_way<TestType>(from, to, mass);
    auto passes = collision<TestType>(rest);
    // Only cases in which exactly one pair is corrected are checked.
    const Positions before = positions_of(state);
    if (run(passes, Stage::project, state) != 1) continue;
    ++corrected;
    const Positions moved = positions_of(state) - before;
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
    for (Eigen::Index v = 0; v < 6; ++v) {
      const double m = mass[static_cast<std::size_t>(v)];
      const Vector3 d = moved.row(v).transpose(), x = before.row(v).transpose();
      linear += m * d, angular += m * x.cross(d);
    }
    CHECK(moved.norm() > 0);
    CHECK(linear.norm() <= 20 * eps * 0.1);    // kg m: rounding of 0.1 m, six masses of up to 2 kg
    CHECK(angular.norm() <= 20 * eps * 0.02);  // kg m²: the same with arms of 0.14 m
  }
  CHECK(corrected >= 20);
}

TEMPLATE_TEST_CASE("a near pair moves apart by the same distance in each substep, new or known",
                   "[effects][self_collision]", float, double) {
  // A vertex above a triangle, nearer than the thickness. In a tenth of 0.02 s it moves away by a tenth of
  // the thickness, whether its pair is new or known from the previous substep.
  const RestMesh rest = two_triangles();
  Positions at = rest.positions();
  at.bottomRows(3) << 0.03, 0.03, 0.004, 0.02, 0.05, 0.1, 0.05, 0.02, 0.1;
  const std::vector<double> mass(6, 1);
  auto passes = collision<TestType>(rest);
  for (const double height : {0.004, 0.003, 0.0035}) {
    at(3, 2) = height;
    State<TestType> state = state_on_the_way<TestType>(at, at, mass);
    CHECK(run(passes, Stage::project, state, 0.002) == 1);
    const Corners x = rows(positions_of(state), {3, 0, 1, 2});
    CHECK_THAT(shortest_gap(Pairing::vertex_triangle, x).vector.norm(),
               WithinRel(height + 0.1 * thickness, 1e-4));
    run(passes, Stage::velocity, state, 0.002);
  }
}

TEST_CASE("the list of near pairs misses no pair that can come near", "[effects][self_collision]") {
  const RestMesh rest(delaunay(1, 1, 10, 4));
  const auto pairs = all_pairs(rest);
  // In thick cloth most pairs are nearer than the thickness at rest, so their target distance is smaller.
  const double thick = thickness * GENERATE(1, 40);
  std::size_t near = 0, listed = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    std::mt19937_64 random(seed);
    const Positions from = crumpled(rest, seed);
    Positions to = from;
    const Vector3 shared = test::random_vector(random, 1);
    for (Eigen::Index v = 0; v < to.rows(); ++v)
      to.row(v) += (shared + test::random_vector(random, 0.01)).transpose();
    const State<double> state =
        state_on_the_way<double>(from, to, std::vector<double>(static_cast<std::size_t>(to.rows()), 1.0));
    NearPairs<double> near_pairs({rest, make_pins(rest, {}, 0), {}}, thick);
    CHECK_FALSE(near_pairs.cover(state.position));
    near_pairs.begin(state, 0.001);
    CHECK(near_pairs.cover(state.position));
    std::set<std::pair<Pairing, std::array<int, 4>>> names;
    for (const NearPair& pair : near_pairs.pairs())
      names.insert({pair.pairing, sorted_name(pair.pairing, pair.vertices)});
    CHECK(names.size() == near_pairs.pairs().size());  // no duplicates
    for (const auto& [pairing, vertices] : pairs) {
      const double at_rest = shortest_gap(pairing, rows(rest.positions(), vertices)).vector.norm();
      const double target = std::min(thick, 0.5 * at_rest);
      // The smallest distance on the way through the substep counts.
      double least = 1e300;
      for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0})
        least =
            std::min(least, shortest_gap(pairing, rows(from + time * (to - from), vertices)).vector.norm());
      if (least > target) continue;
      ++near;
      CHECK(names.contains({pairing, sorted_name(pairing, vertices)}));
    }
    listed += names.size();
  }
  CHECK(near > 1000);                   // the sample is large enough
  CHECK(listed < near + pairs.size());  // the four lists do not simply hold all pairs
}

TEMPLATE_TEST_CASE("self-collision changes no bit if nothing is near", "[effects][self_collision]", float,
                   double) {
  const RestMesh rest(grid(1, 1, 16, 16));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "crossover");
  std::vector<std::uint64_t> acted;
  const auto end = [&](bool collides) {
    auto passes = test::effect_passes<TestType>("gravity");
    if (collides) append(passes, collision<TestType>(rest));
    const auto simulation = make_simulation<TestType>(input, std::move(passes));
    for (int s = 0; s < 10; ++s) REQUIRE(simulation->step());
    for (const PassStatistics& pass : simulation->passes())
      if (pass.name == "self_collision") acted.push_back(pass.acted);
    return simulation->positions();
  };
  const Positions with = end(true);
  CHECK(acted == std::vector<std::uint64_t>{0, 0});
  CHECK(with == end(false));
}

TEST_CASE("self-collision has no pass if every vertex is pinned", "[effects][self_collision]") {
  const RestMesh rest(grid(1, 1, 1, 1));
  CHECK(test::effect_passes<float>("self_collision", rest, make_pins(rest, {}, 0)).size() == 2);
  CHECK(test::effect_passes<float>("self_collision", rest, make_pins(rest, {0, 1, 2, 3}, 0)).empty());
}

TEMPLATE_TEST_CASE("self-collision gives the same bits in any numbering of vertices",
                   "[effects][self_collision]", float, double) {
  const RestMesh rest(grid(1, 1, 20, 20));
  const auto count = static_cast<std::size_t>(rest.vertex_count());
  std::mt19937_64 random(6);
  std::vector<int> permutation(count);
  std::iota(permutation.begin(), permutation.end(), 0);
  for (std::size_t i = count; i-- > 1;) std::swap(permutation[i], permutation[random() % (i + 1)]);
  const Positions from = accordion(rest, 3, 0.02);
  Positions to = from;
  for (Eigen::Index v = 0; v < to.rows(); ++v) to.row(v) += test::random_vector(random, 0.02).transpose();
  const auto after = [&](const std::vector<int>& where) {
    State<TestType> state = state_on_the_way<TestType>(from, to, std::vector<double>(count, 0.1), where);
    auto passes = collision<TestType>(rest, thickness, where);
    for (int iteration = 0; iteration < 3; ++iteration) CHECK(run(passes, Stage::project, state) > 0);
    run(passes, Stage::velocity, state);
    return positions_of(state, where);
  };
  // Sums over all vertices, whose rounding depends on the order, only widen boxes. Decisions are made pair by
  // pair.
  CHECK(after({}) == after(permutation));
}

TEMPLATE_TEST_CASE("the last pass removes all crossings that the iterations leave",
                   "[effects][self_collision]", float, double) {
  // Only the last pass runs. In every substep the displacements throw layers through each other. With seed 10
  // large zones turn far: a move after the last check for crossings would cross layers in the seventh
  // substep.
  const RestMesh rest(grid(1, 1, 16, 16));
  const std::vector<double> mass(static_cast<std::size_t>(rest.vertex_count()), 0.1);
  const double eps = static_cast<double>(std::numeric_limits<TestType>::epsilon());
  for (const std::uint64_t seed : {1U, 10U}) {
    std::mt19937_64 random(seed);
    Positions from = accordion(rest, 3, 0.03);
    REQUIRE(self_intersections(from, rest.triangles()).empty());
    auto passes = collision<TestType>(rest);
    for (int substep = 0; substep < 8; ++substep) {
      Positions to = 0.9 * from;
      for (Eigen::Index v = 0; v < to.rows(); ++v) to.row(v) += test::random_vector(random, 0.04).transpose();
      REQUIRE_FALSE(self_intersections(to, rest.triangles()).empty());
      State<TestType> state = state_on_the_way<TestType>(from, to, mass);
      run(passes, Stage::velocity, state);
      const Positions end = positions_of(state);
      INFO("seed " << seed << ", substep " << substep);
      CHECK(self_intersections(end, rest.triangles()).empty());
      // With equal masses the momentum is the sum of the moves. Thousands of moves round coordinates of up to
      // 0.5 m.
      CHECK((end.colwise().sum() - to.colwise().sum()).norm() <= 3e4 * eps * 0.5);
      from = end;
    }
  }
}

TEMPLATE_TEST_CASE("cloth between two pinned triangles that close moves by the mean of their moves",
                   "[effects][self_collision]", float, double) {
  // A free triangle lies between two pinned triangles. The upper one comes down so far that the gap is too
  // small for cloth, so pushes in any order would never end. All three then move as one, by the mean of the
  // pinned moves.
  TriangleMesh mesh;
  mesh.positions.resize(9, 3);
  mesh.positions << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 1, 0, 0, 1.1, 0, 0, 1, 0.1, 0, 2, 0, 0, 2.1, 0, 0, 2, 0.1,
      0;
  mesh.triangles = (Triangles(3, 3) << 0, 1, 2, 3, 4, 5, 6, 7, 8).finished();
  const RestMesh rest(mesh);
  Positions from = rest.positions();
  from.middleRows(3, 3) = from.topRows(3), from.bottomRows(3) = from.topRows(3);
  from.middleRows(3, 3).col(2).setConstant(0.01);
  from.bottomRows(3) << 0.02, 0.02, 0.005, 0.04, 0.02, 0.005, 0.02, 0.04, 0.005;
  Positions to = from;
  to.middleRows(3, 3).col(2).setConstant(1e-5);
  State<TestType> state = state_on_the_way<TestType>(from, to, std::vector<double>(9, 1.0));
  for (std::size_t v = 0; v < 6; ++v) state.position[v].w = state.previous[v].w = 0;
  auto passes = collision<TestType>(rest);
  run(passes, Stage::velocity, state);
  const Positions end = positions_of(state);
  CHECK((end.topRows(6) - to.topRows(6)).cwiseAbs().maxCoeff() < 1e-8);  // rounding to float
  Positions expected = from.bottomRows(3);
  expected.col(2).array() -= 0.5 * (0.01 - 1e-5);
  CHECK((end.bottomRows(3) - expected).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("a sheet folded four times falls onto itself without passing through",
          "[effects][self_collision]") {
  const RestMesh rest(grid(1, 1, 20, 20, Diagonal::alternating));
  const Pins pins = make_pins(rest, {}, 0);
  const auto intersections_after = [&](std::uint64_t seed, bool collides) {
    SimulationInput input = test::sheet(rest, pins, "crossover");
    input.positions = accordion(rest, 4, 0.02);
    std::mt19937_64 random(seed);
    for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
      input.positions.row(v) += test::random_vector(random, 0.1 * thickness).transpose();
    REQUIRE(self_intersections(input.positions, rest.triangles()).empty());
    auto passes = test::effect_passes<float>("gravity");
    passes.push_back(floor_at(-0.05F));
    if (collides) append(passes, collision<float>(rest));
    const auto simulation = make_simulation<float>(input, std::move(passes));
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    return self_intersections(simulation->positions(), rest.triangles()).size();
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed) CHECK(intersections_after(seed, true) == 0);
  CHECK(intersections_after(1, false) > 0);
}

TEST_CASE("self-collision gives the same bits with any number of threads", "[effects][self_collision]") {
  const RestMesh rest(grid(1, 1, 48, 48));
  const auto end = [&](int threads) {
    SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
    input.positions = accordion(rest, 4, 0.02);
    input.settings.threads = threads;
    auto passes = test::effect_passes<float>("gravity");
    passes.push_back(floor_at(-0.01F));
    append(passes, collision<float>(rest));
    const auto simulation = make_simulation<float>(input, std::move(passes));
    for (int s = 0; s < 10; ++s) REQUIRE(simulation->step());
    CHECK(simulation->passes().back().calls == 10);
    return simulation->positions();
  };
  CHECK(end(1) == end(3));
}

}  // namespace bendlab::self_collision_test
