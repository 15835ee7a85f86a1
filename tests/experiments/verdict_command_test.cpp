// Implausible runs and warnings in the output of the program: table, JSON, exit codes, `allow` and
// `--strict`.
#include <filesystem>
#include <string>

#include "bendlab/io/run_file.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"

namespace bendlab::verdict_command_test {
namespace {

namespace fs = std::filesystem;
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using nlohmann::json;

// The paper's sheet, pinned at one vertex and without bending springs. The paper's figure 1 calls this pin
// wrong. A triangle then becomes a thousand times as long as at rest.
const std::string torn_scene = R"("duration": 1, "mesh": {"cells": 32}, "bending": {"model": "none"},
  "pins": {"vertices": ["upper_right"], "ring": 0}, "solver": {"iterations": 10, "substeps": 1},
  "material": {"strain": {"form": "normalised"}}, "initial": {"perturbation": 1e-6}})";
const std::string torn = R"({"name": "torn", "defaults": "paper", )" + torn_scene,
                  torn_and_allowed = R"({"name": "torn", "defaults": "paper",
          "allow": ["implausible"], )" +
                                     torn_scene;

// No force acts on this sheet, so it does not move.
const std::string calm = R"({"name": "calm", "defaults": "paper",
          "duration": 0.1, "mesh": {"cells": 4}, "pins": {"vertices": []},
  "effects": [])";

}  // namespace

TEST_CASE("A run is also checked between its frames", "[command line][plausibility]") {
  Workplace here;
  here.write("rare.json", R"({"name": "rare", "defaults": "paper",
          "output": {"frames_per_second": 0.5}, )" +
                              torn_scene);
  REQUIRE(here.run("run rare.json --json") == 1);  // frames at the start and at the end, after 1 s
  const json broken = here.out_lines().at(0).at("implausible");
  CHECK(broken.at("bound") == "reach");  // stretch is checked only in frames
  CHECK(broken.at("time").get<double>() < 0.95);
}

TEST_CASE("An implausible run is reported, and the command fails", "[command line][plausibility]") {
  Workplace here;
  here.write("torn.json", torn);
  REQUIRE(here.run("run torn.json --json") == 1);
  const json run = here.out_lines().at(0);
  CHECK(run.at("status") == "implausible");
  const json& broken = run.at("implausible");
  CHECK((broken.at("bound") == "stretch" || broken.at("bound") == "reach"));
  CHECK(broken.at("measured").get<double>() > broken.at("limit").get<double>());
  CHECK(broken.at("time").get<double>() > 0);
  CHECK(broken.at("vertex").get<int>() >= 0);
  CHECK(broken.at("constraint").at("kind") == "strain");  // the only kind in this scene
  CHECK(broken.at("constraint").at("correction").get<double>() > 0);
  CHECK_THAT(broken.at("advice").get<std::string>(), ContainsSubstring("tethers"));
  CHECK_THAT(here.err(), ContainsSubstring("implausible: at t = "));

  // The run is finished, so it is not computed again. It is reported again, but only below the table.
  REQUIRE(here.run("run torn.json") == 1);
  CHECK_THAT(here.err(), !ContainsSubstring("implausible"));
  CHECK_THAT(here.out(),
             ContainsSubstring("implausible, reused") && ContainsSubstring("\nimplausible torn: at t = "));
  REQUIRE(here.run("run torn.json --json") == 1);
  CHECK(here.out_lines().at(0).at("implausible") == broken);
  REQUIRE(here.run("plan torn.json") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("implausible"));
  REQUIRE(here.run("list") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("implausible"));
  const auto files = here.run_files(".vtkhdf");
  REQUIRE(files.size() == 1);
  REQUIRE(here.run("show '" + files[0].string() + "' --json") == 0);
  CHECK(json::parse(here.out()).at("status") == "implausible");
  CHECK(json::parse(here.out()).at("implausible") == broken);
  // The file is complete: it has every frame and the summary.
  const bendlab::RunRecord record = bendlab::read_run(files[0]);
  CHECK(record.frames == 31);
  CHECK(record.summary.at("worst_stretch") > 3);
  CHECK(bendlab::read_positions(files[0], -1).size() == 3 * 33 * 33);
}

TEST_CASE("A sweep that studies failure states this with `allow`, and its runs are the same",
          "[command line][plausibility]") {
  Workplace here;
  here.write("torn.json", torn);
  here.write("allowed.json", torn_and_allowed);
  here.write("wrong.json", R"({"name": "torn", "defaults": "paper", "allow": ["diverged"], )" + torn_scene);
  CHECK(here.run("validate wrong.json") == 3);
  CHECK_THAT(here.err(), ContainsSubstring("/allow/0"));
  REQUIRE(here.run("run allowed.json --json") == 0);
  CHECK(here.out_lines().at(0).at("status") == "implausible");  // still reported
  REQUIRE(here.run("run torn.json --json") == 1);
  CHECK(here.out_lines().at(0).at("reused") == true);
  REQUIRE(here.run("schema") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("allow: default []"));
}

TEST_CASE("Warnings are printed once, and --strict makes them errors", "[command line][warnings]") {
  Workplace here;
  here.write("seeds.json", calm + R"(, "sweep": {"/initial/seed": [1, 2, 3]}})");
  REQUIRE(here.run("run seeds.json") == 0);
  CHECK_THAT(here.out(),
             ContainsSubstring("\nwarning inert_seed: ") && ContainsSubstring("(and 2 more runs)"));
  CHECK(here.err().empty());                        // warnings are printed only once
  REQUIRE(here.run("run seeds.json --json") == 0);  // read from the files
  CHECK_THAT(here.err(), ContainsSubstring("bendlab: warning: calm: inert_seed: "));
  for (const json& run : here.out_lines()) {
    REQUIRE(run.at("warnings").size() == 1);
    CHECK(run.at("warnings")[0].at("code") == "inert_seed");
  }
  fs::remove_all(here.folder / "results");
  CHECK(here.run("validate seeds.json") == 0);
  CHECK(here.run("validate --strict seeds.json") == 1);
  CHECK_THAT(here.err(), ContainsSubstring("inert_seed"));
  CHECK(here.run("run --strict seeds.json") == 1);
  CHECK_THAT(here.err(), ContainsSubstring("nothing was computed"));
  CHECK_FALSE(fs::exists(here.folder / "results"));
}

TEST_CASE("A warning that only the finished run can give fails a strict command after the run",
          "[command line][warnings]") {
  Workplace here;
  // One iteration per step leaves a sheet on two corners stretched.
  here.write("loose.json",
             R"({"name": "loose", "defaults": "paper",
          "allow": ["implausible"], "duration": 1, "mesh": {"cells": 24},
    "pins": {"vertices": ["upper_left", "upper_right"]}, "solver": {"iterations": 2, "substeps": 1}})");
  REQUIRE(here.run("validate --strict loose.json") == 0);
  REQUIRE(here.run("run loose.json") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("warning unconverged: "));
  CHECK(here.run("run --strict loose.json") == 1);
  here.write("calm.json", calm + "}");
  CHECK(here.run("run --strict calm.json") == 0);
}

TEST_CASE("Good scenes get no warning and are plausible", "[command line][plausibility][warnings]") {
  Workplace here;
  const std::string configs = std::string(bendlab::places::source) + "/configs/";
  const std::string coarse = " --set /mesh/cells=12 --set /duration=0.5 --json";
  for (const char* scene : {"flag", "skirt", "tablecloth", "sphere_drape"}) {
    INFO(scene);
    REQUIRE(here.run("run '" + configs + "scenes/" + scene + ".json' --strict" + coarse) == 0);
    for (const json& run : here.out_lines()) CHECK(run.at("status") == "complete");
  }
  REQUIRE(here.run("run '" + configs +
                   "paper/fig5.json' --set /mesh/cells=16 --set /initial/seed=1 --json") == 0);
  for (const json& run : here.out_lines()) CHECK(run.at("status") == "complete");
}

}  // namespace bendlab::verdict_command_test
