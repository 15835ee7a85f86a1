// The settings that a config gets if it does not state them.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::defaults_test {
using Catch::Matchers::ContainsSubstring;

namespace {

const std::filesystem::path configs = std::filesystem::path(places::source) / "configs";

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

TEST_CASE("defaults: a config that states no settings gets the recommended settings", "[defaults]") {
  const Json recommended = load_experiment(configs / "recommended.json").runs.at(0).resolved();
  const Json cells = recommended.at("mesh").at("cells");
  CHECK(resolved(R"({"name": "t", "mesh": {"cells": )" + cells.dump() +
                 R"(}, "initial": {"perturbation": 1e-6}, "output": {"frames_per_second": 15}})") ==
        recommended);
}

TEST_CASE("defaults: the defaults `paper` equal the settings in the paper's configs", "[defaults]") {
  int compared = 0;
  for (const RunConfig& run : load_experiment(configs / "paper" / "fig7.json").runs) {
    Json written = run.resolved();
    if (*value_at(written, "/effects/1/rate") != 0 || *value_at(written, "/initial/seed") != 1) continue;
    ++compared;
    written.at("effects").erase(1);
    const int times = *value_at(written, "/bending/adaptive/n_multiplier");
    CHECK(resolved(R"({"name": "t", "defaults": "paper", "mesh": {"cells": 64},
                       "bending": {"adaptive": {"n_multiplier": )" +
                   std::to_string(times) +
                   R"(}}, "solver": {"precision": "single"},
                      "initial": {"perturbation": 1e-6}, "output": {"frames_per_second": 15}})") == written);
  }
  CHECK(compared == 3);  // for n_multiplier 1, 2 and 4
}

TEST_CASE("defaults: a sweep may vary the defaults", "[defaults]") {
  const Experiment both = parse_experiment(
      R"({"name": "t", "sweep": {"/defaults": ["paper", "recommended"]},
          "expect": [{"metric": "springs", "min": 1, "why": "it has springs",
                      "where": {"/defaults": "paper"}}]})",
      "test");
  REQUIRE(both.runs.size() == 2);
  CHECK(both.runs[0].scene().bending.model.name() == "adaptive");
  CHECK(effects_of(both.runs[0].resolved()) == std::vector<std::string>{"gravity"});
  CHECK(both.runs[1].scene().bending.model.name() == "discrete_shells");
  CHECK(effects_of(both.runs[1].resolved()) == std::vector<std::string>{"gravity", "viscous_drag"});
  CHECK(check_expectations(both.expectations, both.runs[0], {{"springs", 4}}).size() == 1);
  CHECK(check_expectations(both.expectations, both.runs[1], {{"springs", 4}}).empty());
  CHECK_FALSE(both.runs[0].resolved().contains("defaults"));  // runs of equal settings are the same run
}

TEST_CASE("defaults: an override of /defaults has the same effect as the config", "[defaults]") {
  const std::string bare = R"({"name": "t"})", stated = R"({"name": "t", "defaults": "paper"})";
  const std::vector<std::string> paper = {"/defaults=paper"};
  CHECK(parse_experiment(bare, "test", paper).runs.at(0).resolved() == resolved(stated));
  const std::vector<std::string> both = {R"(/sweep={"/defaults": ["paper", "recommended"]})"};
  const Experiment swept = parse_experiment(bare, "test", both);
  REQUIRE(swept.runs.size() == 2);
  CHECK(swept.runs[0].resolved() == resolved(stated));
  CHECK(swept.runs[1].resolved() == resolved(bare));
}

TEST_CASE("defaults: an expectation may apply only to runs with certain defaults", "[defaults]") {
  const auto with = [](const char* defaults) {
    return std::string(R"({"name": "t", "defaults": ")") + defaults + R"(",
        "expect": [{"metric": "springs", "min": 1, "why": "it has springs",
                    "where": {"/defaults": "paper"}}]})";
  };
  const Experiment paper = parse_experiment(with("paper"), "test");
  CHECK(check_expectations(paper.expectations, paper.runs.at(0), {{"springs", 4}}).size() == 1);
  CHECK_THAT(problem_of(with("recommended")), ContainsSubstring("/expect/0/where: matches no run"));
}

TEST_CASE("defaults: a stated stiffness also overrides the defaults of the paper", "[defaults]") {
  const auto of_paper = [](const std::string& section) {
    return resolved(R"({"name": "t", "defaults": "paper", "bending": )" + section + "}").at("bending");
  };
  CHECK(of_paper(R"({"model": "dihedral"})").at("stiffness") == "k");
  const Json rigid = of_paper(R"({"model": "dihedral", "flexural_rigidity": 1e-3})");
  CHECK(rigid.at("stiffness") == "physical");
  CHECK(rigid.at("flexural_rigidity") == 1e-3);
  CHECK(of_paper(R"({"compliance": 0.1})").at("stiffness") == "compliance");
}

TEST_CASE("defaults: an override of a setting that the stiffness does not use is an error", "[defaults]") {
  const auto problem = [](const std::string& bending, const std::string& override_text) -> std::string {
    try {
      const std::vector<std::string> overrides = {override_text};
      parse_experiment(R"({"name": "t", "bending": )" + bending + "}", "test", overrides);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(problem(R"({"stiffness": "physical"})", "/bending/k=0.3"),
             ContainsSubstring("only with k or k_per_step"));
  CHECK_THAT(problem(R"({"stiffness": "k"})", "/bending/compliance=0.3"),
             ContainsSubstring("only with compliance"));
  CHECK(problem(R"({"stiffness": "k_per_step"})", "/bending/k=0.3").empty());
  CHECK(problem("{}", "/bending/k=0.3").empty());
  CHECK(problem(R"({"stiffness": "k"})", "/bending/flexural_rigidity=null").empty());
}

TEST_CASE("defaults: a stated value selects the kind of stiffness that it belongs to", "[defaults]") {
  CHECK(bending(R"({"model": "k_ring", "k": 0.3})").at("stiffness") == "k");
  CHECK(bending(R"({"model": "k_ring", "compliance": 0.3})").at("stiffness") == "compliance");
  CHECK(bending(R"({"model": "k_ring", "quartic_coefficient": 1e-8})").at("stiffness") == "physical");
  CHECK(bending(R"({"model": "k_ring", "stiffness": "k_per_step", "k": 0.3})").at("stiffness") ==
        "k_per_step");
  for (const char* two : {R"({"k": 0.3, "compliance": 1})", R"({"k": 0.3, "flexural_rigidity": 1e-5})",
                          R"({"compliance": 1, "flexural_rigidity": 1e-5})"}) {
    CAPTURE(two);
    CHECK_THAT(
        problem_of(R"({"name": "t", "bending": )" + std::string(two) + "}"),
        ContainsSubstring("/bending/stiffness") && ContainsSubstring("to choose which number is used"));
  }
}

TEST_CASE("defaults: every model gets the same rigidity, and springs get it at the same curvature",
          "[defaults]") {
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

TEST_CASE("defaults: with a method without projections, default tethers do nothing and obstacles are refused",
          "[defaults]") {
  const std::string membrane = R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}})",
                    method = R"("solver": {"method": "equilibrium"})";
  // The tethers stay in the list, so /effects/1 is the same effect with any method.
  const RunConfig still =
      parse_experiment(R"({"name": "t", "effects": [{"type": "gravity"}, {"type": "tethers"}], )" + membrane +
                           ", " + method + "}",
                       "test")
          .runs.at(0);
  CHECK(effects_of(still.resolved()) == std::vector<std::string>{"gravity", "tethers"});
  CHECK(idle_effects(build_scene(still.scene())) == std::vector<std::size_t>{1});
  CHECK_THAT(problem_of(R"({"name": "t", )" + membrane + ", " + method +
                        R"(, "effects": [{"type": "tethers"}, {"type": "plane"}]})"),
             ContainsSubstring("/effects/1") && ContainsSubstring("plane acts between iterations"));
}

TEST_CASE("defaults: /because must name existing settings, and changes no setting", "[defaults]") {
  const std::string start = R"({"name": "t", "because": )";
  CHECK(resolved(start + R"({"/solver/dt": "sixty frames a second", "/effects/0": "it hangs"}})") ==
        resolved(R"({"name": "t"})"));
  CHECK_THAT(problem_of(start + R"({"/solver/dtt": "x"}})"), ContainsSubstring("did you mean '/solver/dt'"));
  CHECK_THAT(problem_of(start + R"({"/solver/dt": ""}})"), ContainsSubstring("a text that gives the reason"));
  CHECK_THAT(problem_of(start + R"(["x"]})"), ContainsSubstring("expected an object"));
}

TEST_CASE("defaults: a method without substeps takes one step at a time", "[defaults]") {
  const Experiment experiment = parse_experiment(
      R"({"name": "t", "mesh": {"cells": 4}, "solver": {"method": "equilibrium"},
          "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}}})",
      "test");
  const BuiltScene scene = build_scene(experiment.runs.at(0).scene());
  CHECK(scene.input.settings.substeps == 1);
  CHECK(scene.input.settings.iterations == 1);
}

TEST_CASE("every recipe runs with every model, and a method stated in the config has its own defaults",
          "[experiments]") {
  const auto config = [](std::string_view recipe, std::string_view rest) {
    return parse_experiment(fmt::format(R"({{"name": "t", "defaults": "{}", "mesh": {{"cells": 3}},
                                          "duration": 0.1, {}}})",
                                        recipe, rest),
                            "test")
        .runs.front();
  };
  for (const std::string_view recipe : {"fast", "reference", "paper"})
    for (const BendingKind* model : bending_models()) {
      if (model->one_sided && recipe == "fast") continue;      // quasi_newton refuses forces that jump
      if (model->needs_energy && recipe == "paper") continue;  // k has no energy
      CAPTURE(recipe, model->name);
      const auto simulation = simulation_of(
          build_scene(config(recipe, fmt::format(R"("bending": {{"model": "{}"}})", model->name)).scene()));
      CHECK(simulation->step());
    }
  const RunConfig fast = config("fast", R"("effects": [])");
  CHECK(fast.scene().solver.method.name() == "quasi_newton");
  CHECK(fast.scene().solver.iterations.value() == 2);
  CHECK(fast.scene().material.strain.membrane_stiffness == 1e4);
  const RunConfig other = config("fast", R"("solver": {"method": "newton"})");
  CHECK(other.scene().solver.iterations.value() == 20);  // the default of newton
  CHECK(config("reference", R"("effects": [])").scene().solver.method.name() == "newton");
}

TEST_CASE("the default config runs with any stated method and any model that this method supports",
          "[experiments]") {
  constexpr std::string_view text = R"({"name": "t", "mesh": {"cells": 3}, "duration": 0.1})";
  for (const MethodKind* method : methods())
    for (const BendingKind* model : bending_models()) {
      CAPTURE(method->name, model->name);
      const std::array overrides = {"/solver/method=" + std::string(method->name),
                                    "/bending/model=" + std::string(model->name)};
      // Methods for springs alone, and models with forces that jump, are refused. The message says what to
      // change.
      if ((method->springs_only && !model->springs_only && model->name != "none") ||
          (method->name == "quasi_newton" && model->one_sided) ||
          (method->name == "pbd" && model->needs_energy)) {
        try {
          parse_experiment(text, "test", overrides);
          FAIL("it is not refused");
        } catch (const ConfigError& error) {
          CHECK_THAT(error.what(), ContainsSubstring("/bending/model: ") && ContainsSubstring("choose"));
        }
        continue;
      }
      const Scene scene = parse_experiment(text, "test", overrides).runs.front().scene();
      if (model->needs_energy && !method->takes_own_elements) {
        CHECK_THROWS_WITH(build_scene(scene),
                          ContainsSubstring("which have no kernel") && !ContainsSubstring("pbd"));
        continue;
      }
      CHECK(simulation_of(build_scene(scene))->step());
    }
}

TEST_CASE("settings that need projections select pbd with coarse levels, other settings do not",
          "[defaults]") {
  const auto solver_of = [](const std::string& rest) {
    const Json run = resolved(R"({"name": "t", "mesh": {"cells": 3}, )" + rest + "}");
    return run.at("solver").at("method").get<std::string>() +
           (run.at("solver").contains("levels") ? " " + run.at("solver").at("levels").dump() : "") + " " +
           run.at("material").at("strain").at("stiffness").get<std::string>();
  };
  for (const char* projected :
       {R"("bending": {"k": 0.5})", R"("material": {"strain": {"stiffness": "k"}})",
        R"("material": {"strain": {"shear": 0.5}})", R"("bending": {"model": "choi_ko"})",
        R"("solver": {"flight_limit": 1})", R"("effects": [{"type": "strain_limiting"}])"}) {
    CAPTURE(projected);
    CHECK(solver_of(projected) == "pbd 12 k");
  }
  CHECK(solver_of(R"("solver": {"method": "pbd"})") == "pbd 12 physical");
  CHECK(solver_of(R"("solver": {"method": "pbd", "levels": 0})") == "pbd 0 physical");
  for (const char* implicit : {R"("effects": [{"type": "wind"}])", R"("effects": [{"type": "tethers"}])",
                               R"("solver": {"substeps": 2})", R"("bending": {"flexural_rigidity": 1e-4})"}) {
    CAPTURE(implicit);
    CHECK(solver_of(implicit) == "quasi_newton physical");
  }
  CHECK(solver_of(R"("material": {"strain": {"compliance": 1e-3}})") == "quasi_newton compliance");
}

}  // namespace bendlab::defaults_test
