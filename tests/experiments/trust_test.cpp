// A person, a disk or another program may damage configs, meshes and results. No wrong result may go
// unnoticed.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/without_traps.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/mesh_surface.hpp"
#include "experiments/terminal/printable.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"

namespace bendlab::trust_test {
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* tiny = R"({"name": "tiny", "mesh": {"cells": 3}, "duration": 0.1})";

// The file of the only run.
fs::path only_run(const Workplace& place) {
  const auto files = place.run_files(".vtkhdf");
  REQUIRE(files.size() == 1);
  return files.front();
}

bool reused(Workplace& place) {
  REQUIRE(place.run("run tiny.json --json") == 0);
  return place.out_lines().at(0).at("reused");
}

}  // namespace

TEST_CASE("trust: a changed run file is set aside, and the run is computed again", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  CHECK_FALSE(reused(place));
  CHECK(reused(place));
  const fs::path file = only_run(place);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(3000);
  const auto byte = static_cast<char>(stream.get() ^ 4);
  stream.seekp(3000), stream.put(byte), stream.close();
  CHECK(place.run("list") == 0);
  CHECK_THAT(place.err(), ContainsSubstring("changed"));
  CHECK_FALSE(reused(place));
  CHECK_THAT(place.err(), ContainsSubstring("run.vtkhdf."));
  CHECK(place.run_files(".bad").size() == 1);
  CHECK(seal_of(only_run(place)) == Seal::whole);
  CHECK(reused(place));
}

TEST_CASE("trust: a run file copied from another run is not accepted as a result", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  CHECK_FALSE(reused(place));
  const fs::path mine = only_run(place);
  REQUIRE(place.run("run tiny.json --set /mesh/cells=4 --out other --json") == 0);
  const fs::path other = place.folder / "other" / "tiny" / place.out_lines().at(0).at("id") / "run.vtkhdf";
  fs::copy(other, mine, fs::copy_options::overwrite_existing);
  CHECK_FALSE(reused(place));
  CHECK_THAT(place.err(), ContainsSubstring("is the file of another run"));
}

TEST_CASE("trust: files that are no runs do not prevent the listing of runs", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  CHECK_FALSE(reused(place));
  const fs::path mine = only_run(place), beside = place.folder / "results" / "tiny";
  for (const char* name : {"a", "b", "c", "d"}) fs::create_directories(beside / name);
  std::ofstream(beside / "a" / "run.vtkhdf") << "no HDF5";
  std::ofstream(beside / "b" / "run.vtkhdf");
  fs::copy(mine, beside / "c" / "run.vtkhdf.x.part");
  fs::resize_file(beside / "c" / "run.vtkhdf.x.part", 9000);
  REQUIRE(mkfifo((beside / "d" / "run.vtkhdf").c_str(), 0600) == 0);
  CHECK(place.run("list") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("complete"));
  CHECK(place.run("plan tiny.json") == 0);
}

TEST_CASE("trust: --force keeps the old file until the new one replaces it", "[trust]") {
  Workplace place;
  place.write("tiny.json", R"({"name": "tiny", "mesh": {"cells": 40}, "duration": 30})");
  CHECK(place.run("run tiny.json --set /duration=0.1") == 0);
  const fs::path file = only_run(place);
  const auto before = fs::last_write_time(file);
  // The disk has room for only a few frames.
  CHECK(place.run("run tiny.json --set /duration=0.1 --force",
                  "sh' -c 'ulimit -f 40; trap \"\" XFSZ; exec \"$0\" \"$@\"' '" +
                      std::string(places::program)) == 5);
  CHECK(seal_of(file) == Seal::whole);
  CHECK(fs::last_write_time(file) == before);
  CHECK(place.run("run tiny.json --set /duration=0.1 --force") == 0);
  CHECK(fs::last_write_time(file) > before);
}

TEST_CASE("trust: if --force is stopped, the old file stays", "[trust]") {
  Workplace place;
  place.write("tiny.json", R"({"name": "tiny", "mesh": {"cells": 20}, "duration": 4})");
  CHECK(place.run("run tiny.json") == 0);
  const fs::path file = only_run(place);
  const std::string bytes = test::read(file);
  CHECK(place.run_and_signal("tiny.json", SIGINT, "--force") == 130);
  CHECK(test::read(file) == bytes);
  CHECK(place.run_files(".part").empty());
  CHECK(reused(place));
}

TEST_CASE("trust: no command uses a finished file without checksum", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  CHECK_FALSE(reused(place));
  const fs::path file = only_run(place);
  fs::resize_file(file, fs::file_size(file) - 1);
  CHECK(place.run("list") == 0);
  CHECK_THAT(place.err(), ContainsSubstring("checksum"));
  CHECK(place.run("plan tiny.json --json") == 0);
  CHECK(place.out_lines().at(0).at("state") == "unreadable");
  CHECK(place.run("show '" + file.string() + "'") == 5);
  CHECK_FALSE(reused(place));
}

TEST_CASE("trust: with closed standard streams, no output goes into the run file", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  CHECK(place.run("validate tiny.json 2>&-") == 0);
  CHECK(place.run("run tiny.json 2>&- <&-") == 0);
  CHECK(seal_of(only_run(place)) == Seal::whole);
  CHECK(place.run("run tiny.json --force >&-") == 5);
  CHECK(seal_of(only_run(place)) == Seal::whole);
}

TEST_CASE("trust: times that cannot be simulated are errors", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  const auto refused = [&](const std::string& change, const std::string& text) {
    CAPTURE(change);
    CHECK(place.run("validate tiny.json --set " + change) == 3);
    CHECK_THAT(place.err(), ContainsSubstring(text));
  };
  refused("/duration=1e18", "steps of /solver/dt");
  refused("/solver/dt=1e-300", "/solver/dt");
  refused("/solver/dt=1e308", "/solver/dt");
  refused("/solver/dt=1", "is shorter than a step");
  refused("/output/frames_per_second=1e12", "/output/frames_per_second");
  CHECK(place.run("validate tiny.json --set /solver/dt=0.1") == 0);
}

TEST_CASE("trust: pipes, devices and folders are refused as configs and meshes", "[trust]") {
  Workplace place;
  place.write("tiny.json", R"({"name": "tiny", "duration": 0.1})");
  REQUIRE(mkfifo((place.folder / "pipe.obj").c_str(), 0600) == 0);
  fs::create_directory(place.folder / "folder.obj");
  for (const char* config : {"pipe.obj", "/dev/zero", "folder.obj"}) {
    CHECK(place.run(std::string("validate ") + config) == 3);
    CHECK_THAT(place.err(), ContainsSubstring("the file cannot be read: it is a"));
  }
  for (const char* mesh : {"pipe.obj", "/dev/zero", "folder.obj"}) {
    CHECK(place.run(std::string("run tiny.json --set /mesh/file=") + mesh) == 5);
    CHECK_THAT(place.err(), ContainsSubstring("the mesh file is a"));
    CHECK(place.run(std::string("mesh ") + mesh) == 5);
  }
}

TEST_CASE("trust: validate checks meshes, pins and warnings", "[trust]") {
  Workplace place;
  place.write("sheet.json", R"({"name": "sheet", "mesh": {"cells": 4}, "duration": 0.1})");
  CHECK(place.run("validate sheet.json") == 0);
  CHECK(place.err().empty());
  place.write("file.json", R"({"name": "file", "duration": 0.1})");
  CHECK(place.run("validate file.json --set /mesh/file=nothing.obj") == 5);
  CHECK_THAT(place.err(), ContainsSubstring("nothing.obj"));
  CHECK(place.run("validate sheet.json --set '/pins/indices=[25]'") == 3);
  CHECK_THAT(place.err(), ContainsSubstring("vertex 25"));
  CHECK(place.run("validate sheet.json --set /pins/vertices='[\"top_rim\"]'") == 3);
  CHECK_THAT(place.err(), ContainsSubstring("/pins/vertices"));
  place.write("empty.obj", "# nothing\n");
  CHECK(place.run("validate file.json --set /mesh/file=empty.obj") == 4);
  CHECK_THAT(place.err(),
             ContainsSubstring("has no triangles") && ContainsSubstring("export the whole mesh"));
  // A warning is printed, and with --strict it is an error.
  CHECK(place.run("validate sheet.json --set /mesh/width=100 --set /mesh/height=100") == 0);
  CHECK_THAT(place.err(), ContainsSubstring("warning") && ContainsSubstring("units"));
  CHECK(place.run("validate sheet.json --set /mesh/width=100 --set /mesh/height=100 --strict") == 1);
}

TEST_CASE("trust: texts from files are masked before they are printed on a terminal", "[trust]") {
  CHECK(printable("plain, ä € 𝄞\tand\nlines") == "plain, ä € 𝄞\tand\nlines");
  CHECK(printable("two\nlines\t", Lines::escape) == "two\\u000alines\\u0009");
  CHECK(printable("\x1b[31m\x07\x7f") == "\\u001b[31m\\u0007\\u007f");
  CHECK(printable("\xc2\x9b|\xe2\x80\xae|\xe2\x81\xa6|\xd8\x9c") == "\\u009b|\\u202e|\\u2066|\\u061c");
  // Invalid UTF-8: single bytes, cut off sequences, overlong sequences, half of a surrogate pair.
  CHECK(printable("\x9b\xff") == "\\ufffd\\ufffd");
  CHECK(printable("\xe2\x82") == "\\ufffd\\ufffd");
  CHECK(printable("\xc0\x9b") == "\\ufffd\\ufffd");
  CHECK(printable("\xed\xa0\x80") == "\\ufffd\\ufffd\\ufffd");
}

TEST_CASE("trust: cloth that diverges on a mesh obstacle ends only its own run", "[trust]") {
  const WithoutTraps infinities;  // on purpose
  const MeshSurface surface(grid(2, 2, 1, 1));
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const Vector3& x : {Vector3(nan, 0, 0), Vector3(0, inf, 0), Vector3(1e300, 0, -inf)}) {
    CHECK(surface.nearest(x).distance == inf);
    CHECK_FALSE(surface.first_crossing(x, Vector3::Zero()));
    std::vector<int> triangles;
    surface.triangles_in_box(x, x, triangles);
    CHECK(triangles.empty());
  }
  Workplace place;
  place.write("ball.obj",
              "v -1 -1 -1\nv 1 -1 -1\nv 0 1 -1\nv 0 0 -0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  place.write("wild.json", R"({"name": "wild", "mesh": {"cells": 6}, "duration": 1, "defaults": "paper",
      "initial": {"velocity": [0, 0, -1e30]}, "pins": {"vertices": []},
      "effects": [{"type": "gravity"}, {"type": "mesh_obstacle", "file": "ball.obj"}],
      "sweep": {"/initial/random": [0, 5], "/solver/precision": ["single", "double"]}})");
  const int code = place.run("run wild.json --jobs 1 --json");
  CHECK(code == 6);
  CHECK(place.out_lines().size() == 4);
}

TEST_CASE("trust: an axis can be added on the command line, and results can be selected and sorted",
          "[trust]") {
  Workplace place;
  place.write("tiny.json",
              R"({"$schema": "schema.json", "name": "tiny", "mesh": {"cells": 3}, "duration": 0.1})");
  CHECK(place.run("run tiny.json --sweep /mesh/cells=5,3,4 --sweep /bending/model=none,dihedral --json") ==
        0);
  CHECK(place.out_lines().size() == 6);
  CHECK(place.run("plan tiny.json --set /material/density=0.4 --sweep /mesh/cells=5,3 --json") == 0);
  CHECK(place.out_lines().size() == 2);
  CHECK(place.run("list --where /bending/model=none --sort /mesh/cells --json") == 0);
  std::vector<int> cells;
  for (const json& line : place.out_lines()) cells.push_back(line.at("config").at("mesh").at("cells"));
  CHECK(cells == std::vector<int>{3, 4, 5});
  CHECK(place.run("list --where /mesh/cells=4 --sort drop --json") == 0);
  const std::vector<json> sorted = place.out_lines();
  REQUIRE(sorted.size() == 2);
  CHECK(sorted[0].at("summary").at("drop") <= sorted[1].at("summary").at("drop"));
  CHECK(place.run("list --where /mesh/cells=7") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("no such runs"));
  CHECK(place.run("list --where cells") == 2);
  for (const std::string wrong : {"--where /mesh/cels=4", "--sort /mesh/cels"}) {
    CHECK(place.run("list " + wrong) == 2);
    CHECK_THAT(place.err(), ContainsSubstring("/mesh/cels") && ContainsSubstring("'/mesh/cells'"));
  }
  CHECK(place.run("list --sort dorp") == 2);
  CHECK_THAT(place.err(), ContainsSubstring("dorp") && ContainsSubstring("'drop'"));
  CHECK(place.run("run tiny.json --sweep cells") == 2);
  for (const char* both : {"--sweep /duration=0.1,0.2 --set /duration=0.3",
                           "--sweep /duration=0.1,0.2 --sweep /duration=0.3,0.4"}) {
    CHECK(place.run(std::string("plan tiny.json ") + both) == 3);
    CHECK_THAT(place.err(), ContainsSubstring("same setting"));
  }
  CHECK(place.run("plan tiny.json --sweep /solver/sweep=all --json") == 0);
  CHECK(place.out_lines().size() == 2);  // forward and symmetric
}

TEST_CASE("trust: two runs, and two sweeps, are compared", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  const auto run = [&](const std::string& arguments) {
    REQUIRE(place.run("run tiny.json --json " + arguments) == 0);
    return place.out_lines().at(0).at("id").get<std::string>();
  };
  const std::string first = run("--out a"), again = run("--out b"),
                    denser = run("--out a --set /material/density=0.4"),
                    finer = run("--out a --set /mesh/cells=4");
  const auto compared = [&](const std::string& arguments) {
    REQUIRE(place.run("compare " + arguments + " --json") == 0);
    return place.out_lines().at(0);
  };
  json difference = compared("a/tiny/" + first + " b/tiny/" + again);
  CHECK(difference.at("same_bits") == true);
  CHECK(difference.at("settings").empty());
  CHECK(difference.at("cloth").at("rms") == 0);
  difference = compared(first + " " + denser + " --results a");
  CHECK(difference.at("settings") ==
        json::array({{{"pointer", "/material/density"}, {"one", 0.2}, {"other", 0.4}}}));
  CHECK(difference.at("same_bits") == false);
  difference = compared(first + " " + finer + " --results a");
  bool has_vertices = false;
  for (const json& metric : difference.at("summary"))
    if (metric.at("name") == "vertices") {
      CHECK(metric.at("relative").get<double>() == 25.0 / 16 - 1);
      has_vertices = true;
    }
  CHECK(has_vertices);
  CHECK(difference.at("cloth").at("hausdorff").get<double>() > 0);
  REQUIRE(place.run("run tiny.json --out c --sweep /mesh/cells=3,4") == 0);
  REQUIRE(place.run("run tiny.json --out d --sweep /mesh/cells=4,5 --set /material/density=0.4") == 0);
  REQUIRE(place.run("compare c d --json") == 0);
  CHECK(place.out_lines().size() == 1);
  REQUIRE(place.run("compare c d") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("1 point in both, 1 only in ONE, 1 only in OTHER"));
  CHECK(place.run("compare c nothing") == 2);
}

TEST_CASE("trust: sweeps are compared by experiment, and several versions of a run are reported", "[trust]") {
  Workplace place;
  place.write("tiny.json", tiny);
  place.write("other.json", R"({"name": "other", "mesh": {"cells": 4}, "duration": 0.2})");
  const std::string swept = " --sweep /bending/model=none,dihedral --sweep /material/density=0.2,0.3",
                    turned = " --sweep /material/density=0.2,0.3 --sweep /bending/model=none,dihedral";
  REQUIRE(place.run("run tiny.json other.json --out a" + swept) == 0);
  REQUIRE(place.run("run tiny.json other.json --out b" + turned) == 0);
  REQUIRE(place.run("compare a b --json") == 0);
  CHECK(place.out_lines().size() == 8);
  for (const json& line : place.out_lines()) CHECK(line.at("same_bits") == true);
  CHECK(place.err().empty());
  REQUIRE(place.run("run tiny.json --out a --set /duration=0.3" + swept) == 0);
  REQUIRE(place.run("compare a/tiny b/tiny") == 0);
  CHECK_THAT(place.err(),
             ContainsSubstring("'a/tiny' has several runs") && ContainsSubstring("4 runs left out"));
  REQUIRE(place.run("compare a/tiny b/other") == 0);  // one experiment each, so only by point
  CHECK_THAT(place.out(), ContainsSubstring("4 points in both"));
}

TEST_CASE("trust: a run can be repeated from its file alone, without the files that it read", "[trust]") {
  Workplace place;
  place.write("ball.obj",
              "v -1 -1 -1\nv 1 -1 -1\nv 0 1 -1\nv 0 0 -0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  place.write("sheet.obj",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  place.write("on.json",
              R"({"name": "on", "mesh": {"file": "sheet.obj"}, "pins": {"vertices": []}, "duration": 0.5,
      "effects": [{"type": "gravity"}, {"type": "mesh_obstacle", "file": "ball.obj"}]})");
  REQUIRE(place.run("run on.json") == 0);
  const fs::path file = only_run(place);
  for (const char* input : {"ball.obj", "sheet.obj", "on.json"}) fs::remove(place.folder / input);
  fs::rename(file, place.folder / "alone.vtkhdf");
  CHECK(place.run("rerun alone.vtkhdf --json") == 0);
  const json result = place.out_lines().at(0);
  CHECK(result.at("same_bits") == true);
  CHECK(result.at("changed").empty());
  CHECK(place.run("rerun alone.vtkhdf --out kept") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("the same bits") && ContainsSubstring("by the same program"));
  CHECK(fs::exists(place.folder / "kept" / "on"));
  SECTION("although only another run of its sweep differs from its reference") {
    place.write("models.json", R"({"name": "models", "mesh": {"cells": 3}, "duration": 0.1,
        "sweep": {"/bending/model": ["isometric", "choi_ko"]},
        "accuracy": {"solver": ["/bending/choi_ko/force=\"polynomial\""]}})");
    place.run("run models.json --json");
    REQUIRE(place.out_lines().size() == 2);
    for (const json& run : place.out_lines()) {
      CHECK(place.run("rerun " + run.at("id").get<std::string>() + " --json") == 0);
      CHECK(place.out_lines().at(0).at("same_bits") == true);
    }
  }
  SECTION("at the same point of its sweep, without new warnings, and without replacing the run") {
    place.write("tiny.json", tiny);
    REQUIRE(place.run("run tiny.json --sweep /bending/k=0.5,0.25 --set /bending/stiffness=k --json") == 0);
    const json swept = place.out_lines().at(0);
    CHECK(place.run("rerun " + swept.at("id").get<std::string>() + " --out results") == 2);
    CHECK_THAT(place.err(), ContainsSubstring("the run itself"));
    CHECK(place.run("rerun " + swept.at("id").get<std::string>() + " --out again") == 0);
    REQUIRE(place.run("list again --json") == 0);
    const json repeated = place.out_lines().at(0);
    const auto folder_of = [](const json& run) {
      return fs::path(run.at("file").get<std::string>()).parent_path().filename();
    };
    CHECK(folder_of(repeated) == folder_of(swept));
    CHECK(repeated.at("warnings").empty());
    return;
  }
  CHECK(place.run("show alone.vtkhdf") == 0);
  for (const char* origin : {"libraries", "Eigen 3", "blas_kernels", "started", "ended"})
    CHECK_THAT(place.out(), ContainsSubstring(origin));
}

TEST_CASE("trust: the help of every command has an example", "[trust]") {
  Workplace place;
  REQUIRE(place.run("completion bash") == 0);
  std::istringstream lines(place.out());
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(") options=");
    if (end == std::string::npos) continue;
    const std::string command = line.substr(4, end - 4);
    CAPTURE(command);
    REQUIRE(place.run(command + " --help") == 0);
    CHECK_THAT(place.out(), ContainsSubstring("Example: "));
    ++commands;
  }
  CHECK(commands == 26);
}

TEST_CASE("trust: the shells complete commands, options and files of the program", "[trust]") {
  Workplace place;
  for (const char* shell : {"bash", "zsh"}) {
    REQUIRE(place.run(std::string("completion ") + shell) == 0);
    CHECK_THAT(place.out(), ContainsSubstring("--checkpoint") && ContainsSubstring("/mesh/cells="));
  }
  REQUIRE(place.run("completion bash") == 0);
  place.write("script", place.out());
  const auto completed = [&](const std::string& words) {
    const std::string command =
        "cd '" + place.folder.string() + "' && bash -c '. ./script; COMP_WORDS=(bendlab " + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _bendlab; echo \"${COMPREPLY[@]}\"' >found";
    return std::system(command.c_str()) == 0 ? bendlab::test::read(place.folder / "found") : "";
  };
  CHECK(completed("val") == "validate\n");
  CHECK(completed("run --for") == "--force\n");
  CHECK(completed("export --format us") == "usda\n");
  CHECK(completed("run a.json --set /solver/subs") == "/solver/substeps=\n");
  CHECK(completed("show scr") == "script\n");
}

}  // namespace bendlab::trust_test
