// The forecast of the size of a mesh and its constraints, compared with the built mesh and constraints. For
// memory and disk of whole runs see tests/trust/forecast.py.
#include "experiments/run/forecast.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_size.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

using namespace bendlab;
using namespace bendlab::test;

namespace {

RunConfig config_of(const std::string& mesh, const std::string& bending) {
  return parse_experiment(fmt::format(R"({{"name": "expected", "duration": 0.1, "mesh": {{{}}},
    "pins": {{"vertices": ["upper_right"]}}, "bending": {{{}}}}})",
                                      mesh, bending),
                          "test")
      .runs.front();
}

// The relative difference |a - b| / b.
double off(double a, double b) {
  return std::abs(a - b) / b;
}

}  // namespace

TEST_CASE("forecast: the size of a mesh follows from a patch") {
  const std::string mesh = GENERATE(
      R"("cells": 201)", R"("cells": 400, "width": 2, "height": 0.5)", R"("cells": 300, "height": 0.02)",
      R"("cells": 200, "diagonal": "alternating")", R"("cells": 150, "diagonal": "both")",
      R"("generator": "equilateral", "cells": 200)",
      R"("generator": "equilateral", "cells": 200, "rows": "perpendicular", "height": 0.4)",
      R"("generator": "delaunay", "cells": 200)", R"("generator": "disc", "cells": 120, "radius": 0.7)",
      R"("generator": "tube", "cells": 200, "radius": 0.2, "height": 0.8)",
      R"("generator": "tube", "cells": 300, "radius": 0.4, "radius_top": 0.1, "height": 0.8)",
      R"("generator": "sphere", "cells": 96, "radius": 0.5)", R"("cells": 200, "scale": 3)",
      R"("cells": 50, "refine": 2)");
  CAPTURE(mesh);
  const RunConfig config = config_of(mesh, R"("stiffness": "compliance", "compliance": 0.1)");
  const auto size = size_of(config);
  REQUIRE(size);
  const RestMesh rest(rest_mesh_of(config.scene().mesh, config.folder()).mesh);
  CHECK(off(size->vertices, rest.vertex_count()) < 0.05);
  CHECK(off(size->triangles, rest.triangle_count()) < 0.05);
  CHECK(off(size->constraints, static_cast<double>(rest.hinges().size())) < 0.05);
  CHECK(off(size->mean_edge, rest.mean_edge_length()) < 0.05);
  CHECK(off(size->size, rest.size()) < 0.05);
}

TEST_CASE("forecast: the expected number of constraints of every model is near the built number") {
  const std::string bending = GENERATE(
      R"("model": "none")", R"("model": "crossover")", R"("model": "k_ring")",
      R"("model": "k_ring", "k_ring": {"k": 4})", R"("model": "k_ring", "k_ring": {"k": 4, "rings": "last"})",
      R"("model": "k_ring", "k_ring": {"k": 3, "rings": "beyond_edges"})",
      R"("model": "k_ring", "k_ring": {"k": 3, "shared_pairs": "twice"})", R"("model": "adaptive")",
      R"("model": "adaptive", "adaptive": {"radius": 0.12})",
      R"("model": "adaptive", "adaptive": {"rings": "ends", "m_min": 3})", R"("model": "lod")",
      R"("model": "lod", "lod": {"t": 5})", R"("model": "lod", "lod": {"ring_1": true})",
      R"("model": "sparse_lod")", R"("model": "prestressed", "prestressed": {"springs": 6})",
      R"("model": "dihedral")", R"("model": "bridson")", R"("model": "discrete_shells")",
      R"("model": "isometric")", R"("model": "choi_ko")", R"("model": "choi_ko", "choi_ko": {"ring": 3})");
  const std::string mesh = GENERATE(
      R"("cells": 48)", R"("cells": 48, "diagonal": "alternating")", R"("cells": 32, "diagonal": "both")",
      R"("generator": "delaunay", "cells": 48)", R"("generator": "equilateral", "cells": 48)",
      R"("generator": "tube", "cells": 64, "radius": 0.2, "height": 0.8)");
  CAPTURE(bending, mesh);
  const std::string stiffness = R"(, "stiffness": "compliance", "compliance": 0.1)";
  const RunConfig config = config_of(mesh, bending + stiffness);
  const BuiltScene scene = build_scene(config.scene());
  const double built = static_cast<double>(scene.input.distance.size() + element_count(scene.input.elements));
  const auto needs = forecast(config);
  REQUIRE(needs);
  CHECK((built > 0) == (needs->constraints > 0));
  if (built > 0) CHECK(off(needs->constraints, built) < 0.12);  // the forecast of memory must be within 0.2
}

TEST_CASE("forecast: the number of constraints follows from a patch with the LOD levels of the whole mesh") {
  const std::string bending =
      GENERATE(R"("model": "k_ring", "k_ring": {"k": 4})", R"("model": "adaptive")",
               R"("model": "adaptive", "adaptive": {"radius": 0.05})", R"("model": "lod")",
               R"("model": "sparse_lod")", R"("model": "choi_ko")", R"("model": "isometric")");
  CAPTURE(bending);
  const std::string stiffness = R"(, "stiffness": "compliance", "compliance": 0.1)";
  const RunConfig config = config_of(R"("cells": 240)", bending + stiffness);
  const BuiltScene scene = build_scene(config.scene());
  const auto size = size_of(config);
  REQUIRE(size);
  CHECK(off(size->constraints,
            static_cast<double>(scene.input.distance.size() + element_count(scene.input.elements))) < 0.05);
}

TEST_CASE("forecast: a mesh file has the same forecast as the generator of this mesh") {
  Workplace place;
  const RunConfig generated = config_of(R"("cells": 24)", R"("model": "adaptive")");
  const RestMesh rest(rest_mesh_of(generated.scene().mesh, generated.folder()).mesh);
  std::string obj;
  for (int v = 0; v < rest.vertex_count(); ++v)
    obj += fmt::format("v {} {} {}\n", rest.position(v).x(), rest.position(v).y(), rest.position(v).z());
  for (int t = 0; t < rest.triangle_count(); ++t)
    obj += fmt::format("f {} {} {}\n", rest.triangles()(t, 0) + 1, rest.triangles()(t, 1) + 1,
                       rest.triangles()(t, 2) + 1);
  place.write("sheet.obj", obj);
  const RunConfig read = config_of(fmt::format(R"("file": "{}")", (place.folder / "sheet.obj").string()),
                                   R"("model": "adaptive")");
  const auto by_generator = forecast(generated), by_file = forecast(read);
  REQUIRE((by_generator && by_file));
  CHECK(off(by_file->constraints, by_generator->constraints) < 0.1);
  CHECK(off(by_file->memory_bytes, by_generator->memory_bytes) < 0.1);
  CHECK(!forecast(config_of(R"("file": "/nowhere/sheet.obj")", "")));
}

TEST_CASE("forecast: a run that needs more memory than any machine has is refused before it starts") {
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

TEST_CASE("forecast: numbers are printed with readable units") {
  CHECK(bytes_text(0) == "0 bytes");
  CHECK(bytes_text(1.234e9) == "1.23 GB");
  CHECK(bytes_text(999.9e6) == "1 GB");
  CHECK(duration_text(3.04) == "3 s");
  CHECK(duration_text(240) == "4 min");
  CHECK(duration_text(9000) == "2.5 h");
}

TEST_CASE("forecast: in a control group, memory of cached files counts as free") {
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
