// The cost of the coloured order: how many more sweeps it needs than the mesh order for the same strain
// error.
#include <memory>

#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::convergence_test {
namespace {

constexpr int cells = 32;         // along the long side of each cloth
constexpr int steps_before = 30;  // 0.5 s: the cloth falls, folds and pulls at its pins

// A square that hangs from a corner, a strip from its top edge, an irregular square from two corners.
constexpr const char* scenes[] = {
    R"({"name": "corner", "defaults": "paper", "mesh": {"cells": 32}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})",
    R"({"name": "strip", "defaults": "paper", "mesh": {"width": 0.25, "height": 1, "cells": 8},
        "pins": {"vertices": ["top"]}, "bending": {"model": "crossover"}, "initial": {"tilt": 60},
        "solver": {"precision": "double", "order": "mesh"}})",
    R"({"name": "irregular", "defaults": "paper", "mesh": {"generator": "delaunay", "cells": 32},
        "pins": {"vertices": ["upper_left", "upper_right"]}, "bending": {"model": "crossover"},
        "solver": {"precision": "double", "order": "mesh"}})"};

void do_steps(Simulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step) REQUIRE(simulation.step());
}

BuiltScene moved_scene(const char* config) {
  BuiltScene scene = build_scene(parse_experiment(config, "test").runs.front().scene());
  const auto simulation = simulation_of(scene);
  do_steps(*simulation, steps_before);
  scene.input.positions = simulation->positions();
  scene.input.velocities = simulation->velocities();
  return scene;
}

// The mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|) after one step of `sweeps` sweeps.
double error_after(BuiltScene scene, int sweeps, ConstraintOrder order) {
  scene.input.settings.iterations = sweeps;
  scene.input.method = Pbd{.order = order};
  const auto simulation = simulation_of(scene);
  do_steps(*simulation, 1);
  const StretchMeter meter(scene.rest, scene.pins);
  return meter.summarise(meter.measure(simulation->positions())).mean_strain;
}

}  // namespace

// Once errors are smooth, Gauss-Seidel by colour and in list order converge at the same rate (Young 1954 for
// two colours; Adams & Jordan, "Is SOR color-blind?", 1986, for more colours). The difference is how far a
// correction travels in one sweep. In list order it can cross the whole sheet, in the direction of the list.
// By colour it crosses a few edges, at least one, because of any two constraints that share a vertex one acts
// after the other. So list order has a head start of at most as many sweeps as there are edges along the
// sheet.
TEST_CASE("the coloured order reaches the strain error of the mesh order within the sweeps to cross a sheet",
          "[solver]") {
  for (const char* config : scenes) {
    const BuiltScene scene = moved_scene(config);
    for (const int sweeps : {1, 5, 10, 20}) {
      INFO(config << ", " << sweeps << " sweeps");
      const double target = error_after(scene, sweeps, ConstraintOrder::mesh);
      int needed = 1;
      while (needed <= sweeps + cells && error_after(scene, needed, ConstraintOrder::colour) > target)
        ++needed;
      CHECK(needed <= sweeps + cells);
    }
  }
}

}  // namespace bendlab::convergence_test
