// The file of a sweep lists its runs, before and after they are computed.
#include "experiments/campaign/sweep_file.hpp"

#include "bendlab/io/run_file.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/references.hpp"
#include "experiments/config/run_config.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::sweep_file_test {
namespace {

using nlohmann::json;
using test::Workplace;

json sweep_in(const Workplace& place, const std::string& file) {
  return json::parse(test::read(place.folder / "results" / file));
}

}  // namespace

TEST_CASE("sweep file: it has every run of the sweep with its place, id and folder", "[campaign]") {
  Workplace place;
  place.write("first.json", R"({"name": "s", "defaults": "paper", "duration": 0.05, "effects": [],
      "sweep": {"/mesh/cells": [2, 3], "/bending/model": ["none", "lod"], "/bending/lod/t": [1, 2]}})");
  REQUIRE(place.run("run first.json") == 0);
  const json sweep = sweep_in(place, "s/first.sweep.json");
  CHECK(sweep["axes"]["/bending/lod/t"] == json({1, 2}));
  CHECK(sweep["models"]["lod"]["label"] == "LOD");
  CHECK(sweep["settings"]["duration"] == 0.05);
  REQUIRE(sweep["runs"].size() == 2 * (1 + 2));  // the model none has no setting t
  CHECK(sweep["runs"][0]["point"] == json({{"/mesh/cells", 2}, {"/bending/model", "none"}}));
  for (const json& run : sweep["runs"]) {
    const auto file = place.folder / "results/s" / run["folder"].get<std::string>() / "run.vtkhdf";
    const RunRecord record = read_run(file);
    CHECK(record.id == run["id"]);
    CHECK(json::parse(record.provenance.at("point")) == run["point"]);
    for (const char* traits : {"models", "methods"})
      CHECK(json::parse(record.provenance.at(traits)) == sweep[traits]);
  }
}

TEST_CASE("sweep file: a trial run with other settings does not replace the file of the written sweep",
          "[campaign]") {
  Workplace place;
  place.write("first.json",
              R"({"name": "s", "defaults": "paper",
          "duration": 0.05, "effects": [], "sweep": {"/mesh/cells": [2, 3]}})");
  REQUIRE(place.run("run first.json") == 0);
  const std::string written = test::read(place.folder / "results/s/first.sweep.json");
  REQUIRE(place.run("run first.json --set /mesh/cells=4") == 0);
  CHECK(test::read(place.folder / "results/s/first.sweep.json") == written);
  CHECK(std::distance(std::filesystem::directory_iterator(place.folder / "results/s"), {}) == 2 + 3);
}

TEST_CASE("sweep file: nothing is created if a file that a config names cannot be read", "[campaign]") {
  Workplace place;
  place.write("sound.json", R"({"name": "s", "defaults": "paper", "duration": 0.05})");
  place.write("ramp.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n");
  const std::string begin = R"({"name": "t", "defaults": "paper", "duration": 0.05, )";
  for (const char* rest :
       {R"("mesh": {"file": "gone.obj"}})", R"("mesh": {"file": "."}})",
        R"("sweep": {"/mesh": [{"cells": 2}, {"file": "ramp.obj"}, {"file": "gone.obj"}]}})",
        R"("effects": [{"type": "mesh_obstacle", "file": "gone.obj"}]})",
        R"("initial": {"after": ["/mesh={\"file\": \"gone.obj\"}"]}})"}) {
    INFO(rest);
    place.write("first.json", begin + rest);
    CHECK(place.run("run sound.json first.json") == 5);
    CHECK_THAT(place.err(), Catch::Matchers::ContainsSubstring("gone.obj") ||
                                Catch::Matchers::ContainsSubstring("is a folder"));
    CHECK_FALSE(std::filesystem::exists(place.folder / "results"));
  }
}

TEST_CASE("run config: data derived from its settings are computed once", "[config]") {
  const RunConfig config = parse_experiment(R"({"name": "s", "defaults": "paper",
          "initial": {"after": ["/duration=2"]}})",
                                            "test")
                               .runs.front();
  int derivations = 0;
  const auto make = [&] {
    ++derivations;
    return std::optional<RunConfig>();
  };
  const RunConfig copy = config;
  CHECK_FALSE(config.derived("one", make));
  CHECK_FALSE(copy.derived("one", make));
  CHECK(derivations == 1);
  CHECK(&copy.scene() == &config.scene());
  CHECK(run_before(config)->scene().duration == 2);

  const auto fail = [&]() -> std::optional<RunConfig> {
    ++derivations;
    throw ConfigError("it", {{"/a", "is wrong"}});
  };
  for (int again = 0; again < 2; ++again) CHECK_THROWS_AS(config.derived("two", fail), ConfigError);
  CHECK(derivations == 2);
}

TEST_CASE("run config: unknown settings of another version are refused, and the message names them",
          "[config]") {
  Json resolved = parse_experiment(R"({"name": "s", "defaults": "paper"})", "test").runs.front().resolved();
  CHECK_NOTHROW(stored_run(resolved));
  resolved["solver"]["order"] = "by_colour";
  CHECK_THROWS_WITH(stored_run(resolved), Catch::Matchers::ContainsSubstring("order"));
  resolved = parse_experiment(R"({"name": "s", "defaults": "paper"})", "test").runs.front().resolved();
  resolved["effects"][0]["type"] = "levity";
  CHECK_THROWS_WITH(stored_run(resolved), Catch::Matchers::ContainsSubstring("levity"));
}

}  // namespace bendlab::sweep_file_test
