// A run that is stopped and continued gives the same bits as a run without a stop.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>

#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/settings/archive.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/plausibility.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/io/run_fixture.hpp"

namespace bendlab::resume_test {
using bendlab::test::TemporaryFolder;
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using nlohmann::json;

namespace {

const TemporaryFolder& obstacles() {
  static const TemporaryFolder folder;
  static const bool written = [] {
    std::ofstream(folder / "pyramid.obj")
        << "v -0.3 -0.3 -0.4\nv 0.3 -0.3 -0.4\nv 0.3 0.3 -0.4\nv -0.3 0.3 -0.4\nv 0 0 -0.05\n"
           "f 3 2 1\nf 4 3 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    return true;
  }();
  static_cast<void>(written);
  return folder;
}

// An effect with settings such that it acts, within a second, on a sheet that falls or swings from its upper
// edge.
json example_of(std::string_view effect) {
  const std::map<std::string_view, json> settings = {
      {"sphere", {{"centre", {0, 0, -0.15}}, {"radius", 0.1}}},
      {"plane", {{"point", {0, 0, -0.1}}}},
      {"capsule", {{"a", {-0.5, 0, -0.15}}, {"b", {0.5, 0, -0.15}}, {"radius", 0.1}}},
      {"disc", {{"centre", {0, 0, -0.1}}, {"radius", 0.3}}},
      {"mesh_obstacle", {{"file", "pyramid.obj"}}},
      {"self_collision", {{"thickness", 0.02}}},
      {"moving_pins", {{"times", {0, 1}}, {"offsets", {0, 0, 0, 0.2, 0.1, -0.3}}}},
      {"wind", {{"velocity", {1, 2, 0.5}}, {"gust_amplitude", 2}}}};
  const auto entry = settings.find(effect);
  json example = entry == settings.end() ? json::object() : entry->second;
  example["type"] = effect;
  return example;
}

RunConfig config_of(const json& settings) {
  json document = settings;
  document["name"] = "resumed";
  if (document.contains("effects"))
    for (json& effect : document["effects"])
      if (effect.contains("file")) effect["file"] = (obstacles() / effect["file"]).string();
  return parse_experiment(document.dump(), "test").runs.front();
}

// Steps a simulation of the config. After the step `stop` a new simulation reads the archive of the first and
// continues.
struct Steps {
  BuiltScene scene;
  std::unique_ptr<Simulation> simulation;

  Steps(const RunConfig& config, int steps, int stop) : scene(build_scene(config.scene())) {
    simulation = simulation_of(scene);
    for (int step = 0; step < steps; ++step) {
      if (step == stop) {
        Archive written;
        simulation->archive(written);
        simulation = simulation_of(scene);
        Archive read(written.bytes());
        simulation->archive(read);
        REQUIRE(read.at_end());
      }
      REQUIRE(simulation->step());
    }
  }
};

void check_same(const RunConfig& config, int steps = 40) {
  const Steps whole(config, steps, -1), stopped(config, steps, steps / 2);
  CHECK(whole.simulation->time() == stopped.simulation->time());
  CHECK(whole.simulation->positions() == stopped.simulation->positions());
  CHECK(whole.simulation->velocities() == stopped.simulation->velocities());
  CHECK(whole.simulation->substeps() == stopped.simulation->substeps());
  CHECK(whole.simulation->settled() == stopped.simulation->settled());
  CHECK(whole.simulation->unbalanced() == stopped.simulation->unbalanced());
  for (std::size_t p = 0; p < whole.simulation->passes().size(); ++p) {
    CHECK(whole.simulation->passes()[p].calls == stopped.simulation->passes()[p].calls);
    CHECK(whole.simulation->passes()[p].acted == stopped.simulation->passes()[p].acted);
  }
}

}  // namespace

TEST_CASE("resume: with every effect, a continued simulation gives the same bits", "[resume]") {
  for (const EffectKind* effect : effects())
    for (const char* precision : {"single", "double"}) {
      CAPTURE(effect->name, precision);
      json effects = json::array({{{"type", "gravity"}}});
      if (effect->name != "gravity") effects.push_back(example_of(effect->name));
      if (effect->name == "friction") effects.push_back(example_of("sphere"));
      const bool pinned = effect->name == "moving_pins" || effect->name == "tethers";
      check_same(config_of({{"mesh", {{"cells", 8}}},
                            {"pins", {{"vertices", pinned ? json{"top"} : json::array()}}},
                            {"initial", {{"perturbation", 1e-3}}},
                            {"effects", effects},
                            {"solver", {{"precision", precision}, {"substeps", 2}}}}));
    }
}

TEST_CASE("resume: with every method, a continued simulation gives the same bits", "[resume]") {
  for (const MethodKind* method : methods()) {
    CAPTURE(method->name);
    check_same(
        config_of({{"mesh", {{"cells", 8}}},
                   {"effects", {{{"type", "gravity"}}}},
                   {"bending", {{"model", "crossover"}, {"stiffness", "compliance"}, {"compliance", 1.0}}},
                   {"material", {{"strain", {{"stiffness", "compliance"}, {"compliance", 1e-2}}}}},
                   {"solver", {{"method", method->name}, {"substeps", method->has_motion ? 8 : 1}}}}));
  }
  for (const char* option : {R"({"flight_limit": 0.02})", R"({"sweep": "symmetric", "threads": 2})",
                             R"({"order": "pins", "precision": "single"})"}) {
    CAPTURE(option);
    check_same(config_of({{"mesh", {{"cells", 8}}}, {"solver", json::parse(option)}}));
  }
}

TEST_CASE("resume: every measure of a continued run gives the same metrics", "[resume]") {
  json names = json::array();
  for (const Measure* measure : measures())
    if (!measure->applies) names.push_back(measure->name);
  const RunConfig config = config_of({{"mesh", {{"cells", 8}, {"width", 0.4}, {"height", 0.2}}},
                                      {"pins", {{"vertices", {"left"}}, {"ring", 1}}},
                                      {"duration", 1},
                                      {"output", {{"measures", names}}}});
  const auto summary = [&](int stop) {
    BuiltScene scene = build_scene(config.scene());
    auto simulation = simulation_of(scene);
    auto recorder = std::make_unique<Recorder>(config, scene);
    Plausibility plausibility(scene);
    std::vector<Frame> frames;
    for (int step = 0; step <= 60; ++step) {
      if (step > 0) REQUIRE(simulation->step());
      const bool recorded = step % 2 == 0;
      recorder->step(*simulation, {step == 0, recorded, step == 60});
      if (recorded) {
        frames.push_back(recorder->capture(*simulation));
        recorder->complete(frames.back(), plausibility);
      }
      if (step != stop) continue;
      // The run file provides the values of earlier frames. Here they are computed again.
      Archive written;
      recorder->archive(written);
      auto next = std::make_unique<Recorder>(config, scene);
      Plausibility beside(scene);
      for (Frame frame : frames) next->complete(frame, beside);
      Archive read(written.bytes());
      next->archive(read);
      REQUIRE(read.at_end());
      recorder = std::move(next);
    }
    const FrameHistory history = recorder->history();
    const std::string id = "id";
    const RunEnd end{RunStatus::complete, id, *simulation, history, {}};
    return recorder->findings(end, false).summary;
  };
  const auto whole = summary(-1), stopped = summary(31);
  CHECK(whole.size() > 30);
  CHECK(whole.size() == stopped.size());
  for (const auto& [name, value] : whole) {
    CAPTURE(name);
    CHECK(((std::isnan(value) && std::isnan(stopped.at(name))) || value == stopped.at(name)));
  }
}

TEST_CASE("resume: a stopped run continues where it was stopped", "[resume]") {
  Workplace place;
  place.write("a.json", R"({"name": "a", "mesh": {"cells": 40}, "duration": 60})");
  CHECK(place.run_and_signal("a.json", SIGTERM) == 143);
  CHECK_THAT(place.err(), ContainsSubstring("to continue"));
  REQUIRE(place.run_files(".checkpoint").size() == 1);
  REQUIRE(place.run("run a.json --json --set /duration=60") == 0);
  const json run = place.out_lines().at(0);
  CHECK(run.at("reused") == false);
  CHECK(place.run_files(".checkpoint").empty());
  CHECK(place.run_files(".part").empty());
  CHECK(place.run("show " + run.at("id").get<std::string>()) == 0);
  CHECK_THAT(place.out(), ContainsSubstring("went_on_at"));
}

TEST_CASE("resume: a damaged checkpoint, or a checkpoint of another run, is not used", "[resume]") {
  for (const char* damage : {"", "garbage", "bendlab checkpoint"}) {
    Workplace place;
    place.write("a.json", R"({"name": "a", "mesh": {"cells": 20}, "duration": 10})");
    CHECK(place.run_and_signal("a.json", SIGTERM) == 143);
    for (const auto& file : place.run_files(".checkpoint")) std::ofstream(file) << damage;
    REQUIRE(place.run("run a.json --json") == 0);
    CHECK(place.run("show " + place.out_lines().at(0).at("id").get<std::string>()) == 0);
    CHECK_THAT(place.out(), !ContainsSubstring("went_on_at"));
  }
}

TEST_CASE("resume: a run whose earlier frames are useless reports that it starts again", "[resume]") {
  Workplace place;
  place.write("a.json", R"({"name": "a", "mesh": {"cells": 20}, "duration": 10})");
  CHECK(place.run_and_signal("a.json", SIGTERM) == 143);
  const auto files = place.run_files(".vtkhdf");
  REQUIRE(files.size() == 1);
  // Like after a crash that left half of the file.
  std::filesystem::resize_file(files[0], std::filesystem::file_size(files[0]) / 2);
  std::filesystem::rename(files[0], files[0].string() + ".0123.part");
  REQUIRE(place.run("run a.json --json") == 0);
  CHECK_THAT(place.err(), ContainsSubstring("began again from its start"));
}

}  // namespace bendlab::resume_test
