#include "experiments/config/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"

namespace bendlab::config_test {
using Catch::Matchers::WithinRel;

namespace {

ConfigProblems problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_experiment(text, "test", overrides);
  } catch (const ConfigError& error) {
    return error.problems();
  }
  return {};
}

// The message of the problem at `pointer` if it is the only problem; else a list of all problems.
std::string only_problem(const std::string& text, const std::string& pointer) {
  const ConfigProblems problems = problems_of(text);
  if (problems.size() == 1 && problems[0].pointer == pointer) return problems[0].message;
  std::string list = std::to_string(problems.size()) + " problems:";
  for (const ConfigProblem& problem : problems) list += "\n" + problem.pointer + ": " + problem.message;
  return list;
}

RunConfig single_run(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Experiment experiment = parse_experiment(text, "test", overrides);
  REQUIRE(experiment.runs.size() == 1);
  return experiment.runs[0];
}

// A minimal config with this key in addition.
std::string with(const std::string& key_and_value) {
  return R"({"name": "t", "defaults": "paper", )" + key_and_value + "}";
}

}  // namespace

TEST_CASE("config: only the name is required, everything else has a default") {
  const Experiment experiment = parse_experiment(R"({"name": "minimal-1", "defaults": "paper"})", "test");
  CHECK(experiment.name == "minimal-1");
  CHECK(experiment.description.empty());
  CHECK(experiment.axes.empty());
  CHECK(experiment.expectations.empty());
  REQUIRE(experiment.runs.size() == 1);
  const RunConfig& run = experiment.runs[0];
  CHECK(run.point.empty());
  CHECK(run.mesh_file().empty());
  CHECK(run.scene().duration == 4);
  CHECK(run.scene().mesh.generator == Generator::grid);
  CHECK(run.scene().mesh.cells == 32);
  CHECK_FALSE(run.scene().mesh.file.has_value());
  CHECK(run.scene().pins.vertices == std::vector{Place::upper_right});
  CHECK(run.scene().pins.indices.empty());
  CHECK(run.scene().pins.ring == 1);
  CHECK(run.scene().material.warp_direction == Vector3(1, 0, 0));
  CHECK(run.scene().material.strain.form == StrainForm::normalised);
  CHECK(run.scene().bending.k == 0.5);
  CHECK_THAT(run.scene().solver.dt, WithinRel(1.0 / 60, 1e-15));  // one rounding
  CHECK(run.settings().output.constraints == false);
  CHECK(run.scene().bending.model.name() == "adaptive");
  CHECK(run.scene().bending.model.as<Adaptive>()->m_rounding == Rounding::floor);
  REQUIRE(run.scene().effects.size() == 1);
  CHECK(run.scene().effects[0].name() == "gravity");
  CHECK(run.scene().effects[0].as<Gravity>()->acceleration.z() == -9.81);
}

TEST_CASE("config: stated values arrive with their types") {
  const RunConfig run = single_run(R"({
    "name": "t", "description": "d", "duration": 2,
    "mesh": {"generator": "disc", "radius": 0.25, "cells": 8.0},
    "pins": {"vertices": [], "indices": [0, 7]},
    "bending": {"model": "k_ring", "k": 1, "k_ring": {"k": 3}},
    "effects": [{"type": "rigid_damping", "rate": 0.5}, {"type": "gravity", "acceleration": [0, -1, 0]}],
    "solver": {"precision": "double"}, "output": {"constraints": true}})");
  CHECK(run.scene().duration == 2);
  CHECK(run.scene().mesh.cells == 8);
  CHECK(run.scene().mesh.radius == 0.25);
  CHECK(run.scene().pins.vertices.empty());
  CHECK(run.scene().pins.indices == std::vector{0, 7});
  CHECK(run.scene().bending.model.name() == "k_ring");
  CHECK(run.scene().bending.model.as<KRing>()->k == 3);
  REQUIRE(run.scene().effects.size() == 2);
  CHECK(run.scene().effects[0].name() == "rigid_damping");
  CHECK(run.scene().effects[0].as<RigidDamping>()->rate == 0.5);
  CHECK(run.scene().effects[1].as<Gravity>()->acceleration == Vector3(0, -1, 0));
  CHECK(run.settings().output.constraints);
}

TEST_CASE("config: an empty list of effects differs from a config without effects") {
  CHECK(single_run(with(R"("effects": [])")).scene().effects.empty());
  CHECK(single_run(R"({"name": "t", "defaults": "paper"})").scene().effects.size() == 1);
}

TEST_CASE("config: a model without settings has no object of its own") {
  const RunConfig run = single_run(with(R"("bending": {"model": "none", "adaptive": {"m_min": 2}})"));
  CHECK(run.scene().bending.model.kind().settings.fields.empty());
  CHECK_FALSE(run.resolved()["bending"].contains("adaptive"));
  CHECK(run.scene().bending.model.as<Adaptive>() == nullptr);
}

TEST_CASE("config: a setting that does not exist is refused, and the nearest setting suggested") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(only_problem(with(R"("mesh": {"cels": 8})"), "/mesh/cels"),
             ContainsSubstring("did you mean 'cells'?") &&
                 ContainsSubstring("Allowed here: generator, file, width"));
  CHECK_THAT(only_problem(with(R"("solvr": {})"), "/solvr"), ContainsSubstring("did you mean 'solver'?"));
  CHECK_THAT(only_problem(with(R"("dt": 0.1)"), "/dt"), ContainsSubstring("did you mean '/solver/dt'?"));
  CHECK_THAT(only_problem(with(R"("bending": {"adaptive": {"m_mni": 1}})"), "/bending/adaptive/m_mni"),
             ContainsSubstring("did you mean 'm_min'?"));
  CHECK_THAT(
      only_problem(with(R"("effects": [{"type": "gravity", "acelleration": 1}])"), "/effects/0/acelleration"),
      ContainsSubstring("did you mean 'acceleration'?"));
  CHECK_THAT(only_problem(with(R"("wombat": 1)"), "/wombat"),
             ContainsSubstring("Allowed") && !ContainsSubstring("did you mean"));
  CHECK_THAT(only_problem(with(R"("mesh": {"a/b~c": 8})"), "/mesh/a~1b~0c"), ContainsSubstring("'a/b~c'"));
}

TEST_CASE("config: a value that is not among the choices is refused, and the nearest choice suggested") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(only_problem(with(R"("bending": {"model": "adaptve"})"), "/bending/model"),
             ContainsSubstring("none, crossover, k_ring, adaptive, lod") &&
                 ContainsSubstring("did you mean 'adaptive'?"));
  CHECK_THAT(only_problem(with(R"("pins": {"vertices": ["top", "center"]})"), "/pins/vertices/1"),
             ContainsSubstring("did you mean 'centre'?"));
  CHECK_THAT(only_problem(with(R"("effects": [{"type": "gravty"}])"), "/effects/0/type"),
             ContainsSubstring("did you mean 'gravity'?"));
  CHECK_THAT(only_problem(with(R"("solver": {"precision": "Double"})"), "/solver/precision"),
             ContainsSubstring("did you mean 'double'?"));
}

TEST_CASE(
    "config: for a wrong type or a value out of range, the message names allowed values and the value") {
  struct Case {
    const char *json, *pointer, *message;
  };
  const Case cases[] = {
      {R"("mesh": {"cells": 3.5})", "/mesh/cells", "expected a whole number from 1 to 4096, got 3.5"},
      {R"("mesh": {"cells": "32"})", "/mesh/cells", "got the text \"32\""},
      {R"("mesh": {"cells": 4097})", "/mesh/cells", "got 4097"},
      {R"("mesh": {"cells": true})", "/mesh/cells", "got true"},
      {R"("mesh": {"cells": null})", "/mesh/cells", "got null"},
      {R"("mesh": {"cells": [8, 16]})", "/mesh/cells", "got a list"},
      {R"("mesh": {"width": 0})", "/mesh/width", "expected a number above 0 (in m), got 0"},
      {R"("mesh": {"seed": 18446744073709551615})", "/mesh/seed", "got 18446744073709551615"},
      {R"("mesh": {"generator": 1})", "/mesh/generator", "got 1"},
      {R"("mesh": {"file": ""})", "/mesh/file", "must not be empty"},
      {R"("mesh": 5)", "/mesh", "expected an object {…}, got 5"},
      {R"("mesh": null)", "/mesh", "got null"},
      {R"("material": {"strain": []})", "/material/strain", "got an empty list"},
      {R"("material": {"warp_direction": [1, 0]})", "/material/warp_direction",
       "expected a list of 3 numbers"},
      {R"("material": {"warp_direction": [1, 0, "x"]})", "/material/warp_direction/2", "expected a number"},
      {R"("material": {"warp_direction": [0, 0, 0]})", "/material/warp_direction", "zero vector"},
      {R"("pins": {"vertices": "top"})", "/pins/vertices", "expected a list of texts"},
      {R"("pins": {"vertices": [null]})", "/pins/vertices/0", "got null"},
      {R"("pins": {"indices": [1, 2.5]})", "/pins/indices/1", "expected a whole number"},
      {R"("pins": {"indices": [-1]})", "/pins/indices/0", "expected a whole number of at least 0, got -1"},
      {R"("output": {"constraints": 1})", "/output/constraints", "expected true or false, got 1"},
      {R"("initial": {"tilt": 180.5})", "/initial/tilt", "expected a number from -180 to 180 (in degrees)"},
      {R"("effects": {"type": "gravity"})", "/effects", "expected a list"},
      {R"("effects": ["gravity"])", "/effects/0", "expected an object"},
      {R"("effects": [{}])", "/effects/0/type", "is missing: expected one of gravity"},
      {R"("effects": [{"type": "gravity"}, {"type": "gravity"}])", "/effects/1",
       "already listed at /effects/0"},
      {R"("sweep": [1])", "/sweep", "expected an object"},
      {R"("expect": {})", "/expect", "expected a list"},
  };
  for (const Case& c : cases)
    CHECK_THAT(only_problem(with(c.json), c.pointer), Catch::Matchers::ContainsSubstring(c.message));
}

TEST_CASE("config: the ends of a range belong to the range, except for `above`") {
  CHECK(problems_of(with(R"("mesh": {"cells": 4096}, "bending": {"k": 0}, "initial": {"tilt": -180})"))
            .empty());
  CHECK(problems_of(with(R"("duration": 0)")).size() == 1);
  CHECK(problems_of(with(R"("settled_speed": 5e-324)")).empty());  // the smallest double above 0
  CHECK(problems_of(with(R"("duration": 1e-9, "solver": {"dt": 1e-9})")).empty());
  CHECK(problems_of(with(R"("solver": {"dt": 0.9e-9})")).size() == 1);
}

TEST_CASE("config: the name must be valid as the name of a folder") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(only_problem("{}", "/name"), ContainsSubstring("is missing"));
  CHECK_THAT(only_problem(R"({"name": ""})", "/name"), ContainsSubstring("must not be empty"));
  for (const char* name : {"../up", "a b", "a.b", "a/b", "ä"})
    CHECK_THAT(only_problem(R"({"name": ")" + std::string(name) + R"("})", "/name"),
               ContainsSubstring("letters (a-z, A-Z)"));
}

TEST_CASE("config: a mesh file replaces the generator") {
  const RunConfig run = single_run(with(R"("mesh": {"file": "shirt.obj", "scale": 0.001})"));
  CHECK(run.scene().mesh.file == "shirt.obj");
  CHECK(run.resolved()["mesh"].size() ==
        4);  // the file, its scale, its offset and the policy for bad triangles
  CHECK(single_run(with(R"("mesh": {"file": null})")).scene().mesh.generator == Generator::grid);
  CHECK_THAT(only_problem(with(R"("mesh": {"file": "shirt.obj", "generator": "grid"})"), "/mesh/generator"),
             Catch::Matchers::ContainsSubstring("/mesh/file"));
}

TEST_CASE("config: a mesh file is looked for beside the config") {
  const auto folder = std::filesystem::temp_directory_path() / "bendlab-config-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "file.json") << with(R"("mesh": {"file": "meshes/shirt.obj"})");
  const Experiment experiment = load_experiment(folder / "file.json");
  CHECK(experiment.source == folder / "file.json");
  CHECK(experiment.runs[0].mesh_file() == folder / "meshes/shirt.obj");
  CHECK(experiment.runs[0].resolved()["mesh"]["file"] == "meshes/shirt.obj");  // the same on every machine
  CHECK_THROWS_WITH(load_experiment(folder / "missing.json"),
                    Catch::Matchers::ContainsSubstring("missing.json") &&
                        Catch::Matchers::ContainsSubstring("cannot be read"));
  CHECK_THROWS_AS(load_experiment(folder), ConfigError);
  std::filesystem::remove_all(folder);
}

TEST_CASE(
    "config: the file of an effect is looked for beside the config, and its content changes the run's id") {
  const auto folder = std::filesystem::temp_directory_path() / "bendlab-config-effect-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "file.json")
      << with(R"("effects": [{"type": "gravity"}, {"type": "mesh_obstacle", "file": "body.obj"}])");
  const Experiment experiment = load_experiment(folder / "file.json");
  const RunConfig& run = experiment.runs[0];
  CHECK(run.resolved()["effects"][1]["file"] == "body.obj");  // the same on every machine
  CHECK(input_files(run).back().path == folder / "body.obj");
  const std::vector<NamedFile> files = {{"/effects/1/file", "body.obj", folder / "body.obj"}};
  CHECK(input_files(run) == files);
  CHECK_THROWS_WITH(run_id(run), Catch::Matchers::ContainsSubstring("/effects/1/file"));
  std::ofstream(folder / "body.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string id = run_id(run);
  CHECK(run_id(run) == id);
  std::ofstream(folder / "body.obj") << "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK(run_id(run) != id);
  std::filesystem::remove_all(folder);
}

TEST_CASE("config: if settings of an effect contradict each other, the problem names the effect") {
  const RunConfig run =
      single_run(with(R"("effects": [{"type": "gravity"}, {"type": "plane", "normal": [0, 0, 0]}])"));
  CHECK_THROWS_WITH(
      simulation_of(build_scene(run.scene())),
      Catch::Matchers::ContainsSubstring("/effects/1") && Catch::Matchers::ContainsSubstring("zero vector"));
}

TEST_CASE("config: text that is not JSON is refused with line and column") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(only_problem("{\"name\": \"t\",\n  \"mesh\": {\"cells\": 3,}}", ""),
             ContainsSubstring("line 2, column 23"));
  CHECK_THAT(only_problem("{\"name\": \"é\" x}", ""),
             ContainsSubstring("line 1, column 14"));  // é is one column
  CHECK_THAT(only_problem(R"({"name": "t"} {})", ""), ContainsSubstring("expected end of input"));
  CHECK_THAT(only_problem(R"({"name": "t"} // note)", ""), ContainsSubstring("not JSON"));
  CHECK_THAT(only_problem(R"({"duration": NaN})", ""), ContainsSubstring("line 1, column 14"));
  CHECK_THAT(only_problem("{\"name\": \"\xff\"}", ""), ContainsSubstring("UTF-8"));
  CHECK_THAT(only_problem("\xEF\xBB\xBF{\"name\": \"t\"}", ""), ContainsSubstring("byte order mark"));
  CHECK_THAT(only_problem(" \n", ""), ContainsSubstring("is empty"));
  CHECK_THAT(only_problem("[]", ""), ContainsSubstring("a config must be a JSON object"));
}

TEST_CASE("config: numbers must be finite, keys unique, nesting at most 64 deep") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(only_problem("{\"name\": \"t\",\n\"pins\": {\"indices\": [1, 1e999]}}", "/pins/indices/1"),
             ContainsSubstring("line 2, column 25: 1e999 is not finite"));
  CHECK_THAT(only_problem(R"({"name": "t", "defaults": "paper",
          "mesh": {"cells": 4, "cells": 8}})",
                          "/mesh/cells"),
             ContainsSubstring("twice"));
  CHECK_THAT(only_problem(R"({"name": "t", "defaults": "paper",
          "effects": [{"type": "gravity", "type": "gravity"}]})",
                          "/effects/0/type"),
             ContainsSubstring("twice"));
  CHECK_NOTHROW(parse_strict_json(std::string(64, '[') + std::string(64, ']'), "test"));
  CHECK_THROWS_WITH(parse_strict_json(std::string(65, '[') + std::string(65, ']'), "test"),
                    ContainsSubstring("nested deeper than 64"));
  CHECK_THROWS_AS(parse_strict_json(std::string(1000000, '['), "test"), ConfigError);
}

TEST_CASE("config: a duplicate key does not hide other problems") {
  CHECK(parse_strict_json(R"([{"a": {"b": [1, 2]}, "c": 3}])", "test").dump() ==
        R"([{"a":{"b":[1,2]},"c":3}])");
  const ConfigProblems problems = problems_of(R"({"name": "t", "defaults": "paper",
          "mesh": {}, "mesh": {"cels": [{}]}, "dutration": 1})");
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].pointer == "/mesh");
  CHECK(problems[1].pointer == "/dutration");
}

TEST_CASE("config: all problems of a file are reported at once") {
  const ConfigProblems problems = problems_of(R"({
    "name": "a b", "mesh": {"cels": 1, "width": -1, "width": 1}, "bending": {"k": 2, "model": "x"},
    "effects": [{"type": "gravity", "acceleration": 1}],
    "sweep": {"/mesh/cel": [1], "/bending/k": [0.5, "x"]},
    "expect": [{"metric": "drop", "max": 1}]})",
                                              {"/solver/dtt=1"});
  std::vector<std::string> pointers;
  for (const ConfigProblem& problem : problems) pointers.push_back(problem.pointer);
  std::ranges::sort(pointers);
  CHECK(pointers == std::vector<std::string>{"/bending/k", "/bending/model", "/effects/0/acceleration",
                                             "/expect/0/why", "/mesh/cels", "/mesh/width", "/mesh/width",
                                             "/name", "/solver/dtt", "/sweep/~1bending~1k/1",
                                             "/sweep/~1mesh~1cel"});
}

TEST_CASE("config: the text of the error has the file and every problem") {
  CHECK_THROWS_WITH(parse_experiment(R"({"name": "t", "defaults": "paper",
          "x": 1, "duration": 0})",
                                     "file.json"),
                    Catch::Matchers::StartsWith("file.json: 2 problems\n  /x: ") &&
                        Catch::Matchers::ContainsSubstring("\n  /duration: "));
}

TEST_CASE("config: configs with the same physics have the same identity text") {
  const std::string minimal = single_run(R"({"name": "t", "defaults": "paper"})").resolved().dump();
  // Another name, another order of keys, other spellings of numbers, and settings of a model that is not
  // chosen.
  CHECK(single_run(R"({"solver": {"iterations": 10.0, "substeps": 1}, "description": "other",
                       "allow": ["implausible"], "bending": {"lod": {"t": 3}, "k": 5e-1}, "duration": 4,
                       "initial": {"tilt": -0.0}, "defaults": "paper",
                       "effects": [{"acceleration": [0, 0, -9.81], "type": "gravity"}], "name": "u"})")
            .resolved()
            .dump() == minimal);
  CHECK(single_run(R"({"name": "t", "defaults": "paper", "duration": 4.1})").resolved().dump() != minimal);
}

TEST_CASE("config: the mass-spring method needs springs of a known stiffness") {
  using Catch::Matchers::ContainsSubstring;
  const std::string head = R"("solver": {"method": "kang_cho"}, )";
  const std::string strain = R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}}, )";
  const std::string bending =
      R"("bending": {"model": "crossover", "stiffness": "compliance", "compliance": 1})";
  const RunConfig run = single_run(with(head + strain + bending));
  CHECK(run.scene().solver.method.name() == "kang_cho");
  CHECK(run.scene().solver.method.as<KangCho>()->tangent == KangCho::Tangent::along);
  CHECK_NOTHROW(single_run(
      with(head + strain + R"("bending": {"model": "none"})")));  // without springs no stiffness is needed

  const ConfigProblems both = problems_of(with(R"("solver": {"method": "kang_cho"})"));
  REQUIRE(both.size() == 2);
  CHECK(both[0].pointer == "/material/strain/stiffness");
  CHECK(both[1].pointer == "/bending/stiffness");
  CHECK_THAT(both[1].message, ContainsSubstring("/bending/compliance above 0"));
  CHECK_THAT(only_problem(with(head + R"("material": {"strain": {"stiffness": "compliance"}}, )" + bending),
                          "/material/strain/compliance"),
             ContainsSubstring("must be above 0"));
  CHECK_THAT(only_problem(with(head + strain + R"("bending": {"model": "dihedral"})"), "/bending/model"),
             ContainsSubstring("none, crossover, k_ring, adaptive, lod"));
  CHECK_THAT(only_problem(with(head + strain + bending + R"(, "effects": [{"type": "gravity"}, )" +
                               R"({"type": "constraint_damping"}])"),
                          "/effects/1"),
             ContainsSubstring("constraint_damping acts between iterations"));
}

TEST_CASE("config: quasi_newton refuses a model whose force jumps") {
  using Catch::Matchers::ContainsSubstring;
  const std::string head = R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}}, )";
  const std::string bending =
      R"("bending": {"model": "choi_ko", "stiffness": "compliance", "compliance": 1}, )";
  CHECK_THAT(only_problem(with(head + bending + R"("solver": {"method": "quasi_newton"})"), "/bending/model"),
             ContainsSubstring("choose the method newton"));
  CHECK(problems_of(with(head + bending + R"("solver": {"method": "newton"})")).empty());
}

TEST_CASE("config: each method has its own defaults") {
  const std::string head =
      R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}},
         "bending": {"model": "none"}, "solver": )";
  const auto integrator_of = [&](const std::string& solver) {
    return single_run(with(head + solver)).resolved().at("solver").at("integrator").get<std::string>();
  };
  CHECK(integrator_of(R"({"method": "quasi_newton"})") == "euler");
  CHECK(integrator_of(R"({"method": "quasi_newton", "integrator": "bdf2"})") == "bdf2");
  CHECK(integrator_of(R"({"method": "newton"})") == "bdf2");
}

TEST_CASE("config: coarse levels need a membrane that resists in every direction") {
  using Catch::Matchers::ContainsSubstring;
  const auto with_strain = [](const std::string& strain) {
    return with(R"("solver": {"levels": 2}, "material": {"strain": {)" + strain + "}}");
  };
  CHECK(problems_of(with_strain("")).empty());
  CHECK_THAT(only_problem(with_strain(R"("shear": 0)"), "/material/strain/shear"),
             ContainsSubstring("the coarse levels of /solver/levels"));
  CHECK(problems_of(with(R"("material": {"strain": {"shear": 0}})")).empty());
}

TEST_CASE("config: settings that the solver method does not use do not change the run's identity") {
  const std::string kang_cho =
      R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}},
         "bending": {"model": "crossover", "stiffness": "compliance", "compliance": 1},
         "solver": {"method": "kang_cho"})";
  const std::string text = identity_text(single_run(with(kang_cho)).resolved());
  for (const char* unused : {"/solver/iterations=3", "/solver/sweep=symmetric", "/solver/order=mesh",
                             "/solver/first=bending", "/material/strain/warp=0.5"})
    CHECK(identity_text(single_run(with(kang_cho), {unused}).resolved()) == text);
  for (const char* used : {"/solver/tangent=taut", "/solver/substeps=2", "/bending/compliance=2"})
    CHECK(identity_text(single_run(with(kang_cho), {used}).resolved()) != text);
  const std::string pbd = identity_text(single_run(R"({"name": "t"})").resolved());
  CHECK(identity_text(single_run(R"({"name": "t"})", {"/solver/tangent=taut"}).resolved()) == pbd);
}

TEST_CASE("config: an equilibrium needs energies and loads") {
  const std::string equilibrium =
      R"("material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}},
         "bending": {"model": "dihedral", "stiffness": "compliance", "compliance": 1},
         "solver": {"method": "equilibrium"})";
  const std::string text = identity_text(single_run(with(equilibrium)).resolved());
  for (const char* unused : {"/solver/iterations=3", "/solver/substeps=5", "/solver/precision=double"})
    CHECK(identity_text(single_run(with(equilibrium), {unused}).resolved()) == text);
  CHECK(identity_text(single_run(with(equilibrium), {"/material/strain/shear=0.5"}).resolved()) != text);
  CHECK(problems_of(with(R"("solver": {"method": "equilibrium"})")).size() ==
        2);  // k for strain and for bending
  CHECK_THAT(only_problem(with(equilibrium + R"(, "effects": [{"type": "sphere"}])"), "/effects/0"),
             Catch::Matchers::ContainsSubstring("acts between iterations"));
}

TEST_CASE("config: the resolved config reads back as the same config") {
  for (const BendingKind* model : bending_models()) {
    if (model->needs_energy) continue;  // the paper's stiffness is k
    const std::string text =
        single_run(with(R"("bending": {"model": ")" + std::string(model->name) +
                        R"("}, "effects": [{"type": "rigid_damping"}], "duration": 0.1)"))
            .resolved()
            .dump();
    CHECK(single_run(text, {"/name=again"}).resolved().dump() == text);
  }
  const std::string file = single_run(with(R"("mesh": {"file": "a.obj"})")).resolved().dump();
  CHECK(single_run(file, {"/name=again"}).resolved().dump() == file);
}

TEST_CASE("config: the number of threads does not change the run's identity") {
  const RunConfig default_threads = single_run(R"({"name": "t", "defaults": "paper"})"),
                  two_threads = single_run(with(R"("solver": {"threads": 2})"));
  CHECK(identity_text(default_threads.resolved()) == identity_text(two_threads.resolved()));
  CHECK(default_threads.resolved() != two_threads.resolved());
  CHECK(identity_text(default_threads.resolved()) !=
        identity_text(single_run(with(R"("solver": {"iterations": 11})")).resolved()));
  CHECK_THAT(identity_text(default_threads.resolved()), !Catch::Matchers::ContainsSubstring("threads"));
}

TEST_CASE("config: the kind of physical stiffness depends on the constraints of the model") {
  using Catch::Matchers::ContainsSubstring;
  const auto bending = [](const std::string& settings) {
    return with(R"("bending": {"stiffness": "physical", )" + settings + "}");
  };
  const auto problem = [&](const std::string& settings, const std::string& key) {
    return only_problem(bending(settings), "/bending/" + key);
  };
  CHECK_THAT(problem(R"("model": "lod", "flexural_rigidity": 1e-5, "quartic_coefficient": 1e-9)",
                     "quartic_coefficient"),
             ContainsSubstring("remove one of these settings"));
  CHECK_THAT(problem(R"("model": "bridson", "quartic_coefficient": 1e-9)", "quartic_coefficient"),
             ContainsSubstring("set flexural_rigidity"));
  CHECK_THAT(problem(R"("model": "bridson", "flexural_rigidity": 0)", "flexural_rigidity"),
             ContainsSubstring("above 0"));
  CHECK(problems_of(bending(R"("model": "none")")).empty());
  // For the mass-spring method it is a known stiffness, like a compliance.
  CHECK(problems_of(R"({"name": "t", "defaults": "paper", "solver": {"method": "kang_cho"},
    "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}},
    "bending": {"model": "lod", "stiffness": "physical", "quartic_coefficient": 1e-9}})")
            .empty());
  // A membrane has its own physical stiffness, in N/m.
  CHECK(problems_of(with(R"("material": {"strain": {"stiffness": "physical"}})")).empty());
}

TEST_CASE("config: contradicting stiffnesses are refused, and the message names both") {
  const auto refused = [](const std::string& bending, const std::string& both) {
    INFO(bending);
    CHECK_THAT(
        only_problem(with(R"("bending": {"model": "dihedral", )" + bending + "}"), "/bending/stiffness"),
        Catch::Matchers::ContainsSubstring(both + " are given"));
  };
  refused(R"("k": 0.5, "compliance": 1)", "k and compliance");
  refused(R"("k": 0.5, "flexural_rigidity": 1e-4)", "k and a rigidity");
  refused(R"("compliance": 1, "flexural_rigidity": 1e-4)", "compliance and a rigidity");
}

TEST_CASE("config: only the settings that a stiffness uses are part of the resolved config") {
  const std::string settings = R"("k": 0.3, "compliance": 2, "flexural_rigidity": 1e-5, "at_curvature": 40)";
  const auto kept = [&](const std::string& kind) {
    return single_run(with(R"("bending": {"stiffness": ")" + kind + "\", " + settings + "}"))
        .resolved()["bending"];
  };
  CHECK_FALSE(kept("physical").contains("k"));
  CHECK_FALSE(kept("physical").contains("compliance"));
  CHECK(kept("physical")["flexural_rigidity"] == 1e-5);
  CHECK_FALSE(kept("compliance").contains("flexural_rigidity"));
  CHECK_FALSE(kept("compliance").contains("at_curvature"));
}

TEST_CASE("config: the solver of a scene has the settings of its method") {
  const BuiltScene cut = build_scene(single_run(with(R"("solver": {"flight_limit": 0.7})")).scene());
  CHECK(settings_of<Pbd>(cut.input).flight_limit == 0.7);
  const BuiltScene whole = build_scene(single_run(with(R"("solver": {"flight_limit": 0})")).scene());
  CHECK(settings_of<Pbd>(whole.input).flight_limit == 0);
}

TEST_CASE("config: a scene counts the springs that do not join neighbours") {
  const auto beyond = [](const std::string& bending) {
    return build_scene(single_run(with(R"("mesh": {"cells": 4}, "pins": {"vertices": []},
                                        "bending": )" +
                                       bending))
                           .scene())
        .springs_beyond_ring_1;
  };
  CHECK(beyond(R"({"model": "crossover"})") == 40);  // a spring across each of 56 - 16 interior edges
  CHECK(beyond(R"({"model": "k_ring", "k_ring": {"k": 1}})") == 0);
}

TEST_CASE("config: in a scene with physical stiffness the compliance is 1") {
  const std::string text =
      R"({"name": "t", "defaults": "paper",
          "mesh": {"generator": "equilateral", "width": 0.24, "height": 0.24, "cells": 12},
    "pins": {"vertices": []},
    "bending": {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 3e-5}})";
  const BuiltScene scene = build_scene(single_run(text).scene());
  CHECK(scene.input.bending_stiffness.kind == StiffnessKind::compliance);
  CHECK(scene.input.bending_stiffness.compliance == 1);
  CHECK(std::ranges::count(scene.bending_facts, "linear_factor", &BendingFact::name) == 1);
  // Uniform hinges have √3/2 k, except at free edges, where they are a few percent stiffer to make up for
  // missing hinges.
  const auto& hinges = std::get<ElementList<HingeAngle>>(scene.input.elements);
  std::vector<double> stiffness;
  for (const double softness : hinges.softness) stiffness.push_back(1 / softness);
  std::ranges::nth_element(stiffness, stiffness.begin() + static_cast<std::ptrdiff_t>(stiffness.size() / 2));
  CHECK_THAT(stiffness[stiffness.size() / 2], WithinRel(2 / std::sqrt(3.0) * 3e-5, 0.03));
  // Problems that only the mesh reveals are errors of the config, too.
  CHECK_THROWS_AS(single_run(R"({"name": "t", "defaults": "paper",
          "mesh": {"generator": "tube"}, "pins": {"vertices": ["top_rim"]},
    "bending": {"model": "lod", "stiffness": "physical", "quartic_coefficient": 1e-9}})"),
                  ConfigError);
}

}  // namespace bendlab::config_test
