// What a config gets that it does not say.
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/config.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/scene/scene.hpp"
#include "tests/catch.hpp"

using namespace bendlab;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::filesystem::path configs = std::filesystem::path(BENDLAB_SOURCE_DIR) / "configs";

Json resolved(const std::string& text) {
  return parse_experiment(text, "test").runs.at(0).resolved();
}

Json bending(const std::string& section) {
  return resolved(R"({"name": "t", "bending": )" + section + "}").at("bending");
}

std::string problem_of(const std::string& text) {
  try {
    parse_experiment(text, "test");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> effects_of(const Json& run) {
  std::vector<std::string> types;
  for (const Json& effect : run.at("effects")) types.push_back(effect.at("type"));
  return types;
}

}  // namespace

TEST_CASE("defaults: a config that says nothing gets the recommended settings", "[defaults]") {
  const Json recommended = load_experiment(configs / "recommended.json").runs.at(0).resolved();
  const Json cells = recommended.at("mesh").at("cells");
  CHECK(resolved(R"({"name": "t", "mesh": {"cells": )" + cells.dump() +
                 R"(}, "initial": {"perturbation": 1e-6}, "output": {"frames_per_second": 15}})") ==
        recommended);
}

TEST_CASE("defaults: those of the paper are what its configs write out", "[defaults]") {
  for (const RunConfig& run : load_experiment(configs / "paper" / "fig7.json").runs) {
    Json written = run.resolved();
    if (*value_at(written, "/effects/1/rate") != 0 || *value_at(written, "/initial/seed") != 1) continue;
    written.at("effects").erase(1);
    const int times = *value_at(written, "/bending/adaptive/n_multiplier");
    CHECK(resolved(R"({"name": "t", "defaults": "paper", "mesh": {"cells": 64},
                       "bending": {"adaptive": {"n_multiplier": )" +
                   std::to_string(times) +
                   R"(}}, "solver": {"precision": "single"},
                      "initial": {"perturbation": 1e-6}, "output": {"frames_per_second": 15}})") == written);
  }
}

TEST_CASE("defaults: a sweep may compare them", "[defaults]") {
  const Experiment both = parse_experiment(
      R"({"name": "t", "sweep": {"/defaults": ["paper", "recommended"]},
          "expect": [{"metric": "springs", "min": 1, "why": "it has springs",
                      "where": {"/defaults": "paper"}}]})",
      "test");
  REQUIRE(both.runs.size() == 2);
  CHECK(both.runs[0].bending_model() == "adaptive");
  CHECK(effects_of(both.runs[0].resolved()) == std::vector<std::string>{"gravity"});
  CHECK(both.runs[1].bending_model() == "discrete_shells");
  CHECK(effects_of(both.runs[1].resolved()) ==
        std::vector<std::string>{"gravity", "tethers", "viscous_drag"});
  CHECK(check_expectations(both, both.runs[0], {{"springs", 4}}).size() == 1);
  CHECK(check_expectations(both, both.runs[1], {{"springs", 4}}).empty());
  CHECK_FALSE(both.runs[0].resolved().contains("defaults"));  // runs of equal settings are the same run
}

TEST_CASE("defaults: whoever gives a number of a stiffness means that stiffness", "[defaults]") {
  CHECK(bending(R"({"model": "k_ring", "k": 0.3})").at("stiffness") == "k");
  CHECK(bending(R"({"model": "k_ring", "compliance": 0.3})").at("stiffness") == "compliance");
  CHECK(bending(R"({"model": "k_ring", "quartic_coefficient": 1e-8})").at("stiffness") == "physical");
  CHECK(bending(R"({"model": "k_ring", "stiffness": "k_per_step", "k": 0.3})").at("stiffness") ==
        "k_per_step");
  for (const char* two : {R"({"k": 0.3, "compliance": 1})", R"({"k": 0.3, "flexural_rigidity": 1e-5})",
                          R"({"compliance": 1, "flexural_rigidity": 1e-5})"}) {
    CAPTURE(two);
    CHECK_THAT(problem_of(R"({"name": "t", "bending": )" + std::string(two) + "}"),
               ContainsSubstring("/bending/stiffness") && ContainsSubstring("say which of them counts"));
  }
}

TEST_CASE("defaults: every model gets the same rigidity, springs at the same curvature", "[defaults]") {
  const Json hinges = bending(R"({"model": "dihedral"})"), springs = bending(R"({"model": "adaptive"})"),
             quartic = bending(R"({"model": "adaptive", "quartic_coefficient": 1e-8})");
  CHECK(hinges.at("flexural_rigidity") == 1e-5);
  CHECK_FALSE(hinges.contains("at_curvature"));
  CHECK(springs.at("flexural_rigidity") == 1e-5);
  CHECK(springs.at("at_curvature") == 20.0);
  CHECK_FALSE(quartic.contains("flexural_rigidity"));
  CHECK_FALSE(quartic.contains("at_curvature"));
  CHECK(
      bending(R"({"model": "adaptive", "flexural_rigidity": 1e-4, "at_curvature": 5})").at("at_curvature") ==
      5.0);
}

TEST_CASE("defaults: a method that does not project leaves tethers out, and refuses obstacles",
          "[defaults]") {
  const std::string membrane = R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}})",
                    method = R"("solver": {"method": "equilibrium"})";
  CHECK(effects_of(resolved(R"({"name": "t", )" + membrane + ", " + method + "}")) ==
        std::vector<std::string>{"gravity", "viscous_drag"});
  CHECK_THAT(problem_of(R"({"name": "t", )" + membrane + ", " + method +
                        R"(, "effects": [{"type": "tethers"}, {"type": "plane"}]})"),
             ContainsSubstring("/effects/1") && ContainsSubstring("plane works with the projection"));
}

TEST_CASE("defaults: reasons name settings and change nothing", "[defaults]") {
  const std::string start = R"({"name": "t", "because": )";
  CHECK(resolved(start + R"({"/solver/dt": "sixty frames a second", "/effects/0": "it hangs"}})") ==
        resolved(R"({"name": "t"})"));
  CHECK_THAT(problem_of(start + R"({"/solver/dtt": "x"}})"), ContainsSubstring("did you mean '/solver/dt'"));
  CHECK_THAT(problem_of(start + R"({"/solver/dt": ""}})"), ContainsSubstring("a text that gives the reason"));
  CHECK_THAT(problem_of(start + R"(["x"]})"), ContainsSubstring("expected an object"));
}

TEST_CASE("defaults: a method that has no substeps takes one step at a time", "[defaults]") {
  const Experiment experiment = parse_experiment(
      R"({"name": "t", "mesh": {"cells": 4}, "solver": {"method": "equilibrium"},
          "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}}})",
      "test");
  const Scene scene = build_scene(experiment.runs.at(0));
  CHECK(scene.input.settings.substeps == 1);
  CHECK(scene.input.settings.iterations == 1);
}
