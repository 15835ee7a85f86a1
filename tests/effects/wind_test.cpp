// Wind agrees with its force law, written here with angles, and respects its bounds.
#include <numbers>

#include "bendlab/effects/gusts.hpp"
#include "tests/catch.hpp"
#include "tests/effects/one_pass.hpp"

namespace bendlab::wind_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double density = 0.2, gravity = 9.81;                                 // kg/m², m/s²
constexpr double air_density = 1.204, drag_of_plate = 1.28, lift_of_plate = 1;  // the defaults

Value numbers(const Vector3& v) {
  return std::vector<double>{v.x(), v.y(), v.z()};
}

// Drag and lift of a flat piece of area A. Its unit normal n is at the angle θ to the flow `wind`. Drag is
// ½ ρ C_D A cos θ |u|² along the wind. Lift is ½ ρ C_L A cos θ sin θ |u|² across the wind, towards the normal
// that has n·wind > 0.
struct Law {
  Vector3 drag = Vector3::Zero(), lift = Vector3::Zero();

  Law(double area, Vector3 n, const Vector3& wind) {
    const double speed = wind.norm(), pressure = 0.5 * air_density * speed * speed;
    if (speed == 0) return;
    if (n.dot(wind) < 0) n = -n;
    const double theta = std::acos(std::min(1.0, n.dot(wind) / speed));
    drag = pressure * drag_of_plate * area * std::cos(theta) * wind / speed;
    const Vector3 across = n - n.dot(wind) / speed * wind / speed;
    if (across.norm() > 0)
      lift = pressure * lift_of_plate * area * std::cos(theta) * std::sin(theta) * across.normalized();
  }
};

RestMesh one_triangle() {
  TriangleMesh mesh;
  mesh.positions.resize(3, 3);
  mesh.positions << 0, 0, 0, 0.4, 0.1, 0, 0.1, 0.5, 0;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  return RestMesh(mesh);
}

// A crumpled, stretched free sheet whose vertices move at random.
State<double> crumpled(const RestMesh& rest, double speed) {
  State<double> state = test::state_of<double>(rest, make_pins(rest, {}, 0));
  std::mt19937_64 random(7);
  for (std::size_t v = 0; v < state.mass.size(); ++v) {
    const Vector3 moved = 1.2 * state.position[v].vector() + test::random_vector(random, 0.03);
    state.position[v].set(moved);
    state.velocity[v].set(test::random_vector(random, speed));
  }
  return state;
}

// The terminal speed, m/s, of a free level sheet in air at rest.
double terminal_speed(bool wind_first, double dt) {
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins none = make_pins(rest, {}, 0);
  SimulationInput input = test::sheet(rest, none, "crossover");
  input.settings.dt = dt;
  auto passes = test::passes_of<double>("wind", rest, none, {{"velocity", numbers(Vector3::Zero())}});
  passes.insert(wind_first ? passes.end() : passes.begin(), test::effect_passes<double>("gravity").front());
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int s = 0; s < 4 / dt; ++s) REQUIRE(simulation->step());  // 4 s are 25 v/g, long enough
  CHECK(simulation->velocities().leftCols<2>().cwiseAbs().maxCoeff() < 1e-9);
  return -simulation->velocities().col(2).mean();
}

}  // namespace

TEST_CASE("wind: the terminal velocity of a level sheet", "[effects]") {
  const double law = std::sqrt(2 * density * gravity / (air_density * drag_of_plate));  // 1.6 m/s
  // If wind is listed before gravity, it acts on the velocity at the start of the substep: h k v² = h g. The
  // tolerance is the rounding of (x - x') / dt a few metres down.
  for (const double dt : {1.0 / 60, 1.0 / 240}) {
    CHECK_THAT(terminal_speed(true, dt), WithinRel(law, 1e-9));
    // If wind is listed after gravity, k (v + h g)² = g. Scenes always put wind first.
    CHECK_THAT(terminal_speed(false, dt), WithinRel(law - gravity * dt, 1e-9));
  }
}

TEST_CASE("wind: drag along the flow and lift across the flow follow the law", "[effects]") {
  const RestMesh rest = one_triangle();
  const Pins none = make_pins(rest, {}, 0);
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    const Vector3 wind = test::random_vector(random, 5), own = test::random_vector(random, 2);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(4 * i, test::random_vector(random).normalized()));
    for (const bool with_lift : {false, true}) {
      State<double> state = test::state_of<double>(rest, none);
      for (std::size_t v = 0; v < 3; ++v) {
        state.position[v].set(turn * state.position[v].vector());
        state.velocity[v].set(own);
      }
      auto passes = test::passes_of<double>(
          "wind", rest, none,
          {{"velocity", numbers(wind)}, {"lift_coefficient", with_lift ? lift_of_plate : 0.0}});
      const double h = 1e-3;
      CHECK(test::run(passes, state, h) == 1);
      const Vector3 force = (test::weighted_sum(state, state.velocity) - 3 * state.mass[0] * own) / h;
      const Law law(rest.areas()[0], turn * Vector3::UnitZ(), wind - own);
      const Vector3 expected = with_lift ? Vector3(law.drag + law.lift) : law.drag;
      // 1e-9: rounding of a change of 1e-3 of the velocity, and of sin(acos) near 0° and 90°.
      CHECK((force - expected).norm() <= 1e-9 * expected.norm());
    }
  }
}

TEST_CASE("wind: without flow, or with flow along the cloth, there is no force", "[effects]") {
  const RestMesh rest(grid(1, 1, 3, 3));
  const Pins none = make_pins(rest, {}, 0);
  auto passes = test::passes_of<double>("wind", rest, none, {{"velocity", numbers({0.3, -0.2, 0})}});
  State<double> still = test::state_of<double>(rest, none);  // the wind blows along the level sheet
  CHECK(test::run(passes, still, 0.01) == 0);
  CHECK(test::kinetic_energy(still) == 0);
  State<double> carried = crumpled(rest, 0);
  for (std::size_t v = 0; v < carried.mass.size(); ++v) carried.velocity[v].set({0.3, -0.2, 0});
  test::run(passes, carried, 0.01);
  CHECK(test::kinetic_energy(carried, {0.3, -0.2, 0}) < 1e-30);  // the mean of three equal numbers is rounded
}

TEST_CASE("wind: the momentum of the cloth changes by the sum of all forces", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 8, 4));
  State<double> state = crumpled(rest, 0.5);
  const Vector3 wind(3, 2, -1);
  Vector3 force = Vector3::Zero();
  double sizes = 0;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = [&](int c) { return static_cast<std::size_t>(rest.triangles()(t, c)); };
    const auto x = [&](int c) { return state.position[corner(c)].vector(); };
    const auto v = [&](int c) { return state.velocity[corner(c)].vector(); };
    const Vector3 doubled = (x(1) - x(0)).cross(x(2) - x(0));
    const Law law(doubled.norm() / 2, doubled.normalized(), wind - (v(0) + v(1) + v(2)) / 3);
    force += law.drag + law.lift, sizes += law.drag.norm();
  }
  const Vector3 before = test::weighted_sum(state, state.velocity);
  auto passes = test::passes_of<double>("wind", rest, make_pins(rest, {}, 0), {{"velocity", numbers(wind)}});
  const double h = 1e-4;  // so short that no impulse reaches its bound
  CHECK(test::run(passes, state, h) == static_cast<std::uint64_t>(rest.triangle_count()));
  const Vector3 gained = test::weighted_sum(state, state.velocity) - before;
  CHECK((gained - h * force).norm() <= 1e-10 * h * sizes);  // rounding: velocities are 10³ times their change
}

TEST_CASE("wind: for any step, the energy of free cloth relative to the air never rises", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 8, 4));
  const Pins none = make_pins(rest, {}, 0);
  for (const double lift : {0.0, 1.0, 10.0})
    for (const double h : {1e-4, 1.0 / 60, 1.0, 1e4})
      for (const double speed : {0.1, 10.0, 1e3}) {
        const Vector3 wind = speed * Vector3(0.6, 0, 0.8);
        auto passes = test::passes_of<double>("wind", rest, none,
                                              {{"velocity", numbers(wind)}, {"lift_coefficient", lift}});
        State<double> state = crumpled(rest, 2);
        for (int step = 0; step < 20; ++step) {
          const double before = test::kinetic_energy(state, wind);
          test::run(passes, state, h);
          CHECK(test::kinetic_energy(state, wind) <= (1 + 1e-14) * before);  // rounding of the sum
        }
      }
}

TEST_CASE("wind: the lightest corner of a triangle bounds the impulse", "[effects]") {
  const RestMesh rest = one_triangle();
  const Vector3 wind(3, 4, 100);
  auto passes = test::passes_of<double>("wind", rest, make_pins(rest, {}, 0), {{"velocity", numbers(wind)}});
  for (std::size_t light = 0; light < 3; ++light) {
    State<double> state = test::state_of<double>(rest, make_pins(rest, {}, 0));
    state.mass[light] *= 1e-3;
    state.position[light].w *= 1e3;
    const double before = test::kinetic_energy(state, wind);
    test::run(passes, state, 1.0 / 60);
    INFO("corner " << light);
    CHECK(state.velocity[light].vector().norm() > 0.1 * wind.norm());
    // Each corner is like a free piece in a steady wind: its speed relative to the air does not grow.
    CHECK((state.velocity[light].vector() - wind).norm() <= (1 + 1e-14) * wind.norm());
    CHECK(test::kinetic_energy(state, wind) <= before);
  }
}

TEST_CASE("wind: a gust of a hundred times the weight does not tear a flag apart", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 10, 4));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  // ½ ρ C_D U² = 100 ρ_s g
  const double speed = 10 * std::sqrt(2 * density * gravity / (air_density * drag_of_plate));
  auto passes = test::passes_of<double>(
      "wind", rest, pins,
      {{"velocity", numbers(speed * Vector3(0.8, 0, 0.6))}, {"gust_amplitude", 0.5}, {"gust_time", 0.1}});
  passes.push_back(test::effect_passes<double>("gravity").front());
  const auto simulation = make_simulation<double>(test::sheet(rest, pins, "crossover"), std::move(passes));
  for (int s = 0; s < 300; ++s) {
    REQUIRE(simulation->step());
    // The flag is pinned. Like the end of a whip, a vertex has at most twice the speed of the fastest gust,
    // which is sqrt(3) * 2.01 deviations.
    CHECK(simulation->velocities().rowwise().norm().maxCoeff() <
          2 * speed * (1 + 0.5 * 2.01 * std::sqrt(3.0)));
  }
}

TEST_CASE("gusts have the stated mean, deviation, bound and smoothness", "[effects]") {
  const Gusts gusts{.deviation = 2, .time = 0.25, .seed = 11};
  const int cells = 40000, samples = 8;  // per cell
  Vector3 sum = Vector3::Zero(), squares = Vector3::Zero(), products = Vector3::Zero();
  Vector3 previous = gusts.at(-cells / 2 * gusts.time);
  double largest = 0, steepest = 0;
  for (int i = -cells * samples / 2; i < cells * samples / 2; ++i) {
    const Vector3 gust = gusts.at((i + 0.5) / samples * gusts.time);
    sum += gust, squares += gust.cwiseAbs2();
    products += gust.cwiseProduct(Vector3(gust.y(), gust.z(), gust.x()));
    largest = std::max(largest, gust.cwiseAbs().maxCoeff());
    steepest = std::max(steepest, (gust - previous).cwiseAbs().maxCoeff());
    previous = gust;
  }
  CHECK(largest <= 2.01 * gusts.deviation);
  CHECK(largest > 1.99 * gusts.deviation);  // the largest of 40 000 uniform values is within 1 % of the bound
  // From one bound to the other, the slope of 3 x² - 2 x³ is at most 3/2.
  CHECK(steepest <= 1.5 / samples * 2 * 2.01 * gusts.deviation);
  const double count = cells * samples;
  // The mean of `cells` independent values has an error of 1 / sqrt(cells) = 0.5 % of a deviation. The
  // tolerance is four times that.
  for (int axis = 0; axis < 3; ++axis) {
    CHECK_THAT(sum(axis) / count, WithinAbs(0, 0.02 * gusts.deviation));
    CHECK_THAT(std::sqrt(squares(axis) / count), WithinRel(gusts.deviation, 0.02));
    CHECK_THAT(products(axis) / count, WithinAbs(0, 0.02 * 4));
  }
  // In a run that diverges, gusts may be evaluated at any time.
  for (const double time : {1e30, std::numeric_limits<double>::quiet_NaN()})
    CHECK_FALSE(gusts.at(time).allFinite());
  CHECK(gusts.at(1e15).allFinite());
}

TEST_CASE("gusts: the same seed gives the same bits, another seed gives other gusts", "[effects]") {
  const RestMesh rest = one_triangle();
  const Pins none = make_pins(rest, {}, 0);
  const auto end = [&](std::int64_t seed) {
    auto passes = test::passes_of<double>(
        "wind", rest, none, {{"velocity", numbers({0, 0, 2})}, {"gust_amplitude", 0.3}, {"seed", seed}});
    State<double> state = test::state_of<double>(rest, none);
    for (int s = 0; s < 40; ++s) test::run(passes, state, 1e-3, 1e-3 * s);
    return state.velocity[0].vector();
  };
  CHECK(end(1) == end(1));
  CHECK((end(1) - end(2)).norm() > 1e-3 * end(1).norm());
}

TEST_CASE("gusts travel with the wind if gusts_travel is set", "[effects]") {
  const RestMesh rest = one_triangle();
  const Pins none = make_pins(rest, {}, 0);
  const Vector3 wind(1, 0, 2);
  const auto pushed = [&](bool travel, const Vector3& place, double time) {
    auto passes = test::passes_of<double>(
        "wind", rest, none, {{"velocity", numbers(wind)}, {"gust_amplitude", 0.3}, {"gusts_travel", travel}});
    State<double> state = test::state_of<double>(rest, none);
    state.origin = place;
    test::run(passes, state, 1e-3, time);
    return state.velocity[0].vector();
  };
  const Vector3 here(0.5, 2, -1), across(2, 5, -1);
  const double later = 0.7;
  // 1e-10: rounding of the shifted place.
  CHECK((pushed(true, here + later * wind, 1 + later) - pushed(true, here, 1)).norm() <=
        1e-10 * pushed(true, here, 1).norm());
  CHECK((pushed(true, here + across, 1) - pushed(true, here, 1)).norm() <= 1e-10);  // across·wind = 0
  CHECK((pushed(true, here + wind, 1) - pushed(true, here, 1)).norm() > 1e-5);
  CHECK(pushed(false, here + wind, 1) == pushed(false, here, 1));
}

TEST_CASE("wind without air has no pass", "[effects]") {
  const RestMesh rest = one_triangle();
  CHECK(test::passes_of<float>("wind", rest, make_pins(rest, {}, 0), {{"air_density", 0.0}}).empty());
}

}  // namespace bendlab::wind_test
