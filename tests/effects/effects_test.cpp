#include "bendlab/effects/effect.hpp"

#include "bendlab/metrics/motion.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::effects_test {
namespace {

using Catch::Matchers::WithinRel;

// A free, crumpled sheet with random velocities and masses.
SimulationInput moving_sheet(int seed) {
  const RestMesh rest(delaunay(1, 1, 8, static_cast<std::uint64_t>(seed)));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  input.velocities.resize(rest.vertex_count(), 3);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    input.positions.row(v) += test::random_vector(random, 0.02).transpose();
    input.velocities.row(v) = test::random_vector(random, 1).transpose();
    input.mass[static_cast<std::size_t>(v)] *= test::uniform(random, 0.5, 2);
  }
  return input;
}

// Runs the passes of one effect once on the state of a sheet, with the constraints of the sheet.
Motion motion_after(const SimulationInput& input, std::vector<Pass<double>> passes, double substep) {
  State<double> state;
  const auto count = static_cast<std::size_t>(input.positions.rows());
  state.vertex_count = static_cast<int>(count);
  state.mass = input.mass;
  state.position.resize(count + dummy_points);
  state.velocity.resize(count + dummy_points);
  for (std::size_t v = 0; v < count; ++v) {
    state.position[v].set(input.positions.row(static_cast<Eigen::Index>(v)).transpose());
    state.position[v].w = 1 / input.mass[v];
    state.velocity[v].set(input.velocities.row(static_cast<Eigen::Index>(v)).transpose());
  }
  BatchOrder order;
  Constraints<double> constraints;
  // One constraint per colour: the order does not matter here.
  const auto one_each = [](std::size_t constraints_count) {
    BatchOrder singles;
    for (std::size_t c = 0; c < constraints_count; ++c) {
      singles.colours.push_back(c);
      singles.stacks.push_back(c * max_lanes);
      singles.first.push_back(static_cast<int>(c));
      singles.first.resize((c + 1) * max_lanes, -1);
    }
    singles.colours.push_back(constraints_count);
    singles.stacks.push_back(constraints_count * max_lanes);
    return singles;
  };
  constraints.strain =
      make_strain_batch<double>(input.strain, one_each(input.strain.size()), state.vertex_count);
  constraints.distance =
      make_distance_batch<double>(input.distance, one_each(input.distance.size()), state.vertex_count);
  PassContext<double> context{state, constraints, substep};
  for (Pass<double>& pass : passes) pass.run(context);
  Positions velocities(input.positions.rows(), 3);
  for (std::size_t v = 0; v < count; ++v)
    velocities.row(static_cast<Eigen::Index>(v)) = state.velocity[v].vector().transpose();
  return motion_of(input.mass, input.positions, velocities);
}

}  // namespace

TEST_CASE("both dampings keep linear and angular momentum and reduce energy", "[effects]") {
  for (const char* name : {"rigid_damping", "constraint_damping"})
    for (const int seed : {1, 2, 3}) {
      const SimulationInput input = moving_sheet(seed);
      const Motion before = motion_of(input.mass, input.positions, input.velocities);
      const Motion after = motion_after(input, test::effect_passes<double>(name, "rate", 20.0), 1e-2);
      CHECK(after.kinetic_energy < 0.95 * before.kinetic_energy);
      // Rounding of sums over about a hundred vertices, relative to the momenta of the vertices.
      const double scale = std::sqrt(2 * before.kinetic_energy * 0.2);
      CHECK((after.linear_momentum - before.linear_momentum).norm() <= 1e-13 * scale);
      CHECK((after.angular_momentum - before.angular_momentum).norm() <= 1e-13 * scale);
    }
}

TEST_CASE("constraint damping acts on every constraint in every substep, unless its rate is 0", "[effects]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  input.settings.substeps = 3;
  const std::uint64_t constraints = 32 + 40;  // triangles, and springs over the 56 - 16 interior edges
  for (const double rate : {0.0, 1.0}) {
    const auto simulation =
        make_simulation<double>(input, test::effect_passes<double>("constraint_damping", "rate", rate));
    REQUIRE(simulation->step());
    for (const PassStatistics& pass : simulation->passes())
      if (pass.name == "constraint_damping") CHECK(pass.acted == (rate > 0 ? 3 * constraints : 0));
  }
}

TEST_CASE("rigid damping is a rate: its effect does not depend on the number of substeps", "[effects]") {
  const SimulationInput input = moving_sheet(4);
  const auto passes = [](double rate, int times) {
    std::vector<Pass<double>> all;
    for (int i = 0; i < times; ++i)
      all.push_back(test::effect_passes<double>("rigid_damping", "rate", rate).front());
    return all;
  };
  const double once = motion_after(input, passes(5, 1), 0.1).kinetic_energy;
  const double ten_times = motion_after(input, passes(5, 10), 0.01).kinetic_energy;
  CHECK_THAT(ten_times, WithinRel(once, 1e-12));  // exp(-γ h)^10 = exp(-10 γ h), to rounding
}

TEST_CASE("rigid damping leaves rigid motion alone", "[effects]") {
  SimulationInput input = moving_sheet(5);
  for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
    input.velocities.row(v) =
        (Vector3(1, 2, 3) + Vector3(0.3, -0.4, 2).cross(Vector3(input.positions.row(v).transpose())))
            .transpose();
  const double before = motion_of(input.mass, input.positions, input.velocities).kinetic_energy;
  const double after =
      motion_after(input, test::effect_passes<double>("rigid_damping", "rate", 50.0), 0.1).kinetic_energy;
  CHECK_THAT(after, WithinRel(before, 1e-12));  // rounding of the solution with the inertia matrix
}

TEST_CASE("rigid damping keeps the spin of a line of vertices, whose own axis has no inertia", "[effects]") {
  SimulationInput input{.method = Pbd{}};
  input.positions.resize(3, 3);
  input.positions << -1, 0, 0, 0, 0, 0, 1, 0, 0;
  input.mass = {1, 1, 1};
  input.velocities.resize(3, 3);
  input.velocities << 0, -2, 0, 0, 0, 0, 0, 2, 0;  // a rigid spin about z
  const Motion after = motion_after(input, test::effect_passes<double>("rigid_damping", "rate", 50.0), 0.1);
  CHECK_THAT(after.kinetic_energy, WithinRel(4.0, 1e-12));
}

TEST_CASE("an effect of zero strength gives the same bits as no effect", "[effects]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 1), "crossover");
  const auto end = [&](std::vector<Pass<float>> passes) {
    for (Pass<float>& pass : test::effect_passes<float>("gravity")) passes.push_back(std::move(pass));
    const auto simulation = make_simulation<float>(input, std::move(passes));
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    return simulation->positions();
  };
  const Positions plain = end({});
  CHECK(end(test::effect_passes<float>("constraint_damping", "rate", 0.0)) == plain);
  CHECK(end(test::effect_passes<float>("rigid_damping", "rate", 0.0)) == plain);
  CHECK(end(test::effect_passes<float>("rigid_damping", "rate", 1.0)) != plain);
}

}  // namespace bendlab::effects_test
