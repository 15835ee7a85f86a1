// /mesh/refine and /mesh/jitter of configs: with files and generators, and with pins by number.
#include <algorithm>
#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::refine_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

RunConfig run_of(const std::string& mesh, const std::string& more = "") {
  return parse_experiment(R"({"name": "refined", "mesh": {)" + mesh + "}" + more + "}", "test").runs.front();
}

}  // namespace

TEST_CASE("refine: the vertices of a file keep their numbers, so pins by number keep their places",
          "[mesh]") {
  const test::Workplace here;
  here.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const BuiltScene scene =
      build_scene(run_of(R"("refine": 2, "file": ")" + (here.folder / "square.obj").string() + R"(")",
                         R"(, "pins": {"vertices": [], "indices": [2]})")
                      .scene());
  CHECK(scene.rest.vertex_count() == 25);  // 4 × 4 cells
  CHECK(scene.rest.triangle_count() == 32);
  CHECK(scene.pins.all == std::vector<int>{2});
  CHECK(scene.rest.position(2) == Vector3(1, 1, 0));
}

TEST_CASE("jitter: interior vertices of a file's mesh move depending on the seed", "[mesh]") {
  const test::Workplace here;
  here.write("fan.obj",
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const std::string file = R"("file": ")" + (here.folder / "fan.obj").string() + R"(", "jitter": 0.2)";
  const RestMesh default_seed(rest_mesh_of(run_of(file).scene().mesh, {}).mesh),
      second_seed(rest_mesh_of(run_of(file + R"(, "seed": 2)").scene().mesh, {}).mesh);
  CHECK(default_seed.positions().topRows(4) == second_seed.positions().topRows(4));
  CHECK(default_seed.positions().row(4) != second_seed.positions().row(4));
  CHECK((default_seed.position(4) - Vector3(0.5, 0.5, 0)).norm() <= 0.2 * 0.5);  // its triangles are 0.5 high
  CHECK_THROWS_WITH(run_of(R"("seed": 2, "file": ")" + (here.folder / "fan.obj").string() + R"(")"),
                    ContainsSubstring("/mesh/seed"));
}

TEST_CASE("refine and jitter: impossible values are refused with their pointer", "[mesh]") {
  CHECK_THROWS_WITH(build_scene(run_of(R"("cells": 64, "refine": 9)").scene()),
                    ContainsSubstring("/mesh/refine") && ContainsSubstring("at most 6 times"));
  CHECK_THROWS_WITH(run_of(R"("cells": 4, "jitter": 0.5)"), ContainsSubstring("/mesh/jitter"));
}

TEST_CASE("jitter: the seed is used, and the border does not move", "[mesh]") {
  const auto box = [](const RestMesh& rest) { return std::pair(rest.box_min(), rest.box_max()); };
  const RestMesh even(rest_mesh_of(run_of(R"("cells": 8)").scene().mesh, {}).mesh),
      default_seed(rest_mesh_of(run_of(R"("cells": 8, "jitter": 0.3)").scene().mesh, {}).mesh),
      second_seed(rest_mesh_of(run_of(R"("cells": 8, "jitter": 0.3, "seed": 2)").scene().mesh, {}).mesh);
  CHECK(default_seed.positions() != even.positions());
  CHECK(default_seed.positions() != second_seed.positions());
  CHECK(box(default_seed) == box(even));
  CHECK(box(second_seed) == box(even));
}

}  // namespace bendlab::refine_test
