// Rounding causes no wild corrections in effects that move vertices. For any pose and any pins, each move is
// finite and bounded, keeps the momentum if the effect promises this, and does not increase the error that it
// should reduce.
#include "bendlab/effects/obstacle.hpp"
#include "bendlab/io/without_traps.hpp"
#include "tests/catch.hpp"
#include "tests/effects/one_pass.hpp"
#include "tests/poses.hpp"

namespace bendlab::effects_bounded_moves_test {
namespace {

using test::Poses, test::poses, test::size_of_pose;

constexpr std::array<double, 3> units = {1, 1e-3, 1e3};

template <std::size_t N>
Pins pins_of(const RestMesh& rest, const std::array<double, N>& mass) {
  std::vector<int> pinned;
  for (std::size_t i = 0; i < N; ++i)
    if (mass[i] == 0) pinned.push_back(static_cast<int>(i));
  return make_pins(rest, pinned, 0);
}

template <std::size_t N>
RestMesh mesh_of(const std::array<Vector3, N>& corners, std::initializer_list<std::array<int, 3>> triangles) {
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(N), 3);
  for (std::size_t i = 0; i < N; ++i)
    mesh.positions.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  Eigen::Index row = 0;
  for (const auto& t : triangles) mesh.triangles.row(row++) << t[0], t[1], t[2];
  return RestMesh(std::move(mesh));
}

// The state of a mesh whose vertices are the corners of a pose.
template <class Real, std::size_t N>
State<Real> state_of(const RestMesh& rest, const std::array<Vector3, N>& now,
                     const std::array<double, N>& mass) {
  State<Real> state = test::state_of<Real>(rest, pins_of(rest, mass));
  for (std::size_t i = 0; i < N; ++i) {
    state.position[i].set(now[i].template cast<Real>());
    if (mass[i] > 0) state.mass[i] = mass[i], state.position[i].w = static_cast<Real>(1 / mass[i]);
  }
  state.previous = state.position;
  return state;
}

struct Moves {
  bool finite = true;
  double farthest = 0, position = 0;  // m
  Vector3 momentum = Vector3::Zero();
  double momentum_scale = 0, masses = 0;
};

template <class Real>
Moves moves_of(const State<Real>& state, const Points<Real>& before) {
  Moves moves;
  for (std::size_t v = 0; v < state.mass.size(); ++v) {
    const Vector3 from = before[v].vector().template cast<double>(),
                  way = state.position[v].vector().template cast<double>() - from;
    moves.finite = moves.finite && way.allFinite();
    moves.farthest = std::max(moves.farthest, way.norm()),
    moves.position = std::max(moves.position, from.norm());
    moves.momentum += state.mass[v] * way, moves.momentum_scale += state.mass[v] * way.norm();
    moves.masses += state.mass[v];
    if (state.position[v].w == 0) REQUIRE(way == Vector3::Zero());
  }
  return moves;
}

}  // namespace

TEMPLATE_TEST_CASE("a push on points of the cloth is bounded, whichever corners are pinned", "[effects]",
                   float, double) {
  constexpr double epsilon = std::numeric_limits<TestType>::epsilon();
  std::mt19937_64 random(11);
  for (const double unit : units) {
    const Poses<3> all = poses<3>(21, unit);
    for (std::size_t c = 0; c < all.size(); ++c) {
      const RestMesh rest = mesh_of(all.rest[c], {{0, 1, 2}});
      State<TestType> state = state_of<TestType>(rest, all.now[c], all.mass[c]);
      const Points<TestType> before = state.position;
      // A point of the triangle: anywhere, or next to a corner up to rounding. This corner may be pinned.
      const auto near = static_cast<std::size_t>(random() % 4);
      std::array<TestType, 3> weights;
      TestType sum = 0;
      for (std::size_t i = 0; i < 3; ++i)
        sum += weights[i] = near == 3   ? TestType(test::uniform(random, 0, 1))
                            : near == i ? TestType(1)
                                        : TestType(test::uniform(random, 0, 3) * epsilon);
      for (TestType& weight : weights) weight /= sum;
      const Vector3Of<TestType> normal = test::random_vector(random).normalized().cast<TestType>();
      const double depth = unit * std::pow(10, test::uniform(random, -9, 1));
      const Constraints<TestType> none;
      PassContext<TestType> context{state, none, TestType(1e-3)};
      const obstacle::Step<TestType> step({}, context);
      obstacle::push_together<TestType, 3>(context, step, {0, 1, 2}, weights, normal, TestType(depth), true);

      const Moves moves = moves_of(state, before);
      const double size = std::max(size_of_pose(all.now[c], all.now[c]), depth);
      const double rounding = 4 * epsilon * moves.position;
      CAPTURE(c, near, depth, size, moves.farthest);
      REQUIRE(moves.finite);
      REQUIRE(moves.farthest <= largest_move * size * (1 + 1e2 * epsilon) + rounding);
      // The point itself moves outwards, by its depth at most.
      double way = 0;
      for (std::size_t i = 0; i < 3; ++i)
        way += static_cast<double>(weights[i]) * (state.position[i].vector() - before[i].vector())
                                                     .template cast<double>()
                                                     .dot(normal.template cast<double>());
      CHECK(way >= -rounding);
      CHECK(way <= depth * (1 + 1e2 * epsilon) + rounding);
    }
  }
}

TEMPLATE_TEST_CASE("each push of a ball on a triangle is bounded", "[effects]", float, double) {
  const WithoutTraps overflow;  // on purpose
  constexpr double epsilon = std::numeric_limits<TestType>::epsilon();
  for (const double unit : units) {
    const Poses<3> all = poses<3>(22, unit);
    std::uint64_t acted = 0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      const RestMesh rest = mesh_of(all.rest[c], {{0, 1, 2}});
      State<TestType> state = state_of<TestType>(rest, all.now[c], all.mass[c]);
      const Points<TestType> before = state.position;
      // The ball is at the triangle's middle, so it touches faces, edges and vertices.
      const Vector3 middle = (all.now[c][0] + all.now[c][1] + all.now[c][2]) / 3;
      const double radius = 0.3 * unit, thickness = 0.01 * unit;
      auto passes =
          test::passes_of<TestType>("sphere", rest, make_pins(rest, {}, 0),
                                    {{"centre", std::vector<double>(middle.data(), middle.data() + 3)},
                                     {"radius", radius},
                                     {"thickness", thickness}});
      acted += test::run(passes, state, 1e-3);
      const Moves moves = moves_of(state, before);
      const double size = std::max(size_of_pose(all.now[c], all.now[c]), radius + thickness);
      CAPTURE(c, size, moves.farthest);
      REQUIRE(moves.finite);
      // A corner is pushed by itself, then with two edges and with the face, each time by at most two sizes
      // of the current triangle. So the moves are at most 2, 3 × 2, 3 × 6 and 3 × 18 sizes.
      REQUIRE(moves.farthest <= 54 * size + 4 * epsilon * moves.position);
    }
    CHECK(acted > all.size());
  }
}

TEMPLATE_TEST_CASE("self-collision moves cloth by a bounded multiple of the size of its triangles",
                   "[effects]", float, double) {
  const WithoutTraps overflow;  // on purpose
  constexpr double epsilon = std::numeric_limits<TestType>::epsilon();
  for (const double unit : units) {
    // The triangle of the pose, and a second triangle that is far away from it at rest.
    const Poses<3> all = poses<3>(23, unit), second = poses<3>(24, unit);
    std::uint64_t acted = 0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      std::array<Vector3, 6> corners, now;
      std::array<double, 6> mass;
      const Vector3 meet = second.now[c][0] - all.now[c][0];
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = all.rest[c][i], corners[i + 3] = second.rest[c][i] + 100 * unit * Vector3::UnitX();
        now[i] = all.now[c][i] + meet + 0.004 * unit * Vector3::UnitZ(), now[i + 3] = second.now[c][i];
        mass[i] = all.mass[c][i], mass[i + 3] = second.mass[second.size() - 1 - c][i];
      }
      const RestMesh rest = mesh_of(corners, {{0, 1, 2}, {3, 4, 5}});
      State<TestType> state = state_of<TestType>(rest, now, mass);
      auto passes = test::passes_of<TestType>("self_collision", rest, make_pins(rest, {}, 0),
                                              {{"thickness", 0.01 * unit}});
      const Points<TestType> before = state.position;
      acted += test::run(passes, state, 1e-2);
      const Moves moves = moves_of(state, before);
      const double size = size_of_pose(now, now);
      CAPTURE(c, size, moves.farthest);
      REQUIRE(moves.finite);
      // A vertex is in up to three pairs with the other face, and in up to six pairs of edges.
      REQUIRE(moves.farthest <= 9 * largest_move * size + 4 * epsilon * moves.position);
      if (std::ranges::none_of(mass, [](double m) { return m == 0; }))
        REQUIRE(moves.momentum.norm() <=
                1e2 * epsilon * (moves.momentum_scale + moves.masses * moves.position));
    }
    CHECK(acted > all.size() / 2);
  }
}

TEMPLATE_TEST_CASE("a tether pulls back only vertices that are too far away", "[effects]", float, double) {
  constexpr double epsilon = std::numeric_limits<TestType>::epsilon();
  for (const double unit : units) {
    const Poses<3> all = poses<3>(25, unit);
    std::uint64_t acted = 0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      const RestMesh rest = mesh_of(all.rest[c], {{0, 1, 2}});
      const Pins pins = pins_of(rest, all.mass[c]);
      State<TestType> state = state_of<TestType>(rest, all.now[c], all.mass[c]);
      const Points<TestType> before = state.position;
      auto passes = test::passes_of<TestType>("tethers", rest, pins, {{"distance", "straight"}});
      acted += test::run(passes, state, 1e-3);
      const Moves moves = moves_of(state, before);
      const double size = size_of_pose(all.now[c], all.now[c]), rounding = 8 * epsilon * moves.position;
      CAPTURE(c, size, moves.farthest);
      REQUIRE(moves.finite);
      REQUIRE(moves.farthest <= size + rounding);
      for (int v = 0; v < 3; ++v) {
        if (pins.pinned(v) || pins.all.empty()) continue;
        const int pin = *std::ranges::min_element(
            pins.all, {}, [&](int p) { return (rest.position(p) - rest.position(v)).norm(); });
        const auto distance = [&](const Points<TestType>& points) {
          const auto at = [&](int i) -> Vector3 {
            return points[static_cast<std::size_t>(i)].vector().template cast<double>();
          };
          return (at(v) - at(pin)).norm();
        };
        const double length = (rest.position(v) - rest.position(pin)).norm();
        CHECK(distance(state.position) <= std::max(length, 0.0) + rounding);
        if (distance(before) <= length - rounding) CHECK(distance(state.position) == distance(before));
      }
    }
    CHECK(acted > all.size() / 4);
  }
}

TEMPLATE_TEST_CASE("strain limiting moves vertices by a bounded multiple of the triangle's size", "[effects]",
                   float, double) {
  constexpr double epsilon = std::numeric_limits<TestType>::epsilon();
  for (const double unit : units) {
    const Poses<3> all = poses<3>(26, unit);
    std::uint64_t acted = 0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      const RestMesh rest = mesh_of(all.rest[c], {{0, 1, 2}});
      State<TestType> state = state_of<TestType>(rest, all.now[c], all.mass[c]);
      const Points<TestType> before = state.position;
      auto passes = test::passes_of<TestType>("strain_limiting", rest, pins_of(rest, all.mass[c]));
      acted += test::run(passes, state, 1e-3);
      const Moves moves = moves_of(state, before);
      const double size = size_of_pose(all.now[c], all.rest[c]), rounding = 8 * epsilon * moves.position;
      CAPTURE(c, size, moves.farthest);
      REQUIRE(moves.finite);
      REQUIRE(moves.farthest <= largest_move * size + rounding);
      if (std::ranges::none_of(all.mass[c], [](double m) { return m == 0; }))
        REQUIRE(moves.momentum.norm() <= 1e2 * epsilon * moves.masses * (size + moves.position));
    }
    CHECK(acted > all.size() / 4);
  }
}

}  // namespace bendlab::effects_bounded_moves_test
