// Sheets far from the origin of their coordinates, like in surveys (UTM: millions of metres). Readers of
// frames get edges of the right length.
#include <filesystem>
#include <string>

#include "bendlab/io/run_file.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"

namespace bendlab::far_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using test::Workplace;

std::string config(const std::string& mesh, const std::string& more = "") {
  return R"({"name": "far", "duration": 0.1, "mesh": {"width": 1, "height": 1, )" + mesh +
         R"(}, "pins": {"vertices": ["upper_left", "upper_right"]}, "output": {"frames_per_second": 20})" +
         more + "}";
}

// A round number of metres, and numbers with the digits of a survey.
constexpr const char* places[] = {R"("offset": [1e6, 0, 0])", R"("offset": [450123.75, 5412345.5, 318.25])",
                                  R"("offset": [-1e7, 1e7, 1e7])"};

/// The output of tests/export/edges.py for the run and its exports; empty if all edges are right.
std::string wrong_edges(const Workplace& here, const std::string& run, const std::string& tolerance,
                        const std::string& files) {
  const std::string command = "cd '" + here.folder.string() + "' && " + places::python + " " +
                              places::source + "/tests/export/edges.py '" + run + "' " + tolerance + " " +
                              files + " >wrong 2>&1 || echo failed >>wrong";
  return std::system(command.c_str()) == 0 ? test::read(here.folder / "wrong") : "no shell";
}

TEST_CASE("Far from the origin a run file and its exports have the edges of the mesh", "[far]") {
  for (const char* place : places) {
    INFO(place);
    Workplace here;
    here.write("far.json", config(std::string(R"("cells": 64, )") + place));
    REQUIRE(here.run("run far.json") == 0);
    const std::filesystem::path run = here.run_files(".vtkhdf").at(0);
    CHECK(read_rest(run).double_positions);
    for (const char* to : {"obj --to b.obj --frames 0", "ply --to a.ply --frames 0", "pc2 --to a.pc2",
                           "usda --to a.usda", "xdmf --to a.xdmf"})
      REQUIRE(here.run("export '" + run.string() + "' --format " + to) == 0);
    // The solver is in single precision, relative to the middle. Half of its last digit at half a metre is
    // 3e-8 m, and edges are 1/64 m long.
    CHECK(wrong_edges(here, run.string(), "1e-5", "a.ply b.obj a.pc2 a.obj a.usda") == "");
    CHECK_THAT(test::read(here.folder / "a.obj"), ContainsSubstring("# origin "));  // beside the cache
    CHECK_THAT(test::read(here.folder / "a.xdmf"), ContainsSubstring("Precision=\"8\""));
  }
}

TEST_CASE("Near the origin files keep single precision", "[far]") {
  Workplace here;
  here.write("near.json", config(R"("cells": 16, "offset": [3, -2, 1])"));
  REQUIRE(here.run("run near.json") == 0);
  const std::filesystem::path run = here.run_files(".vtkhdf").at(0);
  CHECK_FALSE(read_rest(run).double_positions);
  REQUIRE(here.run("export '" + run.string() + "' --format ply --to a.ply --frames 0") == 0);
  CHECK_THAT(test::read(here.folder / "a.ply"), ContainsSubstring("property float x"));
  REQUIRE(here.run("export '" + run.string() + "' --format usda --to a.usda") == 0);
  CHECK_THAT(test::read(here.folder / "a.usda"), !ContainsSubstring("xformOp"));
}

TEST_CASE("Far from the origin runs can be repeated, compared, and used as a start", "[far]") {
  Workplace here;
  const std::string mesh = std::string(R"("cells": 8, )") + places[1];
  here.write("far.json", config(mesh, R"(, "sweep": {"/material/density": [0.2]})"));
  REQUIRE(here.run("run far.json") == 0);
  const std::string run = here.run_files(".vtkhdf").at(0).string();
  CHECK(here.run("rerun '" + run + "'") == 0);
  // A reference that records more data has the same bits. A start after a run begins at its last pose.
  here.write("error.json", config(mesh, R"(, "accuracy": {"solver": ["/output/constraints=true"]})"));
  REQUIRE(here.run("run error.json --json") == 0);
  // 10⁻¹⁶ of a coordinate of 5·10⁶ m is 10⁻⁹ m.
  CHECK(here.out_lines().at(0).at("summary").at("error_solver_rms").get<double>() < 1e-8);
  here.write("after.json",
             config(mesh, R"(, "initial": {"after": ["/duration=0.1"]}, "material": {"density": 0.2})"));
  REQUIRE(here.run("run after.json --json --out after") == 0);
  const std::string after = (here.folder / here.out_lines().at(0).at("file").get<std::string>()).string();
  const std::vector<double> end = read_positions(run, -1), start = read_positions(after, 0);
  REQUIRE(end.size() == start.size());
  // Both files have double precision. The solver rounds positions relative to the middle.
  double largest = 0;
  for (std::size_t i = 0; i < end.size(); ++i) largest = std::max(largest, std::abs(end[i] - start[i]));
  CHECK(largest < 2e-7);
}

TEST_CASE("The upper corner of a standing sheet is its highest corner", "[far]") {
  // The sheet stands in the plane y = 0. Its rows are numbered from below, and then from above.
  const auto sheet = [](bool from_above) {
    std::string text;
    for (int row = 0; row <= 4; ++row)
      for (int column = 0; column <= 4; ++column)
        text += "v " + std::to_string(0.25 * column) + " 0 " +
                std::to_string(0.25 * (from_above ? 4 - row : row)) + "\n";
    for (int row = 0; row < 4; ++row)
      for (int column = 1; column <= 4; ++column) {
        const int a = 5 * row + column;
        text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 6) + " " +
                std::to_string(a + 5) + "\n";
      }
    return text;
  };
  for (const bool from_above : {false, true}) {
    Workplace here;
    here.write("sheet.obj", sheet(from_above));
    here.write("stands.json", R"({"name": "stands", "duration": 0.1, "mesh": {"file": "sheet.obj"},
                                  "pins": {"vertices": ["upper_left"]}})");
    REQUIRE(here.run("run stands.json") == 0);
    const RestRecord rest = read_rest(here.run_files(".vtkhdf").at(0));
    REQUIRE(rest.pin_seeds.size() == 1);
    const auto corner = static_cast<std::size_t>(rest.pin_seeds[0]);
    CHECK(rest.positions[3 * corner] == 0);
    CHECK(rest.positions[3 * corner + 2] == 1);
  }
}

TEST_CASE("Names of places are refused if the up direction is ambiguous", "[far]") {
  Workplace here;
  here.write("sheet.obj", "v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nf 1 2 3 4\n");
  here.write("side.json", R"({"name": "side", "duration": 0.1, "mesh": {"file": "sheet.obj"},
      "pins": {"vertices": ["upper_left"]},
      "effects": [{"type": "gravity", "acceleration": [0, -9.81, 0]}]})");
  CHECK(here.run("run side.json") == 3);
  CHECK_THAT(here.err(), ContainsSubstring("/pins/vertices") && ContainsSubstring("/pins/indices"));
  CHECK(here.run("run side.json --set '/effects/0/acceleration=[0,0,-9.81]'") == 0);
  CHECK(here.run("run side.json --set '/pins={\"vertices\":[],\"indices\":[3]}'") == 0);
}

}  // namespace
}  // namespace bendlab::far_test
