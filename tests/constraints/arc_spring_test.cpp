// The buckled segment, compared with its closed forms, with an independent table and with its own equations.
#include "bendlab/constraints/arc_spring.hpp"

#include "bendlab/constraints/energy.hpp"
#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/solver/colouring.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::arc_spring_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Law = ArcSpring::Law;

// P L²/k_b = (κL)² / (sinc y - cos y) at r/L = sinc y, with y from Brent's method in SciPy. All printed
// digits are exact.
struct TableRow {
  double ratio, push;
};
constexpr TableRow table[] = {{0.0, 39.478418},   {0.025, 36.763322}, {0.1, 30.746068}, {0.25, 23.650478},
                              {0.5, 17.547251},   {0.75, 14.177052},  {0.9, 12.773224}, {0.95, 12.372806},
                              {0.975, 12.183142}, {1.0, 12.0}};

// Pairs that share no vertices, with random stiffness, mass, length and multiplier.
template <class Real>
struct Pairs {
  ElementList<ArcSpring> list;
  Points<Real> points;
  ElementBatch<Real, ArcSpring> batch;

  Pairs(int count, Law law, unsigned seed) : points(static_cast<std::size_t>(2 * count) + dummy_points) {
    std::mt19937_64 random(seed);
    const auto power = [&](double low, double high) {
      return std::pow(10, test::uniform(random, low, high));
    };
    list.law = law;
    std::vector<double> held;
    for (int pair = 0; pair < count; ++pair) {
      const double length = power(-2, 1), w = power(-1, 4), to_push = power(-6, 8) / (length / w);
      const double ratio = pair % 3 ? test::uniform(random, 0.01, 1.2) : 1 - power(-7, -0.1);
      for (const int end : {0, 1}) {
        Point<Real>& point = points[static_cast<std::size_t>(2 * pair + end)];
        point.set((Vector3(1, 2, -2) / 3 * (end - 0.5) * ratio * length).cast<Real>());
        point.w = static_cast<Real>(end && pair % 5 == 0 ? 0 : w);
      }
      list.vertices.push_back({2 * pair, 2 * pair + 1});
      list.rest.push_back({length});
      list.softness.push_back(to_push / (length * length));
      held.push_back(pair % 2 ? test::uniform(random, 0, 38) / to_push : 0);
    }
    batch = make_element_batch<Real>(list, colour_order(list.vertices, 2 * count), 2 * count);
    batch.kind = StiffnessKind::compliance, batch.compliance = 1;
    for (const int pair : batch.order.constraint_of_lane())
      batch.multiplier.push_back(pair < 0 ? Real(0)
                                          : static_cast<Real>(held[static_cast<std::size_t>(pair)]));
  }
};

template <class Real>
Vector3 at(const Points<Real>& points, int vertex) {
  return points[static_cast<std::size_t>(vertex)].vector().template cast<double>();
}

}  // namespace

TEST_CASE("the push of a buckled segment agrees with the table", "[constraints]") {
  for (const auto& [ratio, push] : table)
    CHECK_THAT(ArcSpring::push(ratio, Law::exact), WithinAbs(push, 6e-7));  // half of the last digit
  // By hand: 12 for a straight segment, 4π² for a closed segment.
  CHECK_THAT(ArcSpring::bent(0, Law::exact).push, WithinAbs(12, 1e-14));
  CHECK_THAT(ArcSpring::bent(1, Law::exact).push, WithinRel(4 * std::numbers::pi * std::numbers::pi, 1e-14));
  // -4 p(0) and -4 p(1).
  CHECK_THAT(ArcSpring::push(0, Law::polynomial), WithinAbs(38.852, 1e-12));
  CHECK_THAT(ArcSpring::push(1, Law::polynomial), WithinAbs(12.112, 1e-12));
  for (int i = 0; i <= 400; ++i) {
    const double exact = ArcSpring::push(i / 400.0, Law::exact);
    CHECK_THAT(ArcSpring::push(i / 400.0, Law::polynomial), WithinRel(exact, 0.016));
  }
}

TEST_CASE("an arc states the correct slope and curvature of its energy", "[constraints]") {
  const double length = 0.7;
  for (const Law law : {Law::exact, Law::polynomial})
    for (const double ratio : {0.0, 0.02, 0.3, 0.7, 0.9, 0.955, 0.97, 0.999}) {
      CAPTURE(ratio, ArcSpring::law_names[static_cast<std::size_t>(law)]);
      const double value = (ratio - 1) * length, step = 1e-5 * length;
      const auto at = [&](double c) { return ArcSpring::potential(c, {length}, law); };
      if (ratio > 0) {
        CHECK_THAT(at(value).slope,
                   WithinRel((at(value + step).energy - at(value - step).energy) / (2 * step), 1e-7));
        CHECK_THAT(at(value).curvature,
                   WithinRel((at(value + step).slope - at(value - step).slope) / (2 * step), 1e-6));
      }
      CHECK_THAT(-at(value).slope * length * length, WithinRel(ArcSpring::push(ratio, law), 1e-12));
    }
  // In the straight state P = 12 k_b/L², and rises by 7.2 per unit of r/L (series: 12 + 6/5 y², r/L = 1 -
  // y²/6).
  CHECK_THAT(ArcSpring::potential(0, {length}, Law::exact).curvature,
             WithinRel(7.2 / std::pow(length, 3), 1e-12));
  CHECK_THAT(ArcSpring::potential(-1e-9 * length, {length}, Law::exact).curvature,
             WithinRel(7.2 / std::pow(length, 3), 1e-6));
}

TEST_CASE("the series and the closed form of the arc's push agree where they meet", "[constraints]") {
  // The first three terms of 1/e with e = 1/3 - z/30 + z²/840, z = y²: 12 + 6 z/5 + (3/25 - 3/70) z² + O(z³).
  for (const double y : {1e-8, 1e-4, 1e-2}) {
    const double z = y * y;
    CHECK_THAT(ArcSpring::bent(y / std::numbers::pi, Law::exact).push,
               WithinRel(12 + 1.2 * z + (0.12 - 3.0 / 70) * z * z, 1e-13));
  }
  // At y = 0.5 the closed form subtracts two numbers near 1. Their difference is a twelfth, and right to a
  // dozen ε.
  const double at = 0.5 / std::numbers::pi, step = 1e-9;
  const double below = ArcSpring::bent(at - step, Law::exact).push,
               above = ArcSpring::bent(at + step, Law::exact).push;
  const double slope = 1.2 * 2 * 0.5 * std::numbers::pi;  // dP/dt to 4 %
  CHECK_THAT(above - below, WithinAbs(2 * step * slope, 0.1 * 2 * step * slope + 1e-13));
}

TEST_CASE("a buckled segment's force is the slope of its energy", "[constraints]") {
  for (const Law law : {Law::exact, Law::polynomial})
    for (const double length : {0.02, 3.0})
      for (const double ratio : {0.05, 0.3, 0.7, 0.95, 0.999}) {
        // Central differences with a step of 10⁻⁵ L: their error is 10⁻¹⁰ of the third derivative, and
        // rounding adds 10⁻¹⁶/10⁻⁵ of the energy.
        const auto energy = [&](double r) { return ArcSpring::energy((r - 1) * length, {length}, law); };
        const double slope = (energy(ratio + 1e-5) - energy(ratio - 1e-5)) / (2e-5 * length);
        CHECK_THAT(-slope * length * length, WithinRel(ArcSpring::push(ratio, law), 1e-7));
      }
  // A half circle has the energy ½ L κ² with κ = π / L. Its chord is 2/π of its length.
  const double half_circle = 2 / std::numbers::pi - 1;
  CHECK_THAT(ArcSpring::energy(3 * half_circle, {3}, Law::exact),
             WithinRel(std::numbers::pi * std::numbers::pi / 6, 1e-13));
  for (const Law law : {Law::exact, Law::polynomial}) CHECK(ArcSpring::energy(0.1, {3}, law) == 0);
}

TEMPLATE_TEST_CASE("projecting a buckled segment solves its equations", "[constraints]", float, double) {
  constexpr double ulp = static_cast<double>(std::numeric_limits<TestType>::epsilon());
  for (const Law law : {Law::exact, Law::polynomial}) {
    const double limit = law == Law::exact ? 12 : 12.112;
    Pairs<TestType> before(6000, law, 21), after = before, oracle = before;
    project(after.points.data(), after.batch, 0, after.batch.order.stack_count(), TestType(1));
    project_by_oracle(oracle.points.data(), oracle.batch, TestType(1));
    std::array<int, 3> solved{};  // released, straight, buckled
    const std::vector<int> pair_of_lane = before.batch.order.constraint_of_lane();
    for (std::size_t lane = 0; lane < pair_of_lane.size(); ++lane) {
      const int pair = pair_of_lane[lane];
      if (pair < 0) continue;
      const auto distance = [&](const Points<TestType>& points) {
        return (at(points, 2 * pair) - at(points, 2 * pair + 1)).norm();
      };
      const auto corner = static_cast<std::size_t>(2 * pair);
      const double length = static_cast<double>(before.batch.rest[0][lane]),
                   w = static_cast<double>(before.points[corner].w + before.points[corner + 1].w),
                   to_push = static_cast<double>(before.batch.softness[lane]) * length * length;
      const double held = static_cast<double>(before.batch.multiplier[lane]),
                   multiplier = static_cast<double>(after.batch.multiplier[lane]);
      const double r = distance(before.points), moved = distance(after.points);
      INFO("pair " << pair << " r/L " << r / length << " to " << moved / length << ", P from "
                   << held * to_push << " to " << multiplier * to_push << ", yielding "
                   << to_push * length / w);
      // Positions and multipliers are rounded, and the length of the gradient is 1 up to two ε.
      CHECK(std::abs(moved - r - w * (multiplier - held)) <=
            8 * ulp * (length + r + w * std::max(multiplier, held)));
      // The new r is right to a few ε L, and the push changes by up to 118 k_b/L³ times this error.
      const double push = multiplier * to_push, ratio = moved / length;
      if (push == 0) {
        CHECK(ratio >= 1 - 8 * ulp);
        ++solved[0];
      } else if (push <= limit) {
        CHECK_THAT(ratio, WithinAbs(1, 8 * ulp));
        CHECK(push > 0);
        ++solved[1];
      } else {
        CHECK_THAT(push, WithinAbs(ArcSpring::push(std::min(ratio, 1.0), law), 1e3 * ulp));
        ++solved[2];
      }
      // The oracle's bisection starts from an r with different rounding. This changes the length of a stiff
      // pair, and the load of a soft pair.
      CHECK_THAT(ratio, WithinAbs(distance(oracle.points) / length, 40 * ulp));
      const double yielding = to_push * length / w;
      CHECK_THAT(push, WithinAbs(static_cast<double>(oracle.batch.multiplier[lane]) * to_push,
                                 ulp * (1e3 + 8 * yielding)));
    }
    for (const int count : solved) CHECK(count > 300);  // each case has at least a twentieth of the pairs
  }
}

TEMPLATE_TEST_CASE("a buckled segment never pulls", "[constraints]", float, double) {
  for (const Law law : {Law::exact, Law::polynomial})
    for (const StiffnessKind kind : {StiffnessKind::k, StiffnessKind::compliance}) {
      Pairs<TestType> pairs(64, law, 22);
      for (std::size_t pair = 0; pair < 64; ++pair) {
        pairs.points[2 * pair].set({0, 0, 0});
        const double stretch = pair % 2 ? 1 : 1 + 0.1 * static_cast<double>(pair);  // at rest, or in tension
        pairs.points[2 * pair + 1].set({static_cast<TestType>(stretch * pairs.list.rest[pair][0]), 0, 0});
      }
      const Points<TestType> start = pairs.points;
      pairs.batch.kind = kind;
      pairs.batch.multiplier.assign(pairs.batch.multiplier.size(), 0);
      project(pairs.points.data(), pairs.batch, 0, pairs.batch.order.stack_count(), TestType(1));
      for (std::size_t v = 0; v < 128; ++v)  // at rest, r is right to two or three ε
        CHECK(static_cast<double>((pairs.points[v].vector() - start[v].vector()).norm()) <=
              4 * static_cast<double>(std::numeric_limits<TestType>::epsilon()) * pairs.list.rest[v / 2][0]);
    }
}

TEMPLATE_TEST_CASE("a buckled segment is damped only while it is compressed", "[constraints]", float,
                   double) {
  Pairs<TestType> pairs(2, Law::exact, 23);
  Points<TestType> velocities(pairs.points.size());
  for (const std::size_t pair : {0u, 1u}) {
    const auto length = static_cast<TestType>(pairs.list.rest[pair][0]);
    pairs.points[2 * pair] = {0, 0, 0, 1};
    pairs.points[2 * pair + 1] = {(pair ? TestType(1.1) : TestType(0.9)) * length, 0, 0, 1};
    velocities[2 * pair].set({1, 2, 3});
    velocities[2 * pair + 1].set({-1, 2, -3});
  }
  for (const bool oracle : {false, true}) {
    Points<TestType> damped = velocities;
    if (oracle)
      damp_by_oracle(pairs.points.data(), damped.data(), pairs.batch, TestType(1));
    else
      damp(pairs.points.data(), damped.data(), pairs.batch, TestType(1));
    // With equal masses, both vertices lose their velocity along the pair. All numbers are small.
    constexpr auto rounding = 4 * std::numeric_limits<TestType>::epsilon();
    CHECK((damped[0].vector() - Vector3Of<TestType>(0, 2, 3)).norm() <= rounding);
    CHECK((damped[1].vector() - Vector3Of<TestType>(0, 2, -3)).norm() <= rounding);
    for (const std::size_t v : {2u, 3u}) CHECK(damped[v].vector() == velocities[v].vector());
  }
}

TEST_CASE("a segment loaded along its axis stays straight up to 12 k_b / L²", "[constraints]") {
  constexpr double length = 0.3, k_b = 2e-3, h = 0.01;
  constexpr TableRow loads[] = {{1, 3},           {1, 11.99},       {0.975, 12.183142},
                                {0.9, 12.773224}, {0.5, 17.547251}, {0.1, 30.746068}};
  for (const auto& [ratio, load] : loads) {
    ElementList<ArcSpring> list{.vertices = {{0, 1}}, .rest = {{length}}, .softness = {1}};
    auto batch = make_element_batch<double>(list, colour_order(list.vertices, 2), 2);
    batch.kind = StiffnessKind::compliance, batch.compliance = 1 / k_b;
    Points<double> points(2 + dummy_points);
    points[0] = {-length / 2, 0, 0, 50}, points[1] = {length / 2, 0, 0, 20};
    // Implicit steps that each lose half of the velocity. The rest state does not depend on this damping.
    std::array<double, 2> velocity{};
    for (int step = 0; step < 3000; ++step) {
      const std::array<double, 2> before = {points[0].x, points[1].x};
      for (const std::size_t end : {0u, 1u})
        points[end].x +=
            h * velocity[end] + h * h * points[end].w * (end ? -1 : 1) * load * k_b / (length * length);
      batch.multiplier.assign(batch.order.lane_count(), 0);
      project(points.data(), batch, 0, 1, h);
      for (const std::size_t end : {0u, 1u}) velocity[end] = 0.5 * (points[end].x - before[end]) / h;
    }
    // The push in the table is right to 5·10⁻⁷, and changes by 7 or more per unit of r/L.
    CHECK_THAT((points[1].x - points[0].x) / length, WithinAbs(ratio, 1e-7));
  }
}

}  // namespace bendlab::arc_spring_test
