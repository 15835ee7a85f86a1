// Effects that a scene does not list, or that cannot act, cost nothing and change nothing.
#include <algorithm>

#include "bendlab/effects/effect.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"
#include "tests/places.hpp"

namespace bendlab::nothing_for_nothing_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using test::Workplace;

const char* const hanging = R"({"name": "hanging", "defaults": "paper",
          "duration": 0.5, "mesh": {"cells": 12},
  "pins": {"vertices": ["upper_right"], "ring": 1}, "effects": [{"type": "gravity"}]})";

std::vector<std::string> pass_names(const nlohmann::json& run) {
  std::vector<std::string> names;
  for (const auto& pass : run["passes"]) names.push_back(pass["name"]);
  return names;
}

}  // namespace

TEST_CASE("without listed effects, a program with all effects gives the same bits as one without",
          "[experiments][effects]") {
  Workplace place;
  place.write("hanging.json", hanging);
  for (const char* precision : {"single", "double"}) {
    const std::string arguments = std::string("run hanging.json --json --set /solver/precision=") + precision;
    REQUIRE(place.run(arguments + " --out full") == 0);
    const nlohmann::json full = place.out_lines().at(0);
    REQUIRE(place.run(arguments + " --out bare", places::bare_program) == 0);
    const nlohmann::json bare = place.out_lines().at(0);
    CHECK(pass_names(full) == pass_names(bare));
    CHECK(pass_names(full) == std::vector<std::string>{"set_up", "gravity", "predict", "strain", "bending",
                                                       "update", "recording"});
    const auto file = [&](const nlohmann::json& run) {
      return place.folder / run["file"].get<std::string>();
    };
    const RunRecord record = read_run(file(full));
    REQUIRE(record.frames == read_run(file(bare)).frames);
    for (std::int64_t frame = 0; frame < static_cast<std::int64_t>(record.frames); ++frame)
      CHECK(read_positions(file(full), frame) == read_positions(file(bare), frame));
    CHECK(full["summary"] == bare["summary"]);
  }
  // The bare program contains no other effect.
  CHECK(place.run("effects --json", places::bare_program) == 0);
  CHECK(nlohmann::json::parse(place.out()).size() == 1);
  CHECK(effects().size() > 1);
}

TEST_CASE("run --minimal leaves out effects that cannot act, and no bit changes", "[experiments][effects]") {
  Workplace place;
  place.write("hanging.json", hanging);
  const std::string with =
      R"(run hanging.json --minimal --json --set '/effects=[{"type": "gravity"},)"
      R"({"type": "rigid_damping", "rate": 0}, {"type": "constraint_damping", "rate": 0}]')";
  REQUIRE(place.run(with) == 0);
  const nlohmann::json run = place.out_lines().at(0);
  CHECK_THAT(run["message"].get<std::string>(),
             ContainsSubstring("left out /effects/1 (rigid_damping), /effects/2 (constraint_damping)"));
  CHECK_THAT(run["message"].get<std::string>(), ContainsSubstring("have the same bits"));
  for (const std::string& name : pass_names(run)) CHECK_FALSE(name.ends_with("damping"));

  // Tethers without a pin have no pass. Gravity acts, so it stays.
  REQUIRE(place.run(R"(run hanging.json --minimal --json --set /pins/vertices=[] --set )"
                    R"('/effects=[{"type": "gravity"}, {"type": "tethers"}]')") == 0);
  const nlohmann::json unpinned = place.out_lines().at(0);
  CHECK_THAT(unpinned["message"].get<std::string>(), ContainsSubstring("left out /effects/1 (tethers);"));
}

TEST_CASE("run --explain states the reason of each pass, and which effects did nothing",
          "[experiments][effects]") {
  Workplace place;
  place.write("hanging.json", hanging);
  REQUIRE(place.run(R"(run hanging.json --explain --set '/effects=[{"type": "gravity"}, )"
                    R"({"type": "tethers", "slack": 100}]')") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("/effects/0"));
  CHECK_THAT(place.out(), ContainsSubstring("/bending/model: adaptive"));
  CHECK_THAT(place.out(), ContainsSubstring("did nothing in this run and can be removed from the config:\n"
                                            "  /effects/1 tethers: ran and changed nothing"));
  CHECK_THAT(place.out(), !ContainsSubstring("/effects/0 gravity:"));
  // Each line of a pass ends in its share of the time. The shares add up to 100 %.
  double sum = 0;
  std::istringstream lines(place.out());
  for (std::string line; std::getline(lines, line);)
    if (line.ends_with(" %")) sum += std::stod(line.substr(line.rfind("  ")));
  CHECK_THAT(sum, Catch::Matchers::WithinAbs(100, 0.5));  // shares are rounded to 0.1
}

TEST_CASE("an effect with nothing to do reports this and has no pass", "[experiments][effects]") {
  // With default settings every effect acts, except moving_pins, which need keyframes, and loads of size 0.
  constexpr std::array<std::string_view, 4> need_settings = {"load", "moment", "moving_pins", "pressure"};
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins pins = make_pins(rest, {0}, 0);
  for (const EffectKind* effect : effects()) {
    INFO(effect->name);
    const bool idle = effect->idle && effect->idle(effect->settings.defaults());
    CHECK(idle == (std::ranges::find(need_settings, effect->name) != need_settings.end()));
    if (idle) CHECK(passes_of<float>(Effect(*effect), {rest, pins, {}}).empty());
  }
}

}  // namespace bendlab::nothing_for_nothing_test
