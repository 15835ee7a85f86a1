#include "experiments/bench/convergence.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "bendlab/metrics/stretch.hpp"
#include "experiments/bench/families.hpp"
#include "experiments/config.hpp"
#include "experiments/scene.hpp"

namespace bendlab {
namespace {

constexpr int steps_before = 30;  // 0.5 s: the cloth falls, folds and pulls at its pins

constexpr std::array<ConvergenceScene, 3> scenes = {
    ConvergenceScene{"corner", R"({"name": "corner", "mesh": {"cells": 32}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})"},
    ConvergenceScene{"strip", R"({"name": "strip", "mesh": {"width": 0.25, "height": 1, "cells": 8},
        "pins": {"vertices": ["top"]}, "bending": {"model": "crossover"}, "initial": {"tilt": 60},
        "solver": {"precision": "double", "order": "mesh"}})"},
    ConvergenceScene{"irregular", R"({"name": "irregular", "mesh": {"generator": "delaunay", "cells": 32},
        "pins": {"vertices": ["upper_left", "upper_right"]}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})"}};

void do_steps(Simulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step)
    if (!simulation.step()) throw std::runtime_error("a scene for comparing orders diverged");
}

BenchRow measure(const std::string& name, const ConvergenceScene& scene, int sweeps) {
  const ConvergenceError error = convergence_errors(scene, std::array{sweeps}).front();
  const Scene built = build_scene(parse_experiment(scene.config, scene.name).runs.front());
  BenchRow row{
      .name = name,
      .scalar = "double",
      .vertices = built.rest.vertex_count(),
      .constraints = static_cast<std::int64_t>(built.input.strain.size() + built.input.distance.size())};
  row.more = {{"sweeps", sweeps},
              {"strain_error_colour", error.colour},
              {"strain_error_mesh", error.mesh},
              {"colour_over_mesh", error.colour / error.mesh},
              {"sweeps_to_match", error.sweeps_to_match}};
  return row;
}

}  // namespace

std::span<const ConvergenceScene> convergence_scenes() {
  return scenes;
}

std::vector<ConvergenceError> convergence_errors(const ConvergenceScene& scene, std::span<const int> sweeps) {
  Scene start = build_scene(parse_experiment(scene.config, scene.name).runs.front());
  {
    const auto before = simulation_of(start);
    do_steps(*before, steps_before);
    start.input.positions = before->positions();
    start.input.velocities = before->velocities();
  }
  const StretchMeter meter(start.rest, start.pins);
  const auto error_after = [&](int iterations, ConstraintOrder order) {
    start.input.settings.iterations = iterations;
    start.input.settings.order = order;
    const auto simulation = simulation_of(start);
    do_steps(*simulation, 1);
    return meter.summarise(meter.measure(simulation->positions())).mean_strain;
  };
  std::vector<ConvergenceError> errors;
  for (const int n : sweeps) {
    ConvergenceError error{.sweeps = n,
                           .colour = error_after(n, ConstraintOrder::colour),
                           .mesh = error_after(n, ConstraintOrder::mesh)};
    for (int more = 1; error.sweeps_to_match == 0 && more <= 4 * (n + convergence_cells); ++more)
      if (error_after(more, ConstraintOrder::colour) <= error.mesh) error.sweeps_to_match = more;
    errors.push_back(error);
  }
  return errors;
}

std::vector<BenchCase> convergence_cases(const BenchOptions& options) {
  std::vector<BenchCase> cases;
  for (const ConvergenceScene& scene : scenes)
    for (const int sweeps : options.quick ? std::vector{1, 10} : std::vector{1, 5, 10, 20}) {
      const std::string name = fmt::format("convergence/{}/{}", scene.name, sweeps);
      cases.push_back({.id = bench_id(name, "double"), .oracle = "", .run = [=, &scene] {
                         return measure(name, scene, sweeps);
                       }});
    }
  return cases;
}

}  // namespace bendlab
