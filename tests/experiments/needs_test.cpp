// What a run needs, estimated from its settings. For memory and disk of whole runs see tests/trust/needs.py.
#include "experiments/run/needs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/campaign/run_times.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::needs_test {
using namespace bendlab::test;
using Catch::Matchers::WithinRel;

namespace {

RunConfig config_of(const std::string& mesh, const std::string& bending, const std::string& more = "") {
  return parse_experiment(fmt::format(R"({{"name": "needs", "duration": 0.1, "mesh": {{{}}},
    "pins": {{"vertices": ["upper_right"]}}, "bending": {{{}}}{}}})",
                                      mesh, bending, more),
                          "test")
      .runs.front();
}

}  // namespace

TEST_CASE("needs: the vertices of a large mesh follow from a mesh with fewer cells") {
  const std::string mesh = GENERATE(
      R"("cells": 201)", R"("cells": 400, "width": 2, "height": 0.5)", R"("cells": 150, "diagonal": "both")",
      R"("generator": "equilateral", "cells": 200, "rows": "perpendicular", "height": 0.4)",
      R"("generator": "delaunay", "cells": 200)", R"("generator": "disc", "cells": 140, "radius": 0.7)",
      R"("generator": "tube", "cells": 300, "radius": 0.4, "radius_top": 0.1, "height": 0.8)",
      R"("generator": "sphere", "cells": 140, "radius": 0.5)", R"("cells": 50, "refine": 2)");
  CAPTURE(mesh);
  const RunConfig config = config_of(mesh, R"("stiffness": "compliance", "compliance": 0.1)");
  const auto needs = needs_of(config);
  REQUIRE(needs);
  // The border has n vertices more than n² cells, and rows are rounded; the smallest mesh has 50 cells.
  CHECK_THAT(
      needs->vertices,
      WithinRel(RestMesh(rest_mesh_of(config.scene().mesh, config.folder()).mesh).vertex_count(), 0.1));
}

TEST_CASE("needs: the springs of a model are counted by the rings that they reach") {
  const std::string bending =
      GENERATE(R"("model": "k_ring")", R"("model": "k_ring", "k_ring": {"k": 4})",
               R"("model": "k_ring", "k_ring": {"k": 4, "rings": "last"})",
               R"("model": "k_ring", "k_ring": {"k": 3, "shared_pairs": "twice"})",
               R"("model": "adaptive", "adaptive": {"radius": 0.04})", R"("model": "lod", "lod": {"t": 5})");
  CAPTURE(bending);
  const RunConfig config = config_of(R"("generator": "equilateral", "cells": 96)",
                                     bending + R"(, "stiffness": "compliance", "compliance": 0.1)");
  const BuiltScene scene = build_scene(config.scene());
  const auto needs = needs_of(config);
  REQUIRE(needs);
  // Ring r of an interior vertex holds 6 r vertices. The border cuts off up to half of the rings of the
  // vertices within 5 of 96 edges of it, which are up to a fifth of all vertices.
  CHECK_THAT(needs->springs, WithinRel(static_cast<double>(scene.input.distance.size()), 0.1));
}

TEST_CASE("needs: a mesh that cannot be made has none") {
  CHECK(!needs_of(config_of(R"("file": "/nowhere/sheet.obj")", "")));
}

TEST_CASE("needs: work is vertices × substeps × iterations × steps") {
  const RunConfig config = config_of(
      R"("cells": 9)", "", R"(, "solver": {"method": "pbd", "dt": 0.01, "substeps": 4, "iterations": 3})");
  CHECK_THAT(crude_work(config), WithinRel(100.0 * 4 * 3 * 10, 1e-12));
}

TEST_CASE("needs: time follows from finished runs with the same model and method") {
  const auto run = [](const char* cells, const char* model, const char* substeps) {
    return config_of(fmt::format(R"("cells": {})", cells), fmt::format(R"("model": "{}")", model),
                     fmt::format(R"(, "solver": {{"substeps": {}, "iterations": 1}})", substeps));
  };
  RunTimes times;
  CHECK_FALSE(times.expected(run("9", "dihedral", "8")));
  times.add(run("9", "dihedral", "1"), 1);
  times.add(run("9", "dihedral", "2"), 4);
  times.add(run("9", "dihedral", "4"), 12);
  CHECK_FALSE(times.expected(run("9", "isometric", "8")));
  // 1, 2 and 3 s for each substep: the median is 2 s. The vertices 20² are nearer to 10² than to 60².
  times.add(run("59", "dihedral", "1"), 1000);
  const auto expected = times.expected(run("19", "dihedral", "8"));
  REQUIRE(expected);
  CHECK_THAT(expected->cpu_s, WithinRel(2.0 * 8 * 4, 1e-12));
  CHECK(expected->finished == 3);
}

TEST_CASE("needs: a run that needs more memory than any machine has is refused before it starts") {
  Workplace place;
  const Experiment experiment = parse_experiment(
      R"({"name": "huge", "duration": 0.1, "mesh": {"cells": 4096}, "bending": {"model": "adaptive"}})",
      "test");
  CHECK_THROWS_AS(execute_run(experiment, experiment.runs.front(), place.folder), NoRoom);
  const Experiment frames = parse_experiment(
      R"({"name": "frames", "duration": 1e6, "mesh": {"cells": 256}, "bending": {"model": "none"},
          "output": {"frames_per_second": 1000}, "solver": {"dt": 0.001}})",
      "test");
  CHECK_THROWS_WITH(execute_run(frames, frames.runs.front(), place.folder),
                    Catch::Matchers::ContainsSubstring("/output/frames_per_second"));
}

TEST_CASE("needs: numbers are printed with readable units") {
  CHECK(bytes_text(0) == "0 bytes");
  CHECK(bytes_text(1.234e9) == "1.23 GB");
  CHECK(bytes_text(999.9e6) == "1 GB");
  CHECK(duration_text(3.04) == "3 s");
  CHECK(duration_text(240) == "4 min");
  CHECK(duration_text(9000) == "2.5 h");
}

TEST_CASE("needs: in a control group, memory of cached files counts as free") {
  Workplace place;
  CHECK(std::isinf(left_in_group(place.folder)));
  place.write("memory.max", "max\n");
  place.write("memory.current", "900\n");
  CHECK(std::isinf(left_in_group(place.folder)));
  place.write("memory.max", "1000\n");
  CHECK(left_in_group(place.folder) == 100);
  place.write("memory.stat", "anon 100\ninactive_file 700\nactive_file 50\n");
  CHECK(left_in_group(place.folder) == 800);
}

}  // namespace bendlab::needs_test
