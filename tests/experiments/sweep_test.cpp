#include "experiments/config/experiment.hpp"

#include <string>
#include <vector>

#include "experiments/campaign/run_labels.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"

namespace bendlab::sweep_test {
using Catch::Matchers::ContainsSubstring;

namespace {

Experiment experiment(const std::string& rest, const std::vector<std::string>& overrides = {}) {
  return parse_experiment(R"({"name": "t", "defaults": "paper", )" + rest + "}", "test", overrides);
}

ConfigProblems problems_of(const std::string& rest, const std::vector<std::string>& overrides = {}) {
  try {
    experiment(rest, overrides);
  } catch (const ConfigError& error) {
    return error.problems();
  }
  return {};
}

void check_problem(const std::string& rest, const std::string& pointer, const std::string& message,
                   const std::vector<std::string>& overrides = {}) {
  const ConfigProblems problems = problems_of(rest, overrides);
  CAPTURE(rest, overrides);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].pointer == pointer);
  CHECK_THAT(problems[0].message, ContainsSubstring(message));
}

// The values at `pointer` over the runs, as JSON texts.
std::vector<std::string> values(const Experiment& of, const std::string& pointer) {
  std::vector<std::string> result;
  for (const RunConfig& run : of.runs)
    result.push_back(run.resolved().at(Json::json_pointer(pointer)).dump());
  return result;
}

using Texts = std::vector<std::string>;
const std::string two_axes =
    R"("sweep": {"/bending/model": ["crossover", "adaptive"], "/mesh/cells": [16, 32.0, 64]})";

}  // namespace

TEST_CASE("sweep: runs are all combinations in order, and the last axis varies fastest") {
  const Experiment swept = experiment(two_axes);
  CHECK(values(swept, "/mesh/cells") == Texts{"16", "32", "64", "16", "32", "64"});
  CHECK(values(swept, "/bending/model") == Texts{"\"crossover\"", "\"crossover\"", "\"crossover\"",
                                                 "\"adaptive\"", "\"adaptive\"", "\"adaptive\""});
  REQUIRE(swept.axes.size() == 2);
  CHECK(swept.axes[1].first == "/mesh/cells");
  CHECK(swept.axes[1].second[1].dump() == "32");  // 32.0 is a whole number
  REQUIRE(swept.runs[4].point.size() == 2);
  CHECK(swept.runs[4].point[0] == std::pair<std::string, Json>("/bending/model", "adaptive"));
  CHECK(swept.runs[4].point[1] == std::pair<std::string, Json>("/mesh/cells", 32));
}

TEST_CASE("sweep: axes with the same last name have their pointers as headings") {
  CHECK(axis_headings(
            experiment(R"("sweep": {"/mesh/seed": [1], "/mesh/cells": [4], "/initial/seed": [1, 2]})")) ==
        Texts{"/mesh/seed", "cells", "/initial/seed"});
}

TEST_CASE("sweep: a run of a sweep has the same settings as a single run") {
  const Experiment swept = experiment(R"("sweep": {
      "/mesh": [{"cells": 3}, {"generator": "disc", "cells": 4}, {}],
      "/bending": [{"model": "k_ring", "k_ring": {"k": 3}}, {"model": "k_ring"}, {"model": "none"}],
      "/material/strain/shear": [1, 0.25],
      "/effects": [[{"type": "gravity"}], [{"type": "gravity", "acceleration": [0, 0, -1]}], []]})");
  REQUIRE(swept.runs.size() == 54);
  for (const RunConfig& run : swept.runs) {
    CHECK(stored_run(run.resolved()).resolved() == run.resolved());
    const Json settings = [&] {
      Json named = run.resolved();
      named["name"] = "t";
      return named;
    }();
    CHECK(parse_experiment(settings.dump(), "alone").runs.front().resolved() == run.resolved());
  }
}

TEST_CASE("sweep: a run and its folder are named after the place in the sweep") {
  const Experiment swept =
      experiment(R"("sweep": {"/mesh/cells": [8, 16], "/bending/model": ["lod", "isometric"]})");
  const Experiment single = experiment(R"("mesh": {"cells": 8})");
  const RunConfig& third = swept.runs.at(2);
  CHECK(run_text(swept, third) == "t (cells 16, model lod)");
  CHECK(place_text(swept, third) == "cells 16, model lod");
  CHECK(run_folder("out", swept, third, "0123") == "out/t/cells=16,model=lod-0123");
  CHECK(run_text(single, single.runs.at(0)) == "t");
  CHECK(place_text(single, single.runs.at(0)) == "t");
  // An object is named by the settings in which it differs from the other objects.
  const Experiment objects = experiment(R"("sweep": {"/solver": [
      {"dt": 0.01, "substeps": 8}, {"dt": 0.01, "method": "pbd", "substeps": 4}, {"dt": 0.01}]})");
  CHECK(place_text(objects, objects.runs.at(0)) == "solver substeps 8");
  CHECK(place_text(objects, objects.runs.at(1)) == "solver pbd, substeps 4");
  CHECK(place_text(objects, objects.runs.at(2)) == "solver as it is");
  const Experiment merged = experiment(R"("sweep": {"/solver": [{"substeps": 2, "iterations": 3}]})");
  CHECK(place_text(merged, merged.runs.at(0)) == "solver iterations 3, substeps 2");
  const Experiment lists = experiment(R"("sweep": {"/pins": [{"vertices": ["top"]}, {"indices": [3, 4]}]})");
  CHECK(place_text(lists, lists.runs.at(1)) == "pins indices [3,4]");
  CHECK(run_folder("out", single, single.runs.at(0), "0123") == "out/t/0123");
}

TEST_CASE("sweep: an empty sweep is a single run") {
  CHECK(experiment(R"("sweep": {})").runs.size() == 1);
}

TEST_CASE("sweep: points with the same run are merged, and the label names only the settings that matter") {
  const Experiment swept = experiment(R"("sweep": {
    "/bending/model": ["crossover", "adaptive"], "/bending/adaptive/m_rounding": ["floor", "round"]})");
  REQUIRE(swept.runs.size() == 3);  // crossover once, adaptive twice
  CHECK(swept.runs[0].scene().bending.model.name() == "crossover");
  CHECK(swept.runs[0].point.size() == 1);
  CHECK(swept.runs[1].scene().bending.model.as<Adaptive>()->m_rounding == Rounding::floor);
  CHECK(swept.runs[2].scene().bending.model.as<Adaptive>()->m_rounding == Rounding::round);
  CHECK(swept.runs[2].point.size() == 2);
  CHECK(experiment(R"("sweep": {"/bending/k": [1, 1.0, 0.5]})").runs.size() == 2);
}

TEST_CASE("sweep: whole objects, lists, effects and their settings can be swept") {
  const Experiment objects =
      experiment(R"("mesh": {"cells": 5}, "sweep": {"/mesh": [{"generator": "disc"}, {"file": "a.obj"}]})");
  CHECK(values(objects, "/mesh").at(1) ==
        R"({"file":"a.obj","scale":1.0,"offset":[0.0,0.0,0.0],"bad_triangles":"refuse"})");
  CHECK(objects.runs.at(0).scene().mesh.cells == 32);  // the object is replaced as a whole
  CHECK(objects.runs.at(0).mesh_file().empty());
  CHECK(objects.runs.at(1).mesh_file() == "a.obj");

  const Experiment lists = experiment(R"("sweep": {"/pins/vertices": [["top"], ["top", "bottom"], []]})");
  CHECK(values(lists, "/pins/vertices") == Texts{R"(["top"])", R"(["top","bottom"])", "[]"});

  const Experiment settings = experiment(R"("effects": [{"type": "gravity"}, {"type": "rigid_damping"}],
                                            "sweep": {"/effects/1/rate": [0, 2]})");
  CHECK(values(settings, "/effects/1/rate") == Texts{"0.0", "2.0"});

  const Experiment default_gravity =
      experiment(R"("sweep": {"/effects/0/acceleration": [[0, 0, -1], [0, 0, -2]]})");
  CHECK(values(default_gravity, "/effects/0/acceleration/2") == Texts{"-1.0", "-2.0"});

  const Experiment whole_list = experiment(R"("sweep": {"/effects": [[], [{"type": "gravity"}]]})");
  CHECK(whole_list.runs.at(0).scene().effects.empty());
  CHECK(whole_list.runs.at(1).scene().effects.size() == 1);

  // An object first, then a setting inside it.
  const Experiment nested =
      experiment(R"("sweep": {"/bending": [{"model": "lod"}, {"model": "none"}], "/bending/k": [0.1, 0.2]})");
  CHECK(values(nested, "/bending/k") == Texts{"0.1", "0.2", "0.1", "0.2"});
}

TEST_CASE("sweep: pointers must name a setting, lists must hold allowed values") {
  check_problem(R"("sweep": {"/mesh/cels": [8]})", "/sweep/~1mesh~1cels", "did you mean '/mesh/cells'?");
  check_problem(R"("sweep": {"mesh/cells": [8]})", "/sweep/mesh~1cells", "did you mean '/mesh/cells'?");
  check_problem(R"("sweep": {"/iterations": [8]})", "/sweep/~1iterations",
                "did you mean '/solver/iterations'?");
  check_problem(R"("sweep": {"/name": ["a"]})", "/sweep/~1name", "cannot be swept");
  check_problem(R"("sweep": {"": [{}]})", "/sweep/", "cannot be swept");
  check_problem(R"("sweep": {"/effects/1/rate": [1]})", "/sweep/~1effects~11~1rate", "cannot be swept");
  check_problem(R"("sweep": {"/mesh/cells": []})", "/sweep/~1mesh~1cells", "at least one value");
  check_problem(R"("sweep": {"/mesh/cells": 8})", "/sweep/~1mesh~1cells", "at least one value");
  check_problem(R"("sweep": {"/mesh/cells": [8, 0, 16]})", "/sweep/~1mesh~1cells/1", "from 1 to 4096, got 0");
  check_problem(R"("sweep": {"/mesh": [{}, {"cels": 1}]})", "/sweep/~1mesh/1/cels", "did you mean 'cells'?");
  check_problem(R"("sweep": {"/pins/vertices": [["tp"]]})", "/sweep/~1pins~1vertices/0/0",
                "did you mean 'top'?");
  check_problem(R"("sweep": {"/bending/k": [1], "/bending": [{}]})", "/sweep/~1bending",
                "overwrite the values of '/bending/k'");
}

TEST_CASE("sweep: settings that a sweep replaces are checked, too") {
  check_problem(R"("mesh": {"cells": 0}, "sweep": {"/mesh/cells": [8]})", "/mesh/cells", "got 0");
}

TEST_CASE("sweep: values that contradict each other are refused") {
  check_problem(R"("mesh": {"file": "a.obj"}, "sweep": {"/mesh/generator": ["grid"]})",
                "/sweep/~1mesh~1generator/0", "cannot be combined with /mesh/file");
  check_problem(R"("sweep": {"/mesh/file": [null, "a.obj"], "/mesh/generator": ["grid", "disc"]})",
                "/sweep/~1mesh~1file/1",
                "with this value /mesh/generator: cannot be combined with /mesh/file");
  // Every value is valid alone, but one of the four combinations lists an effect twice.
  check_problem(R"("effects": [{"type": "gravity"}, {"type": "rigid_damping"}], "sweep": {
                   "/effects/0/type": ["gravity", "constraint_damping"],
                   "/effects/1/type": ["rigid_damping", "constraint_damping"]})",
                "/effects/1",
                R"((at /effects/0/type = "constraint_damping", /effects/1/type = "constraint_damping"))");
}

TEST_CASE("sweep: too many combinations are refused") {
  std::string list = "[1";
  for (int i = 2; i <= 101; ++i) list += ", " + std::to_string(i);
  list += "]";
  const std::string sweep =
      R"("sweep": {"/mesh/cells": )" + list + R"(, "/solver/iterations": )" + list + "}";
  check_problem(sweep, "/sweep", "more than 10000 combinations");  // 101² = 10201
}

TEST_CASE("override: an axis is replaced, although another axis sweeps the object around it") {
  const std::string sweep =
      R"("sweep": {"/mesh": [{"cells": 2}, {"generator": "disc"}], "/mesh/cells": [4, 8]})";
  CHECK(experiment(sweep).runs.size() == 4);
  const Experiment overridden = experiment(sweep, {"/mesh/cells=6"});
  REQUIRE(overridden.runs.size() == 2);
  for (const RunConfig& run : overridden.runs) CHECK(run.scene().mesh.cells == 6);
}

TEST_CASE("override: sets a value, creating objects on the way") {
  const auto run = [](const std::vector<std::string>& overrides,
                      const std::string& rest = R"("duration": 1)") {
    return experiment(rest, overrides).runs.at(0);
  };
  CHECK(run({"/duration=2"}).scene().duration == 2);
  CHECK(run({"/mesh/cells=8", "/mesh/cells=9"}).scene().mesh.cells == 9);
  CHECK(run({"/bending/adaptive/m_rounding=ceil"}).scene().bending.model.as<Adaptive>()->m_rounding ==
        Rounding::ceil);
  CHECK(run({R"(/bending/model="lod")"}).scene().bending.model.name() == "lod");
  CHECK(run({"/pins/vertices=[\"top\"]"}).scene().pins.vertices == std::vector{Place::top});
  CHECK(run({"/effects/0/acceleration=[0,0,-1]"}).scene().effects[0].as<Gravity>()->acceleration.z() == -1);
  CHECK(run({"/effects=[]"}).scene().effects.empty());
  CHECK(run({R"(/mesh={"generator": "disc"})"}, R"("mesh": {"cells": 4})").scene().mesh.cells == 32);
  CHECK(run({"/mesh/file=a=b.obj"}).scene().mesh.file == "a=b.obj");
  CHECK(run({"/mesh/file=12"}).scene().mesh.file == "12");
  CHECK_FALSE(run({"/mesh/file=null"}, R"("mesh": {"file": "a.obj"})").scene().mesh.file.has_value());
  CHECK(experiment(R"("duration": 1)", {"/name=2024"}).name == "2024");
}

TEST_CASE("override: a value at a swept pointer replaces the axis") {
  CHECK(values(experiment(two_axes, {"/mesh/cells=8"}), "/mesh/cells") == Texts{"8", "8"});
  CHECK(values(experiment(two_axes, {"/mesh/cells=[8, 9]", "/bending/model=none"}), "/mesh/cells") ==
        Texts{"8", "9"});
  const std::string lists = R"("sweep": {"/pins/vertices": [["top"], ["bottom"]]})";
  CHECK(values(experiment(lists, {R"(/pins/vertices=["left", "right"])"}), "/pins/vertices") ==
        Texts{R"(["left","right"])"});
  CHECK(values(experiment(lists, {R"(/pins/vertices=[["left"], ["right"]])"}), "/pins/vertices") ==
        Texts{R"(["left"])", R"(["right"])"});
  CHECK(experiment(R"("sweep": {"/effects": [[], [{"type": "gravity"}]]})", {"/effects=[]"}).runs.size() ==
        1);
}

TEST_CASE("override: a value inside a swept object changes every value of the axis") {
  const std::string swept = R"("sweep": {"/bending": [{"model": "lod"}, {"model": "none", "k": 1}]})";
  CHECK(values(experiment(swept, {"/bending/k=0.25"}), "/bending/k") == Texts{"0.25", "0.25"});
}

TEST_CASE("override: the sweep and the expectations can be replaced") {
  CHECK(values(experiment(R"("duration": 1)", {"/sweep/~1mesh~1cells=[4, 5]"}), "/mesh/cells") ==
        Texts{"4", "5"});
  CHECK(experiment(two_axes, {"/sweep={}"}).runs.size() == 1);
  CHECK(experiment(R"("expect": [{"metric": "drop", "max": 1, "why": "w"}])", {"/expect/0/max=2"})
            .expectations.at(0)
            .maximum == 2);
  CHECK(experiment(R"("expect": [{"metric": "drop", "max": 1, "why": "w"}])", {"/expect=[]"})
            .expectations.empty());
}

TEST_CASE("override: wrong overrides are refused") {
  const std::string rest = R"("duration": 1)";
  check_problem(rest, "/mesh/cels", "did you mean '/mesh/cells'?", {"/mesh/cels=8"});
  check_problem(rest, "", "not of the form /json/pointer=value", {"/mesh/cells"});
  check_problem(rest, "", "not of the form /json/pointer=value", {"mesh/cells=8"});
  check_problem(rest, "", "is no JSON pointer", {"/sweep/~2=8"});
  check_problem(rest, "/mesh/cells", "got the text \"[8,\"", {"/mesh/cells=[8,"});
  check_problem(rest, "/mesh/cells", "got a list", {"/mesh/cells=[8, 9]"});
  check_problem(R"("sweep": {"/effects": [[], [{"type": "gravity"}]]})", "/effects/0/acceleration",
                "not every swept value of", {"/effects/0/acceleration=[0,0,0]"});
}

}  // namespace bendlab::sweep_test
