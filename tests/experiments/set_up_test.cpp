// `validate` refuses every scene that a run would refuse, with a pointer and a remedy that works.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "experiments/run/set_up.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::set_up_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using test::Workplace;

// A roof: two squares that meet at a right angle.
const char* roof =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 1 1\nv 1 1 1\nf 1 2 4\nf 1 4 3\nf 3 4 6\nf 3 6 5\n";

struct Refusal {
  std::string settings;               ///< of the config
  std::string pointer, text;          ///< of the message
  std::vector<std::string> remedies;  ///< options --set of the remedies
};

const std::string times = R"("type": "moving_pins", "times": [0, 1])";
const std::string small = R"("mesh": {"cells": 4}, )";

const std::vector<Refusal> refusals = {
    {R"("mesh": {"file": "roof.obj"}, "bending": {"model": "adaptive"})",
     "/bending/stiffness",
     "discrete_shells",
     {"--set /bending/model=dihedral", "--set /bending/model=isometric",
      R"(--set '/bending={"model":"adaptive","k":0.5}')",
      R"(--set '/bending={"model":"adaptive","compliance":1e-3}')"}},
    {R"("mesh": {"file": "roof.obj"}, "bending": {"model": "isometric", "quartic_coefficient": null,
        "flexural_rigidity": 1e-5, "isometric": {"constraint": "energy"}})",
     "/bending/stiffness",
     R"(set the model's "constraint" to "norm")",
     {"--set /bending/isometric/constraint=norm"}},
    {R"("mesh": {"file": "roof.obj"}, "bending": {"model": "dihedral", "deflection": "small"})",
     "/bending/stiffness",
     R"(set it to "large", or choose)",
     {"--set /bending/deflection=large"}},
    {small + R"("bending": {"model": "dihedral", "deflection": "small"})",
     "/bending/stiffness",
     R"(use more cells, or "deflection": "large")",
     {"--set /bending/deflection=large", "--set /mesh/cells=24"}},
    {small + R"("bending": {"model": "k_ring", "k_ring": {"rest_length": "path"}})",
     "/bending/stiffness",
     R"(set the model's "rest_length" to "euclidean")",
     {"--set /bending/k_ring/rest_length=euclidean", R"(--set '/bending={"model":"k_ring","k":0.5}')"}},
    {small + R"("pins": {"indices": [25]})",
     "/pins/indices",
     "vertices 0 to 24",
     {"--set '/pins/indices=[24]'"}},
    {small + R"("pins": {"vertices": ["top_rim"]})",
     "/pins/vertices",
     "Use corners or sides",
     {R"(--set '/pins/vertices=["top"]')"}},
    {small + R"("effects": [{)" + times + R"(, "offsets": [0, 0, 1]}])",
     "/effects/0",
     "offsets has 3 numbers, expected 6",
     {"--set '/effects/0/offsets=[0,0,0,0,0,1]'"}},
    {small + R"("effects": [{"type": "moving_pins", "times": [1, 0], "offsets": [0, 0, 0, 0, 0, 1]}])",
     "/effects/0",
     "times must grow",
     {"--set '/effects/0/times=[0,1]'"}},
    {small + R"("effects": [{)" + times + R"(, "offsets": [0, 0, 0, 0, 0, 1], "indices": [12]}])",
     "/effects/0",
     "vertex 12 is not pinned: add it to /pins, or remove it here",
     {"--set '/pins/indices=[12]'", "--set '/effects/0/indices=[]'"}},
    {small + R"("effects": [{)" + times + R"(, "angles": [0, 90], "axis": [0, 0, 0]}])",
     "/effects/0",
     "axis has no length: choose a vector that is not zero",
     {"--set '/effects/0/axis=[0,0,1]'"}},
    {small + R"("effects": [{"type": "plane", "point": [0, 0, -1], "normal": [0, 0, 0]}])",
     "/effects/0",
     "normal is the zero vector, which has no direction; choose another vector",
     {"--set '/effects/0/normal=[0,0,1]'"}},
    {small + R"("material": {"coordinates": "texture"})",
     "/material/coordinates",
     "the mesh has no texture coordinates",
     {"--set /material/coordinates=warp"}},
    {small + R"("output": {"measures": ["drape"]}, "pins": {"vertices": ["top"], "ring": 0})",
     "/output/measures",
     "pin the centre, with /pins/distance equal to the table's radius",
     {R"(--set '/pins={"vertices":["centre"],"distance":0.3}')"}},
    {small + R"("output": {"measures": ["stiffness"]}, "pins": {"vertices": ["upper_left"], "ring": 0})",
     "/output/measures",
     "pin one whole side",
     {R"(--set '/pins/vertices=["left"]' --set /mesh/cells=12)"}},
    {small + R"("initial": {"folds": 3, "fold_gap": 1})",
     "/initial/fold_gap",
     "use fewer folds or a smaller gap",
     {"--set /initial/fold_gap=0.01", "--set /initial/folds=0"}},
    {small + R"("initial": {"file": "roof.obj"})",
     "/initial/file",
     "has 6 points and 4 triangles, but the rest mesh has 25 and 32",
     {"--set /initial/file=null", R"(--set '/mesh={"file":"roof.obj"}')"}},
    {small + R"("initial": {"file": "roof.obj", "creases": 1})",
     "/initial/creases",
     "cannot be combined with /initial/file",
     {"--set /initial/file=null"}},
    {small + R"("initial": {"after": ["/mesh/generator=sphere"]})",
     "/initial/after",
     "use the same mesh for both runs, or two meshes of one flat sheet",
     {R"(--set '/initial/after=["/mesh/cells=8"]')"}},
    {small + R"("initial": {"after": ["/mesh/width=3", "/mesh/cells=48"]})",
     "/initial/after",
     "give both meshes the same extent",
     {R"(--set '/initial/after=["/duration=0.1"]')"}},
};

}  // namespace

TEST_CASE("set-up: validate refuses the scenes that a run refuses, and the stated remedy works", "[set_up]") {
  Workplace place;
  place.write("roof.obj", roof);
  for (const Refusal& refusal : refusals) {
    INFO(refusal.settings);
    place.write("scene.json", R"({"name": "scene", "duration": 0.02, )" + refusal.settings + "}");
    const int code = place.run("validate scene.json");
    INFO(place.err());
    CHECK((code == 3 || code == 4));
    CHECK_THAT(place.err(), ContainsSubstring(refusal.pointer) && ContainsSubstring(refusal.text));
    const std::string validation = place.err();
    CHECK(place.run("run scene.json") == code);
    CHECK(place.err().find(refusal.text) != std::string::npos);
    for (const std::string& remedy : refusal.remedies) {
      INFO(remedy);
      CHECK(place.run("run scene.json " + remedy) == 0);
      INFO(place.err());
    }
  }
}

TEST_CASE("set-up: for a sweep each reason is printed once, with the number of runs", "[set_up]") {
  Workplace place;
  place.write("roof.obj", roof);
  place.write("sweep.json", R"({"name": "sweep", "duration": 0.02, "mesh": {"file": "roof.obj"},
      "sweep": {"/bending/model": ["adaptive", "crossover", "dihedral"], "/duration": [0.02, 0.04]}})");
  CHECK(place.run("validate --strict sweep.json") == 3);
  CHECK_THAT(place.err(), ContainsSubstring("and 3 more"));  // two models × two durations, less the named run
  const std::string message = place.err();
  CHECK(message.find("flat rest shape only") == message.rfind("flat rest shape only"));
  CHECK_FALSE(std::filesystem::exists(place.folder / "results"));
}

TEST_CASE("set-up: scenes that are too large are built only with --strict, and this is reported",
          "[set_up]") {
  Workplace place;
  // Fitting 165 springs to each of 66 000 vertices needs more than a gigabyte.
  place.write("sweep.json", R"({"name": "sweep", "duration": 0.02, "bending": {"model": "adaptive"},
      "sweep": {"/mesh/cells": [4, 6, 256]}})");
  CHECK(place.run("validate sweep.json") == 0);
  CHECK_THAT(place.err(),
             ContainsSubstring("2 of 3 different scenes checked") && ContainsSubstring("--strict"));
}

}  // namespace bendlab::set_up_test
