// The program as users run it: exit codes, output to stdout and stderr, reuse of runs, interruption.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "experiments/cli/command.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::command_line_test {
namespace {

namespace fs = std::filesystem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;
using nlohmann::json;

using bendlab::test::Workplace;

/// A cloth of 16 × 16 cells and a cloth of 20 × 20 cells, for a tenth of a second.
constexpr const char* small = R"({"name": "small", "defaults": "paper",
          "duration": 0.1, "bending": {"model": "crossover"},
  "sweep": {"/mesh/cells": [16, 20]}})";

TEST_CASE("Usage errors exit with 2 and suggest what was meant", "[command line]") {
  Workplace here;
  CHECK(here.run("") == 2);
  CHECK(here.run("rnu small.json") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("did you mean 'run'?"));
  CHECK(here.run("run") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("CONFIG is required"));
  CHECK(here.run("run small.json --jobs 0") == 2);
  CHECK(here.run("list --no-such-option") == 2);
  CHECK(here.run("show 0123abcd") == 2);  // no such run
  CHECK(here.run("test") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("./bendlab test"));
  CHECK(here.out().empty());
}

TEST_CASE("The usage of an option says its name, its value and how often it is given", "[command line]") {
  using bendlab::Option;
  std::vector<std::string> values;
  const Option config("CONFIG", &values, "", {}), folder("[DIR]", &values, "", {}),
      format("--format! obj|ply", &values, "", {}), play("--play,-p RUN...", &values, "", {}),
      models("--models NAME,...", &values, "", {}), list("--list", &values, "", {});
  CHECK((config.name == "CONFIG" && config.required && config.type.empty()));
  CHECK((folder.name == "DIR" && !folder.required));
  CHECK((format.name == "--format" && format.required && format.type.empty()));
  CHECK(format.choices == std::vector<std::string>{"obj", "ply"});
  CHECK((play.name == "--play,-p" && play.type == "RUN" && play.separate && !play.by_commas));
  CHECK((models.type == "NAME" && models.by_commas && !models.separate));
  CHECK((list.name == "--list" && list.type.empty() && !list.required && !list.separate));
}

TEST_CASE("Help and version go to stdout", "[command line]") {
  Workplace here;
  REQUIRE(here.run("--help") == 0);
  for (const char* command : {"run", "plan", "validate", "list", "show", "stiffness", "mesh", "models",
                              "effects", "methods", "schema", "reproduce", "test"})
    CHECK_THAT(here.out(), ContainsSubstring("\n  " + std::string(command) + " "));
  CHECK(here.err().empty());
  REQUIRE(here.run("--version") == 0);
  CHECK(here.out().starts_with("bendlab 0."));
}

TEST_CASE("Config errors exit with 3 before anything is created", "[command line]") {
  Workplace here;
  here.write("good.json", small);
  here.write("broken.json", "{\"name\": ");
  here.write("unknown.json", R"({"name": "x", "defaults": "paper", "mesh": {"cels": 3}})");
  CHECK(here.run("run broken.json") == 3);
  CHECK(here.run("run missing.json") == 3);
  CHECK(here.run("run good.json broken.json unknown.json") == 3);
  CHECK_THAT(here.err(), ContainsSubstring("broken.json") && ContainsSubstring("/mesh/cels") &&
                             ContainsSubstring("did you mean 'cells'?"));
  CHECK(here.run("validate unknown.json") == 3);
  CHECK(here.run("run good.json --set /solver/dt=-1") == 3);
  CHECK_THAT(here.err(), ContainsSubstring("/solver/dt"));
  CHECK(here.out().empty());
  CHECK_FALSE(fs::exists(here.folder / "results"));
  CHECK(here.run("validate good.json") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("2 runs"));
}

TEST_CASE("Meshes that cannot be used exit with 4, files that cannot be read or written with 5",
          "[command line]") {
  Workplace here;
  here.write("small.json", small);
  here.write("hole.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  CHECK(here.run("mesh hole.obj") == 4);
  CHECK(here.run("mesh missing.obj") == 5);
  here.write("hole.json", R"({"name": "hole", "defaults": "paper",
          "duration": 0.1, "mesh": {"file": "hole.obj"}})");
  CHECK(here.run("run hole.json") == 4);
  here.write("file", "");
  CHECK(here.run("run small.json --out file/results") == 5);
  CHECK_THAT(here.err(), ContainsSubstring("--out"));
  CHECK(here.run("list nowhere") == 5);
  CHECK(here.run("list . >/dev/full") == 5);
  CHECK(here.run("run small.json --json >/dev/full") == 5);
}

TEST_CASE("A bad mesh is refused, or accepted by a policy that reports its changes", "[command line]") {
  Workplace here;
  // A cap on the boundary, a duplicate triangle, and a third triangle at the diagonal.
  here.write("bad.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\nf 2 5 3\nf 1 2 3\nf "
             "1 3 6\n");
  here.write("bad.json",
             R"({"name": "bad", "defaults": "paper",
          "duration": 0.2, "mesh": {"file": "bad.obj"}, "pins": {"ring": 0}})");
  CHECK(here.run("run bad.json") == 4);
  CHECK_THAT(here.err(), ContainsSubstring("1 triangle with zero area: triangle 2 (1, 4, 2)") &&
                             ContainsSubstring("bad_triangles"));
  CHECK(here.run("mesh bad.obj") == 4);
  CHECK_THAT(here.err(), ContainsSubstring("regularise: take it with 6 vertices and 4 triangles") &&
                             ContainsSubstring("repair: take it with"));
  for (const char* policy : {"regularise", "membrane_off", "repair"})
    for (const char* precision : {"single", "double"}) {
      INFO(policy << ", " << precision);
      REQUIRE(here.run(std::string("run bad.json --json --set /mesh/bad_triangles=") + policy +
                       " --set /solver/precision=" + precision) == 0);
      const json run = here.out_lines().at(0);
      CHECK(run.at("status") == "complete");
      CHECK_THAT(run.at("message").get<std::string>(), ContainsSubstring("1 triangle with zero area"));
      CHECK(run.at("summary").at("mean_strain") < 0.2);
      CHECK(here.run(std::string("mesh bad.obj --json --bad-triangles ") + policy) == 0);
      CHECK(here.out_lines().at(0).at("notes").size() == (policy[0] == 'r' && policy[2] == 'p' ? 4 : 3));
    }
}

TEST_CASE("The refusal of an obstacle names a remedy that works", "[command line]") {
  Workplace here;
  here.write("bad.obj", "v 0 0 -1\nv 1 0 -1\nv 1 1 -1\nf 1 2 3\nf 2 3 1\n");  // a duplicate triangle
  const auto config = [](const std::string& file) {
    return R"({"name": "o", "defaults": "paper", "duration": 0.05, "mesh": {"cells": 4},
               "effects": [{"type": "mesh_obstacle", "file": ")" +
           file + "\"}]}";
  };
  here.write("bad.json", config("bad.obj"));
  here.write("new.json", config("new.obj"));
  CHECK(here.run("run bad.json") == 4);
  CHECK_THAT(here.err(), ContainsSubstring("--bad-triangles repair --write NEW.obj"));
  CHECK_THAT(here.err(), !ContainsSubstring("/mesh/bad_triangles"));
  REQUIRE(here.run("mesh bad.obj --bad-triangles repair --write new.obj") == 0);
  CHECK(here.run("mesh new.obj") == 0);
  CHECK(here.run("run new.json") == 0);
  CHECK(here.run("mesh new.obj --write new.stl") == 4);
}

TEST_CASE("If only a part of the faces has texture coordinates, the faces without are counted",
          "[command line]") {
  Workplace here;
  here.write("half.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1 3 4\n");
  here.write("half.json",
             R"({"name": "h", "defaults": "paper", "duration": 0.05, "mesh": {"file": "half.obj"},
                              "material": {"coordinates": "texture"}})");
  CHECK(here.run("run half.json") == 4);
  CHECK_THAT(here.err(), ContainsSubstring("1 of 2 triangles"));
}

TEST_CASE("A sweep prints a row per run, and in a pipe nothing on stderr", "[command line]") {
  Workplace here;
  here.write("small.json", small);
  REQUIRE(here.run("run small.json") == 0);
  CHECK(here.err().empty());
  CHECK_THAT(here.out(),
             ContainsSubstring("cells  vertices  triangles  springs") && ContainsSubstring("complete"));
  CHECK_THAT(here.out(), !ContainsSubstring("\x1b"));  // no colours in a pipe
}

TEST_CASE("The option --json prints an object per run with its settings and results", "[command line]") {
  Workplace here;
  here.write("small.json", small);
  REQUIRE(here.run("run small.json --json --jobs 2") == 0);
  const std::vector<json> runs = here.out_lines();
  REQUIRE(runs.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const int cells = i == 0 ? 16 : 20;
    CHECK(runs[i].at("status") == "complete");
    CHECK(runs[i].at("id").get<std::string>().size() == 16);
    CHECK(fs::exists(here.folder / runs[i].at("file").get<std::string>()));
    CHECK(runs[i].at("config").at("mesh").at("cells") == cells);  // in the order of the sweep
    CHECK(runs[i].at("wall_s").get<double>() > 0);
    CHECK(runs[i].at("cpu_s").get<double>() > 0);
    const json& summary = runs[i].at("summary");
    CHECK(summary.at("vertices") == (cells + 1) * (cells + 1));
    CHECK(summary.at("triangles") == 2 * cells * cells);
    for (const char* name :
         {"springs", "projections", "mean_strain", "max_stretch", "pin_max_stretch", "pin_region_stretch",
          "worst_stretch", "degenerate_triangles", "drop", "kinetic_energy"}) {
      INFO(name);
      CHECK(summary.contains(name));
    }
  }

  SECTION("a complete run is not repeated, unless forced") {
    REQUIRE(here.run("run small.json --json") == 0);
    for (const json& run : here.out_lines()) CHECK(run.at("reused") == true);
    REQUIRE(here.run("plan small.json --json") == 0);
    for (const json& run : here.out_lines()) CHECK(run.at("state") == "complete");
    REQUIRE(here.run("run small.json --json --force") == 0);
    for (const json& run : here.out_lines()) CHECK(run.at("reused") == false);
  }
  SECTION("list and show find the runs") {
    REQUIRE(here.run("list --json") == 0);
    CHECK(here.out_lines().size() == 2);
    REQUIRE(here.run("list") == 0);
    CHECK_THAT(here.out(), ContainsSubstring(runs[0].at("id").get<std::string>()));
    const std::string id = runs[1].at("id"), file = runs[1].at("file");
    for (const std::string& name : {id, file, fs::path(file).parent_path().string()}) {
      REQUIRE(here.run("show --json '" + name + "'") == 0);
      const json record = here.out_lines().at(0);
      CHECK(record.at("id") == id);
      CHECK(record.at("config") == runs[1].at("config"));
      CHECK(record.at("provenance").contains("git_commit"));
    }
    REQUIRE(here.run("show " + id) == 0);
    CHECK_THAT(here.out(), ContainsSubstring("summary") && ContainsSubstring("provenance"));
    CHECK(here.run("show results") == 2);  // ambiguous: there are two runs
  }
}

TEST_CASE("The command energy states the energy of a pose, and divides it only by a rigidity that acts",
          "[command line]") {
  Workplace here;
  // Half a cylinder of the radius 0.1 m and the length 0.1 m: ½ B π r h / r². At each end, half a cell of 32
  // may be straight, which is 3 % of the sheet. Without B the ratio would be off by a factor of 10⁵.
  const double per_rigidity = 0.5 * std::numbers::pi * 0.1 / 0.1;
  const std::string pose = R"({"name": "pose", "mesh": {"width": 0.314159265, "height": 0.1, "cells": 32},
      "pins": {"vertices": []}, "effects": [], "solver": {"method": "quasi_newton"},
      "initial": {"surface": {"shape": "cylinder", "radius": 0.1}}, "bending": )";
  here.write("stated.json", pose + R"({"model": "dkt", "flexural_rigidity": 2e-5}})");
  here.write("compliance.json", pose + R"({"model": "dkt", "stiffness": "compliance", "compliance": 4e4}})");
  for (const auto& [file, rigidity] :
       {std::pair{"stated.json", 2e-5}, std::pair{"compliance.json", 2.5e-5}}) {
    REQUIRE(here.run(std::string("energy --json ") + file) == 0);
    const json run = json::parse(here.out());
    CHECK_THAT(run.at("parts").at("dkt").at("energy").get<double>() / rigidity,
               WithinRel(per_rigidity, 1. / 32));
    CHECK(run.contains("flexural_rigidity") == (rigidity == 2e-5));
  }
}

TEST_CASE("Overhangs of ASTM D1388 become the rigidities of a config", "[command line]") {
  Workplace here;
  here.write("lengths.txt", "direction overhang\nwarp 50\nwarp 52\nweft 40\n");
  REQUIRE(here.run("fabrics --astm lengths.txt --mass 200") == 0);
  CHECK_THAT(here.err(), ContainsSubstring("from 2 specimens"));
  const json settings = json::parse(here.out());
  CHECK_THAT(settings["material"]["density"].get<double>(), WithinRel(0.2, 1e-12));
  // B = W c³ g, and the bending length c is half of the overhang.
  for (const auto& [direction, length] : {std::pair{"warp", 0.0255}, {"weft", 0.020}})
    CHECK_THAT(settings["bending"]["rigidity"][direction].get<double>(),
               WithinRel(0.2 * 9.80665 * length * length * length, 1e-9));
  CHECK(here.run("fabrics --astm lengths.txt") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("--mass in g/m²"));
}

TEST_CASE("The option --set overrides a value and replaces an axis, and --out names the folder",
          "[command line]") {
  Workplace here;
  here.write("small.json", small);
  REQUIRE(here.run("run small.json --json --set /mesh/cells=4 --set /bending/model=none --out elsewhere") ==
          0);
  const std::vector<json> runs = here.out_lines();
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].at("summary").at("vertices") == 25);
  CHECK(runs[0].at("summary").at("springs") == 0);
  CHECK(fs::exists(here.folder / "elsewhere" / "small"));
  CHECK_FALSE(fs::exists(here.folder / "results"));
}

TEST_CASE("A run that diverges meets no expectation", "[command line]") {
  Workplace here;
  here.write("wild.json", R"({"name": "wild", "defaults": "paper",
          "duration": 0.5, "mesh": {"cells": 4}, "pins": {"vertices": []},
      "effects": [{"type": "gravity", "acceleration": [0, 0, -1e9]}],
      "expect": [{"metric": "vertices", "min": 25, "why": "five rows of five"}]})");
  CHECK(here.run("run wild.json") == 6);
  CHECK_THAT(here.out(),
             ContainsSubstring("FAIL") && ContainsSubstring("diverged; in the frames before, vertices = 25"));
}

TEST_CASE("An expectation that does not hold exits with 1, and its reason is printed", "[command line]") {
  Workplace here;
  here.write("expect.json", R"({"name": "expect", "defaults": "paper",
          "duration": 0.1, "mesh": {"cells": 2}, "expect": [
    {"metric": "vertices", "min": 9, "max": 9, "why": "three rows of three"},
    {"metric": "triangles", "max": 7, "why": "one too few, on purpose"}]})");
  CHECK(here.run("run expect.json") == 1);
  CHECK_THAT(here.out(), ContainsSubstring("ok   ") && ContainsSubstring("three rows of three"));
  CHECK_THAT(here.out(), ContainsSubstring("FAIL") && ContainsSubstring("one too few, on purpose"));
}

TEST_CASE("If a run of a sweep fails, the other runs continue", "[command line]") {
  Workplace here;
  here.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  here.write("mixed.json",
             R"({"name": "mixed", "defaults": "paper",
          "duration": 0.1, "pins": {"vertices": ["upper_left"], "ring": 0},
    "sweep": {"/mesh": [{"file": "flat.obj"}, {"cells": 2}]}})");
  CHECK(here.run("run mixed.json --json") == 4);
  const std::vector<json> runs = here.out_lines();
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].at("status") == "failed");
  CHECK_FALSE(runs[0].at("message").get<std::string>().empty());
  CHECK(runs[1].at("status") == "complete");
}

TEST_CASE("A run that diverges exits with 6, keeps its frames and does not stop other runs",
          "[command line]") {
  // Gravity of 10⁹ m/s² throws a sheet past the bound of a million sizes within half a second.
  Workplace here;
  here.write("wild.json", R"({"name": "wild", "defaults": "paper",
          "duration": 0.5, "mesh": {"cells": 4}, "pins": {"vertices": []},
      "sweep": {"/effects/0/acceleration": [[0, 0, -1e9], [0, 0, -9.81]]},
      "effects": [{"type": "gravity"}]})");
  CHECK(here.run("run wild.json --json") == 6);
  const std::vector<json> runs = here.out_lines();
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].at("status") == "diverged");
  CHECK_THAT(runs[0].at("message").get<std::string>(), ContainsSubstring("diverged at t = ") &&
                                                           ContainsSubstring("vertex") &&
                                                           ContainsSubstring("the most stretched"));
  CHECK(runs[0].at("summary").contains("mean_strain"));  // from the frames before
  CHECK(runs[1].at("status") == "complete");
  CHECK(here.run("run wild.json --json") == 6);  // reused, not computed again
  CHECK(here.out_lines().at(0).at("reused") == true);
}

TEST_CASE("After a signal the frames are kept, and the same command completes the run", "[command line]") {
  const auto [signal, code] = GENERATE(std::pair(SIGINT, 130), std::pair(SIGTERM, 143));
  Workplace here;
  // The run is so long that the signal, sent within milliseconds after the first frame, comes in time.
  here.write("long.json",
             R"({"name": "long", "defaults": "paper",
          "duration": 60, "mesh": {"cells": 8}, "output": {"frames_per_second": 5}})");
  REQUIRE(here.run_and_signal("long.json", signal) == code);
  CHECK_THAT(here.err(), ContainsSubstring("again"));
  REQUIRE(here.run("list --json") == 0);
  REQUIRE(here.out_lines().size() == 1);
  const json stopped = here.out_lines()[0];
  CHECK(stopped.at("status") == "interrupted");
  const int kept = stopped.at("frames");
  CHECK(kept >= 1);
  CHECK(kept < 301);

  REQUIRE(here.run("run long.json --json") == 0);
  CHECK(here.out_lines().at(0).at("status") == "complete");
  REQUIRE(here.run("list --json") == 0);
  REQUIRE(here.out_lines().size() == 1);
  CHECK(here.out_lines()[0].at("frames") == 301);  // 5 per second for 60 s, and the first
}

TEST_CASE("Commands that describe settings print text and JSON", "[command line]") {
  Workplace here;
  for (const char* command : {"models", "effects", "methods", "schema"}) {
    INFO(command);
    REQUIRE(here.run(command) == 0);
    CHECK_FALSE(here.out().empty());
    REQUIRE(here.run(std::string(command) + " --json") == 0);
    CHECK(json::accept(here.out()));
  }
}

}  // namespace

}  // namespace bendlab::command_line_test
