// A sheet that starts folded: its layers are in the right place, have their rest length, and do not
// intersect.
#include "bendlab/mesh/self_intersections.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::folds_test {
namespace {

using Catch::Matchers::WithinAbs;

BuiltScene folded_scene(const std::string& initial) {
  return build_scene(parse_experiment(R"({"name": "folds", "defaults": "paper",
          "description": "d", "duration": 1,
    "mesh": {"cells": 128}, "bending": {"model": "crossover"}, "initial": )" +
                                          initial + "}",
                                      "test")
                         .runs.front()
                         .scene());
}

}  // namespace

TEST_CASE("a folded sheet lies in layers, unstretched and without intersections", "[experiments]") {
  const double gap = 0.02;
  const BuiltScene scene = folded_scene(R"({"folds": 4, "fold_gap": 0.02})");
  const Positions& folded = scene.input.positions;
  CHECK(self_intersections(folded, scene.rest.triangles()).empty());
  const double height = folded.col(2).maxCoeff() - folded.col(2).minCoeff();
  CHECK_THAT(height, WithinAbs(4 * gap, 1e-12));
  // An edge on a circle with a diameter of 2.56 edges is a chord: shorter by sin(x) / x with x = 1 / 2.56.
  const double shortest = std::sin(1 / 2.56) * 2.56;
  const Edges& edges = scene.rest.edges();
  for (Eigen::Index e = 0; e < edges.rows(); ++e) {
    const double now = (folded.row(edges(e, 0)) - folded.row(edges(e, 1))).norm();
    const double rest = (scene.rest.position(edges(e, 0)) - scene.rest.position(edges(e, 1))).norm();
    CHECK(now <= rest * (1 + 1e-12));
    CHECK(now >= rest * (shortest - 1e-12));
  }
  CHECK(folded_scene(R"({"folds": 0})").input.positions == scene.rest.positions());
  CHECK_THROWS_AS(folded_scene(R"({"folds": 4, "fold_gap": 0.2})"),
                  ConfigError);  // the turns would be 1.26 m long
}

}  // namespace bendlab::folds_test
