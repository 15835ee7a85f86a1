// Export of runs for other programs. Independent readers compare the exported files with the run file
// (tests/export/exported.py: h5py, Python's csv, a strict parser of USD's text). Short formats are also
// compared byte by byte.
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/files.hpp"
#include "experiments/export/format.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"
#include "tests/support.hpp"

namespace bendlab::export_test {
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// Every kind of obstacle that needs no file. Two of them move. 7 frames.
constexpr const char* scene = R"({"name": "scene", "duration": 0.2, "allow": ["implausible"],
  "mesh": {"generator": "grid", "width": 1, "height": 0.8, "cells": 4, "diagonal": "alternating"},
  "pins": {"vertices": ["upper_left"], "ring": 0},
  "effects": [{"type": "gravity", "acceleration": [0, 0, -9.81]},
    {"type": "sphere", "centre": [0, 0, -0.35], "radius": 0.25, "velocity": [0.3, 0, 0]},
    {"type": "sphere", "centre": [0.5, 0.5, -0.5], "radius": 0.1},
    {"type": "capsule", "a": [-0.4, -0.3, -0.3], "b": [0.1, -0.5, -0.2], "radius": 0.06},
    {"type": "disc", "centre": [0.4, -0.4, -0.4], "radius": 0.2, "height": 0.05, "axis": [0.2, 0, 1],
     "velocity": [0, 0, 0.2]},
    {"type": "plane", "point": [0, 0, -0.8], "normal": [0, 0, 2]}]})";

/// A folder with a run of a config, ready for export.
class ExportedPlace : public Workplace {
 public:
  explicit ExportedPlace(const std::string& config = scene) {
    write("scene.json", config);
    REQUIRE(run("run scene.json") == 0);
    run_file = run_files(".vtkhdf").at(0);
  }

  int exported(const std::string& arguments) {
    return run("export '" + run_file.string() + "' " + arguments);
  }

  /// The differences that exported.py reports; empty if all is right.
  std::string differences(const std::string& arguments) const {
    const std::string command = "cd '" + folder.string() + "' && " + places::python + " " + places::source +
                                "/tests/export/exported.py '" + run_file.string() + "' " + arguments +
                                " >differences 2>&1 || echo failed >>differences";
    return std::system(command.c_str()) == 0 ? test::read(folder / "differences") : "no shell";
  }

  std::size_t file_count(const std::string& name) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder / name), {}));
  }

  fs::path run_file;
};

/// The number at this offset of a file.
template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number number;
  REQUIRE(offset + sizeof number <= bytes.size());
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

TEST_CASE("The files of every format agree with the run file", "[export][slow]") {
  ExportedPlace here;
  for (const char* format : {"csv", "obj", "ply", "pc2", "usda"}) {
    const std::string name = format;
    INFO(name);
    REQUIRE(here.exported("--format " + name + " --to all/" + name) == 0);
    CHECK(here.err().empty());
    CHECK(here.differences(name + " all/" + name) == "");
    REQUIRE(here.exported("--format " + name + " --to some/" + name + " --frames 1:-2:2") == 0);
    CHECK(here.differences(name + " some/" + name + " --frames=1:-2:2") == "");
  }
  for (const char* format : {"obj", "ply", "pc2", "usda"}) {
    const std::string name = format;
    REQUIRE(here.exported("--format " + name + " --to one/" + name + "/a." + name + " --frames=-1") == 0);
    CHECK(here.differences(name + " one/" + name + "/a." + name + " --frames=-1") == "");
    REQUIRE(here.exported("--format " + name + " --to up/" + name + " --up y") == 0);
    CHECK(here.differences(name + " up/" + name + " --up y") == "");
  }
}

TEST_CASE("A run in double precision keeps its digits in formats with double precision", "[export]") {
  ExportedPlace here(R"({"name": "wide", "duration": 0.1, "mesh": {"cells": 3},
                         "solver": {"precision": "double"}})");
  REQUIRE(here.exported("--format obj --to wide.obj --frames 3") == 0);
  const PolygonSoup soup = read_polygon_soup(here.folder / "wide.obj");
  const std::vector<double> positions = read_positions(here.run_file, 3);
  REQUIRE(3 * soup.points.size() == positions.size());
  double largest = 0, narrow = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    largest = std::max(largest, std::abs(soup.points[i / 3][i % 3] - positions[i]));
    narrow = std::max(narrow, std::abs(static_cast<double>(static_cast<float>(positions[i])) - positions[i]));
  }
  CHECK(narrow > 1e-10);  // floats have lost digits
  CHECK(largest == 0);    // both the writer and the reader round to the nearest double
}

TEST_CASE("A PC2 file has the header that its specification demands", "[export]") {
  ExportedPlace here;
  REQUIRE(here.exported("--format pc2 --to cloth.pc2 --frames 2:6:2") == 0);
  const std::string bytes = test::read(here.folder / "cloth.pc2");
  CHECK(bytes.substr(0, 12) == std::string("POINTCACHE2\0", 12));
  CHECK(number_at<std::int32_t>(bytes, 12) == 1);
  CHECK(number_at<std::int32_t>(bytes, 16) == 20);  // 5 by 4
  CHECK(number_at<float>(bytes, 20) == 2);
  CHECK(number_at<float>(bytes, 24) == 2);
  CHECK(number_at<std::int32_t>(bytes, 28) == 3);
  CHECK(bytes.size() == 32 + 3 * 20 * 12);
}

TEST_CASE("The mesh readers accept exported OBJ and PLY", "[export]") {
  ExportedPlace here;
  for (const char* format : {"obj", "ply"}) {
    const std::string name = format;
    REQUIRE(here.exported("--format " + name + " --to seq/" + name) == 0);
    for (const auto& entry : fs::directory_iterator(here.folder / "seq" / name)) {
      INFO(entry.path());
      const bool open = entry.path().stem().string().starts_with("cloth") || entry.path().stem() == "plane";
      CHECK_NOTHROW(read_mesh(entry.path()));
      CHECK(diagnose(read_polygon_soup(entry.path())).empty());
      if (!open) CHECK(here.run("mesh '" + entry.path().string() + "'") == 0);
    }
  }
  const PolygonSoup soup = read_polygon_soup(here.folder / "seq/obj/cloth.0000.obj");
  CHECK(soup.texture_coordinates.size() == 3 * soup.triangles.size());
}

// The volume of a closed surface whose normals point outwards, by the signed volumes below its triangles.
double volume_of(const Surface& surface) {
  double six = 0;
  for (const auto& t : surface.triangles.rowwise())
    six += surface.positions.row(t(0)).dot(surface.positions.row(t(1)).cross(surface.positions.row(t(2))));
  return six / 6;
}

TEST_CASE("Exported obstacles are closed surfaces with normals outwards and the volume of their shape",
          "[export]") {
  const Sphere ball{.radius = 0.5};
  const Capsule pill{.a = {1, 2, 3}, .b = {1, 5, 7}, .radius = 0.5};
  const Disc table{.axis = {0, 3, 4}, .radius = 1.25, .height = 0.5};
  std::vector<std::string> notes;
  const auto surfaces = obstacle_surfaces({ball, pill, table, ball}, {}, Vector3::Zero(), 1, notes);
  REQUIRE(surfaces.size() == 4);
  CHECK(notes.empty());
  constexpr double pi = 3.14159265358979323846, r = 0.25, flat = 1;
  // The disc is a cylinder with half a torus around it; its volume follows from Pappus.
  const double volumes[] = {pi / 6, pi / 6 + pi / 4 * 5,
                            pi * flat * flat * 2 * r + 2 * pi * (flat + 4 * r / (3 * pi)) * pi * r * r / 2,
                            pi / 6};
  const char* const names[] = {"sphere_1", "capsule", "disc", "sphere_2"};
  for (std::size_t i = 0; i < 4; ++i) {
    INFO(names[i]);
    CHECK(surfaces[i].name == names[i]);
    CHECK_THAT(volume_of(surfaces[i]), Catch::Matchers::WithinRel(volumes[i], 2e-3));
    CHECK(volume_of(surfaces[i]) < volumes[i]);  // inscribed: its corners lie on the shape
  }
}

TEST_CASE("Every registered obstacle can be exported", "[export]") {
  for (const EffectKind* effect : effects()) {
    if (!effect->is_obstacle()) continue;
    INFO(effect->name);
    const bool reads_file = effect->settings.find("file") != nullptr;
    const Effect settings = test::effect_of(
        effect->name, reads_file ? test::Changes{{"file", std::string("ramp.obj")}} : test::Changes{});
    std::vector<InputFile> inputs;
    if (reads_file) inputs.push_back({"/effects/0/file", "ramp.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n"});
    std::vector<std::string> notes;
    const auto surfaces = obstacle_surfaces({settings}, inputs, Vector3::Zero(), 1, notes);
    CHECK(notes.empty());
    REQUIRE(surfaces.size() == 1);
    CHECK(surfaces[0].triangles.rows() > 0);
  }
}

TEST_CASE("A mesh obstacle comes from the run file, scaled and moved", "[export]") {
  ExportedPlace start;
  start.write("ramp.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  start.write("ramp.json", R"({"name": "ramp", "duration": 0.1, "mesh": {"cells": 3}, "effects": [
    {"type": "mesh_obstacle", "file": "ramp.obj", "scale": 0.5, "offset": [0, 0, -1]}]})");
  REQUIRE(start.run("run ramp.json --json") == 0);
  const std::string file = start.out_lines().at(0).at("file");
  fs::remove(start.folder / "ramp.obj");  // the run file holds it
  REQUIRE(start.run("export '" + file + "' --format obj --to ramp") == 0);
  const PolygonSoup soup = read_polygon_soup(start.folder / "ramp/mesh_obstacle.obj");
  REQUIRE(soup.points.size() == 4);
  CHECK(soup.points[1] == std::array<double, 3>{0.5, 0, -1});
  CHECK(soup.points[3] == std::array<double, 3>{0, 0, -1.5});
  CHECK(soup.triangles.size() == 4);
}

TEST_CASE("Texture coordinates of a mesh file are exported, except to PLY if they have a seam", "[export]") {
  // Two triangles share an edge. With a seam the ends of this edge have other coordinates in the second
  // triangle.
  const std::string cloth =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.25 0\nvt 0.25 0.5\nvt 0.75 0.5\nvt 0.5 0.5\nvt 0.5 "
      "0\nf "
      "1/1 2/2 3/3\nf 1/6 3/4 4/5\n";
  const bool seam = GENERATE(true, false);
  Workplace here;
  here.write("cloth.obj",
             seam ? cloth : "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.25 0\nvt 0 0.5\nf 1/1 2/2 3/3\n");
  here.write("cloth.json", R"({"name": "cloth", "duration": 0.1, "mesh": {"file": "cloth.obj"}})");
  REQUIRE(here.run("run cloth.json --json") == 0);
  const std::string file = here.out_lines().at(0).at("file");
  for (const char* format : {"obj", "ply", "usda"})
    REQUIRE(here.run("export '" + file + "' --frames 0 --format " + format + " --to out." + format) == 0);
  const PolygonSoup given = read_polygon_soup(here.folder / "cloth.obj"),
                    got = read_polygon_soup(here.folder / "out.obj");
  CHECK(got.triangles == given.triangles);
  CHECK(got.texture_coordinates == given.texture_coordinates);
  CHECK((test::read(here.folder / "out.ply").find("property float s\n") == std::string::npos) == seam);
  CHECK_THAT(test::read(here.folder / "out.usda"), ContainsSubstring("interpolation = \"faceVarying\""));
}

TEST_CASE("Without --to the export is beside the run file", "[export]") {
  ExportedPlace here;
  const std::string id = here.run_file.parent_path().filename();
  REQUIRE(here.run("export results/scene --format ply --json") == 0);  // the run is named like for `show`
  const json result = here.out_lines().at(0);
  const fs::path to = here.run_file.parent_path() / "export/ply";
  std::uint64_t bytes = 0, files = 0;
  for (const auto& entry : fs::directory_iterator(to)) bytes += entry.file_size(), ++files;
  CHECK(files == 3 * 7 + 3);  // cloth, a sphere and the disc move in 7 frames; three obstacles do not
  CHECK(result.at("files") == files);
  CHECK(result.at("bytes") == bytes);
  CHECK(fs::equivalent(here.folder / result.at("to").get<std::string>(), to));
  CHECK(result.at("frames") == 7);
  CHECK(result.at("format") == "ply");
  CHECK(result.at("surfaces").size() == 6);
  REQUIRE(here.run("export " + id + " --format usda") == 0);
  CHECK_THAT(here.out(), ContainsSubstring("export/usda: 1 file, ") && ContainsSubstring("7 frames: 0 to 6"));
  CHECK(here.run("list --json") == 0);  // `list` ignores the export
  CHECK(here.out_lines().size() == 1);
}

TEST_CASE("An export replaces existing files only with --force", "[export]") {
  ExportedPlace here;
  REQUIRE(here.exported("--format obj --to film") == 0);
  const std::size_t all = here.file_count("film");
  here.write("film/notes.txt", "mine");
  CHECK(here.exported("--format obj --to film") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("--force"));
  CHECK(here.exported("--format obj --to film --frames 2:3 --force") == 0);
  CHECK(here.file_count("film") == all + 1 - 3 * 5);  // other frames of three sequences were removed
  CHECK(test::read(here.folder / "film/notes.txt") == "mine");
  CHECK(fs::exists(here.folder / "film/cloth.0002.obj"));
  CHECK_FALSE(fs::exists(here.folder / "film/cloth.0001.obj"));
  CHECK(here.differences("obj film --frames 2:3").find("other files than expected") != std::string::npos);
  fs::remove(here.folder / "film/notes.txt");
  CHECK(here.differences("obj film --frames 2:3") == "");

  here.write("cloth.usda", "mine");
  CHECK(here.exported("--format usda --to cloth.usda") == 2);
  CHECK_THAT(here.err(), ContainsSubstring("--force"));
  CHECK(test::read(here.folder / "cloth.usda") == "mine");
  CHECK(here.exported("--format usda --to cloth.usda --force") == 0);
  CHECK(here.differences("usda cloth.usda") == "");

  here.write("cloth_plane.obj", "mine");  // a file that would be written beside the file of --to
  CHECK(here.exported("--format obj --to cloth.obj --frames 0") == 2);
  CHECK(test::read(here.folder / "cloth_plane.obj") == "mine");
  CHECK_FALSE(fs::exists(here.folder / "cloth.obj"));
}

TEST_CASE("Bad arguments of export exit with 2 and the message says what is allowed", "[export]") {
  ExportedPlace here;
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"", "--format is required"},
      {"--format fbx", "fbx"},
      {"--format obj --frames 7", "which has 7 frames: the first is 0, the last 6 or -1"},
      {"--format obj --frames=-8", "names no frames"},
      {"--format obj --frames 3:2", "names no frames"},
      {"--format obj --frames 0:3:0", "names no frames"},
      {"--format obj --frames 0:3:-1", "names no frames"},
      {"--format obj --frames 1:2:3:4", "FIRST:LAST:STEP"},
      {"--format obj --frames x", "'x' names no frames"},
      {"--format obj --up x", "--up"},
      {"--format obj --to a.obj", "a file for each of the 7 frames"},
      {"--format csv --to a.csv", "csv writes several files; name a folder"},
      {"--format usda --to a.obj", "a file of another format than usda"},
      {"--format usda --to scene.json", "is a file, but its extension is not .usda"},
      {"--format usda --to folder.usda", "is a folder"},
  }));
  fs::create_directory(here.folder / "folder.usda");
  INFO(arguments);
  CHECK(here.exported(arguments) == 2);
  CHECK_THAT(here.err(), ContainsSubstring(message));
  CHECK(here.out().empty());
  CHECK(here.file_count(".") == 5);  // only config, results, folder.usda, stdout and stderr
}

TEST_CASE("If a file or a folder cannot be written, export exits with 5 and leaves no file", "[export]") {
  ExportedPlace here;
  CHECK(here.exported("--format obj --to scene.json/out") == 5);
  CHECK_THAT(here.err(), ContainsSubstring("scene.json/out"));
  // A disk that is full after 20 KiB.
  const std::string shell =
      "sh' -c 'ulimit -f 40; trap \"\" XFSZ; exec \"$0\" \"$@\"' '" + std::string(places::program);
  for (const char* to : {"deep/er", "deep/er/cloth.usda"}) {
    CHECK(here.run("export '" + here.run_file.string() + "' --format usda --to " + to, shell) == 5);
    CHECK_THAT(here.err(), ContainsSubstring("cloth.usda: can't be written"));
    CHECK_FALSE(fs::exists(here.folder / "deep"));
  }
  CHECK(here.run("export nowhere --format csv") == 2);
  here.write("run.vtkhdf", "no run");
  CHECK(here.run("export run.vtkhdf --format csv") == 5);
}

TEST_CASE("An export that is stopped leaves no file", "[export]") {
  ExportedPlace here;
  const RunRecord record = read_run(here.run_file);
  const std::atomic<bool> stop = true;
  for (const Format* format : formats()) {
    INFO(format->name);
    CHECK_THROWS_AS(export_run(record, *format, {.to = here.folder / "stopped", .stop = &stop}),
                    ExportStopped);
    CHECK_FALSE(fs::exists(here.folder / "stopped"));
  }
}

TEST_CASE("An unfinished run is exported up to its last frame", "[export]") {
  Workplace here;
  {
    RunFileWriter writer(here.folder / "run.vtkhdf", {.id = "0123",
                                                      .name = "cut",
                                                      .rest_positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                      .triangles = {0, 1, 2},
                                                      .pinned = {0, 0, 0},
                                                      .config = "{}"});
    writer.write({.time = 0, .positions = {0, 0, 0, 1, 0, 0, 0, 1, 0}});
    writer.write({.time = 0.5, .positions = {0, 0, -1, 1, 0, -1, 0, 1, -1}});
  }
  REQUIRE(here.run("export run.vtkhdf.part --format obj --to cut") == 0);
  CHECK(fs::exists(here.folder / "cut/cloth.0000.obj"));
  CHECK(read_polygon_soup(here.folder / "cut/cloth.0001.obj").points[1] == std::array<double, 3>{1, 0, -1});
}

TEST_CASE("Formats without times give a warning if frames are not evenly spaced", "[export]") {
  // 0.1 s are 3 frames at 30 per second. The last frame, at the end of the run, comes half a frame later.
  ExportedPlace here(R"({"name": "uneven", "duration": 0.1166666666666667, "mesh": {"cells": 2},
                         "solver": {"dt": 0.016666666666666666}})");
  REQUIRE(here.exported("--format ply --to ply") == 0);
  CHECK_THAT(here.err(),
             ContainsSubstring("ply has no times") && ContainsSubstring("frame 4 is at 0.116667 s"));
  REQUIRE(here.exported("--format usda --to usda") == 0);
  CHECK(here.err().empty());
  CHECK(here.differences("usda usda") == "");
  CHECK_THAT(test::read(here.folder / "usda/cloth.usda"), ContainsSubstring("endTimeCode = 3.5"));
}

TEST_CASE("With gravity along -y, y is the up axis of the export", "[export]") {
  ExportedPlace here(R"({"name": "up", "duration": 0.1, "mesh": {"cells": 2},
                         "effects": [{"type": "gravity", "acceleration": [0, -9.81, 0]}]})");
  REQUIRE(here.exported("--format usda --to up.usda") == 0);
  CHECK_THAT(test::read(here.folder / "up.usda"), ContainsSubstring("upAxis = \"Y\""));
  // (x, y, z) with y up is (x, -z, y) with z up.
  REQUIRE(here.exported("--format obj --to z.obj --frames -1 --up z") == 0);
  const PolygonSoup soup = read_polygon_soup(here.folder / "z.obj");
  const std::vector<double> stored = read_positions(here.run_file, -1);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    CHECK(static_cast<float>(soup.points[v][0]) == static_cast<float>(stored[3 * v]));
    CHECK(static_cast<float>(soup.points[v][1]) == -static_cast<float>(stored[3 * v + 2]));
    CHECK(static_cast<float>(soup.points[v][2]) == static_cast<float>(stored[3 * v + 1]));
  }
}

TEST_CASE("CSV quotes fields that need quotes", "[export]") {
  Workplace here;
  RunFileWriter writer(here.folder / "odd.vtkhdf",
                       {.id = "0123",
                        .name = "odd",
                        .rest_positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
                        .triangles = {0, 1, 2},
                        .pinned = {0, 0, 0},
                        .metrics = {{"a,b", "m", "says \"so\""}, {"none", "1", "two\nlines"}},
                        .config = "{}"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  writer.write({.time = 0, .positions = {0, 0, 0, 1, 0, 0, 0, 1, 0}, .metrics = {0.1, nan}});
  writer.finish({.summary = {{"tenth", 0.1}, {"undefined", nan}}});
  REQUIRE(here.run("export odd.vtkhdf --format csv --to csv") == 0);
  CHECK(test::read(here.folder / "csv/frames.csv") == "frame,time,\"a,b\",none\n0,0,0.1,\n");
  CHECK(test::read(here.folder / "csv/summary.csv") ==
        "name,value,unit,meaning\ntenth,0.1,,\nundefined,,,\n");
  CHECK_THAT(test::read(here.folder / "csv/columns.csv"),
             ContainsSubstring("\"a,b\",m,\"says \"\"so\"\"\"\nnone,1,\"two\nlines\"\n"));
  // The config of this run has no settings. Everything else is exported nevertheless.
  REQUIRE(here.run("export odd.vtkhdf --format usda --to odd.usda") == 0);
}

}  // namespace

}  // namespace bendlab::export_test
