// Tethers and a membrane of stated stiffness: the elongation of a sheet that hangs by its upper side is α ρ g
// L²/2.
#include <fmt/format.h>

#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/membrane.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/warnings.hpp"
#include "tests/catch.hpp"

namespace bendlab::tethers_membrane_test {
namespace {

using Catch::Matchers::WithinRel;

constexpr double density = 0.2, g = 9.81, size = 1;

RunConfig hanging(double compliance, int substeps, const std::string& effects) {
  return parse_experiment(
             fmt::format(R"({{"name": "hanging", "defaults": "paper", "duration": 8, "mesh": {{"cells": 8}},
          "pins": {{"vertices": ["top"], "ring": 0}}, "initial": {{"tilt": 90}},
          "bending": {{"model": "none"}}, "material": {{"density": {},
          "strain": {{"form": "angle", "stiffness": "compliance", "compliance": {}}}}},
          "solver": {{"method": "pbd", "substeps": {}, "iterations": 1}},
          "effects": [{{"type": "gravity"}}, {{"type": "viscous_drag", "coefficient": 2}}{}]}})",
                         density, compliance, substeps, effects),
             "test")
      .runs.front();
}

// The mean elongation: how much farther below the pins the lower side hangs than at rest, m.
double elongation(double compliance, int substeps, const std::string& effects) {
  const BuiltScene scene = build_scene(hanging(compliance, substeps, effects).scene());
  const auto simulation = simulation_of(scene);
  const Eigen::VectorXd start = simulation->positions().col(2);
  for (int step = 0; step < 8 * 60; ++step) REQUIRE(simulation->step());
  const Eigen::VectorXd end = simulation->positions().col(2);
  double sum = 0, count = 0;
  for (Eigen::Index v = 0; v < start.size(); ++v)
    if (start(v) < start.minCoeff() + 1e-6) sum += end(v), ++count;
  return end.maxCoeff() - sum / count - size;
}

const std::string tethers = R"(, {"type": "tethers"})";

}  // namespace

TEST_CASE("tethers do not act if substeps resolve the stiffness of the membrane", "[experiments]") {
  // Rows of lumped masses have the same elongation as the continuum: Σ (j - ½) over n rows is n²/2.
  // Projections have an error of C²/n, up to 0.01 here, and the parallel diagonals shear the sheet a little.
  for (const auto& [compliance, substeps] : {std::pair{0.1, 8}, {0.1, 64}, {0.02, 64}, {0.002, 64}}) {
    CAPTURE(compliance, substeps);
    const double stated = compliance * density * g * size * size / 2;
    CHECK_THAT(elongation(compliance, substeps, tethers), WithinRel(stated, 0.02));
  }
}

TEST_CASE("tethers hold a membrane whose stiffness substeps do not resolve, and a warning reports this",
          "[experiments]") {
  const BuiltScene scene = build_scene(hanging(1e-4, 8, tethers).scene());
  REQUIRE(excess_stretch(scene) > 1);
  CHECK_FALSE(membrane_needs_no_tethers(scene));
  // The stated elongation is 8.5e-5. Without tethers it would be 1e-3.
  CHECK(std::abs(elongation(1e-4, 8, tethers)) < 1e-5);
  CHECK(elongation(1e-4, 8, "") > 5e-4);
}

}  // namespace bendlab::tethers_membrane_test
