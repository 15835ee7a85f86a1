#include "experiments/bench/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {
namespace {

constexpr int steps_before = 30;  // 0.5 s: the cloth falls, folds and pulls at its pins

constexpr std::array<ConvergenceScene, 3> scenes = {
    ConvergenceScene{"corner", R"({"name": "corner", "defaults": "paper",
          "mesh": {"cells": 32}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})"},
    ConvergenceScene{"strip", R"({"name": "strip", "defaults": "paper",
          "mesh": {"width": 0.25, "height": 1, "cells": 8},
        "pins": {"vertices": ["top"]}, "bending": {"model": "crossover"}, "initial": {"tilt": 60},
        "solver": {"precision": "double", "order": "mesh"}})"},
    ConvergenceScene{"irregular", R"({"name": "irregular", "defaults": "paper",
          "mesh": {"generator": "delaunay", "cells": 32},
        "pins": {"vertices": ["upper_left", "upper_right"]}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})"}};

void do_steps(Simulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step)
    if (!simulation.step()) throw std::runtime_error("a scene for comparing orders diverged");
}

// #V: the number of edges from each vertex to the nearest pinned vertex.
std::vector<int> edges_from_pins(const BuiltScene& scene) {
  std::vector<int> distance(static_cast<std::size_t>(scene.rest.vertex_count()), -1), queue = scene.pins.all;
  for (const int pinned : queue) distance[static_cast<std::size_t>(pinned)] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int neighbour : scene.rest.one_ring()[queue[next]])
      if (int& there = distance[static_cast<std::size_t>(neighbour)]; there < 0) {
        there = distance[static_cast<std::size_t>(queue[next])] + 1;
        queue.push_back(neighbour);
      }
  return distance;
}

template <class Vertices, class Rest>
void sort_by(const std::vector<int>& key_of_vertex, bool descending, Vertices& vertices,
             std::vector<Rest>& rest) {
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t c = 0; c < vertices.size(); ++c) {
    int sum = 0;
    for (const int vertex : vertices[c]) sum += key_of_vertex[static_cast<std::size_t>(vertex)];
    order.emplace_back(descending ? -sum : sum, c);
  }
  std::sort(order.begin(), order.end());
  Vertices sorted_vertices;
  std::vector<Rest> sorted_rest;
  for (const auto& [key, c] : order) {
    sorted_vertices.push_back(vertices[c]);
    if (!rest.empty()) sorted_rest.push_back(rest[c]);
  }
  vertices = std::move(sorted_vertices), rest = std::move(sorted_rest);
}

BuiltScene sorted_from_pins(BuiltScene scene, bool descending) {
  const std::vector<int> distance = edges_from_pins(scene);
  scene.input.permutation.clear();  // the permutation would sort the lists again
  sort_by(distance, descending, scene.input.strain.vertices, scene.input.strain.inverse_rest);
  sort_by(distance, descending, scene.input.distance.vertices, scene.input.distance.rest_length);
  return scene;
}

BenchRow measure(const std::string& name, const ConvergenceScene& scene, int sweeps) {
  const ConvergenceError error = convergence_errors(scene, std::array{sweeps}).front();
  const BuiltScene built = build_scene(parse_experiment(scene.config, scene.name).runs.front().scene());
  BenchRow row{
      .name = name,
      .scalar = "double",
      .vertices = built.rest.vertex_count(),
      .constraints = static_cast<std::int64_t>(built.input.strain.size() + built.input.distance.size())};
  row.more = {{"sweeps", sweeps},
              {"strain_error_colour", error.colour},
              {"strain_error_mesh", error.mesh},
              {"strain_error_from_pins", error.from_pins},
              {"strain_error_to_pins", error.to_pins},
              {"strain_error_colour_from_pins", error.colour_from_pins},
              {"colour_over_mesh", error.colour / error.mesh},
              {"sweeps_to_match", error.sweeps_to_match}};
  return row;
}

}  // namespace

std::span<const ConvergenceScene> convergence_scenes() {
  return scenes;
}

std::vector<ConvergenceError> convergence_errors(const ConvergenceScene& scene, std::span<const int> sweeps) {
  BuiltScene start = build_scene(parse_experiment(scene.config, scene.name).runs.front().scene());
  {
    const auto before = simulation_of(start);
    do_steps(*before, steps_before);
    start.input.positions = before->positions();
    start.input.velocities = before->velocities();
  }
  const StretchMeter meter(start.rest, start.pins);
  const auto error_of = [&](BuiltScene scene_now, int iterations, ConstraintOrder order) {
    scene_now.input.settings.iterations = iterations;
    scene_now.input.method = Pbd{.order = order};
    const auto simulation = simulation_of(scene_now);
    do_steps(*simulation, 1);
    return meter.summarise(meter.measure(simulation->positions())).mean_strain;
  };
  const auto error_after = [&](int iterations, ConstraintOrder order) {
    return error_of(start, iterations, order);
  };
  std::vector<ConvergenceError> errors;
  for (const int n : sweeps) {
    ConvergenceError error{
        .sweeps = n,
        .colour = error_after(n, ConstraintOrder::colour),
        .mesh = error_after(n, ConstraintOrder::mesh),
        .from_pins = error_of(sorted_from_pins(start, false), n, ConstraintOrder::mesh),
        .to_pins = error_of(sorted_from_pins(start, true), n, ConstraintOrder::mesh),
        .colour_from_pins = error_of(sorted_from_pins(start, false), n, ConstraintOrder::colour)};
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
      cases.push_back(
          {.id = bench_id(name, "double"), .run = [=, &scene] { return measure(name, scene, sweeps); }});
    }
  return cases;
}

}  // namespace bendlab
