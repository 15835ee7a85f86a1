// Advice on settings: its parts on made-up numbers, and what it promises on small scenes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "experiments/advise/demand.hpp"
#include "experiments/advise/fit.hpp"
#include "experiments/advise/front.hpp"
#include "experiments/advise/search.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

using namespace bendlab;
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;
using nlohmann::json;

namespace {

Rated rated(const std::string& model, double error, double cpu_s) {
  return {{model}, error, cpu_s};
}

std::string models_of(const std::vector<Rated>& points) {
  std::string models;
  for (const Rated& point : points) models += point.setting.model;
  return models;
}

// A machine that was made up: error and time of every setting are known.
struct Imaginary {
  std::function<std::optional<double>(const Setting&)> error;
  std::function<double(const Setting&)> cpu_s;

  // Measures what the search asks for, the cheapest at a time, while it costs at most `most`.
  int run(Search& search, double most = 1e9) const {
    int runs = 0;
    for (auto next = search.next(); !next.empty() && next.front().cpu_s.value_or(0) <= most;
         next = search.next()) {
      const Setting& setting = next.front().setting;
      search.add(setting, error(setting), cpu_s(setting));
      REQUIRE(++runs < 2000);
    }
    return runs;
  }
};

// Two models that converge with the square of the substeps, one of them to a cloth that is off by 3 %; iterations help
// as their root; single precision rounds the finest settings off; a, the better one, costs twice as much.
const Imaginary machine{.error = [](const Setting& s) -> std::optional<double> {
                          const double solved =
                              std::min(0.5, 2 / std::pow(s.substeps, 2) / std::sqrt(s.iterations));
                          const double rounded = s.double_precision ? 0 : 1e-8 * s.substeps * s.substeps;
                          return solved + rounded + (s.model == "b" ? 0.03 : 0);
                        },
                        .cpu_s =
                            [](const Setting& s) {
                              return (s.model == "a" ? 2e-4 : 1e-4) * s.substeps *
                                     (0.3 + 0.7 * s.iterations) * (s.double_precision ? 2 : 1);
                            }};

// The best of all settings with substeps that are powers of two.
std::vector<Rated> everything() {
  std::vector<Rated> points;
  for (const char* model : {"a", "b"})
    for (int substeps = 1; substeps <= 256; substeps *= 2)
      for (const int iterations : {1, 2, 4, 10})
        for (const bool precise : {false, true}) {
          const Setting setting{model, substeps, iterations, precise};
          points.push_back({setting, *machine.error(setting), machine.cpu_s(setting)});
        }
  return points;
}

const char* cantilever = R"({
  "name": "strip", "duration": 2,
  "mesh": {"generator": "equilateral", "width": 0.23335, "height": 0.12, "rows": "perpendicular", "cells": 10},
  "pins": {"vertices": ["left"], "ring": 0, "distance": 0.0338},
  "material": {"strain": {"stiffness": "compliance", "compliance": 1e-5}},
  "bending": {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 0.0015696},
  "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 4}],
  "solver": {"iterations": 1, "sweep": "symmetric"},
  "expect": [{"metric": "drop", "max": 1, "why": "kept"},
             {"metric": "drop", "max": 1, "why": "of another model", "where": {"/bending/model": "dihedral"}}]
})";

const char* curtain = R"({
  "name": "curtain", "duration": 3,
  "mesh": {"width": 0.5, "height": 0.5, "cells": 12, "diagonal": "alternating"},
  "pins": {"vertices": ["upper_left", "upper_right"], "ring": 0},
  "bending": {"stiffness": "physical", "flexural_rigidity": 1e-4, "at_curvature": 10},
  "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 2}],
  "initial": {"perturbation": 1e-4}
})";

// One object, of a call that has to work.
json advice(Workplace& place, const std::string& arguments) {
  INFO(arguments);
  const int code = place.run("advise " + arguments + " --json");
  INFO(place.err());
  REQUIRE(code == 0);
  return place.out_lines().at(0);
}

// The error of the written config's run, compared with what the advice was compared with.
double error_of_written(Workplace& place, const std::string& file, const json& advice) {
  place.write("accuracy", advice.at("accuracy").dump());
  const int code = place.run("run " + file + " --json --set /accuracy=\"$(cat accuracy)\"");
  INFO(place.err());
  REQUIRE(code == 0);
  return place.out_lines().at(0).at("summary").at("error_physical_rms");
}

void check_promise(Workplace& place, const std::string& config, const std::string& demand) {
  INFO(config << " " << demand);
  const json told = advice(place, config + " " + demand + " --write best.json");
  const json& best = told.at("advice");
  REQUIRE(best.at("predicted") == false);
  CHECK(error_of_written(place, "best.json", told) == best.at("error").get<double>());  // the same bits
  const json written = json::parse(bendlab::test::read(place.folder / "best.json"));
  CHECK_FALSE(written.contains("accuracy"));
  CHECK(written.at("bending").at("model") == best.at("model"));
}

// Looser first: what is asked for leaves ever less error.
void check_order(Workplace& place, const std::string& config, const std::vector<std::string>& demands) {
  double error = 1e9;
  for (const std::string& demand : demands) {
    const json best = advice(place, config + " " + demand).at("advice");
    INFO(config << " " << demand << ": " << best.dump());
    CHECK(best.at("error").get<double>() <= error);
    error = best.at("error");
  }
}

}  // namespace

TEST_CASE("advise: demands are shares and times with their units", "[advise]") {
  CHECK_THAT(parse_error("5%"), WithinRel(0.05, 1e-15));
  CHECK_THAT(parse_error("0.05"), WithinRel(0.05, 1e-15));
  CHECK_THAT(parse_error("2.5 %"), WithinRel(0.025, 1e-15));
  for (const char* wrong : {"5", "0", "-1%", "100%", "nan", "", "%", "5ms"})
    CHECK_THROWS_WITH(parse_error(wrong), ContainsSubstring("5% or 0.05"));
  CHECK(percent_text(0.0512) == "5.1 %");
  CHECK(percent_text(0.9999) == "100 %");
  CHECK(percent_text(5.99) == "599 %");
  CHECK_THAT(parse_duration("2ms"), WithinRel(0.002, 1e-15));
  CHECK_THAT(parse_duration("0.002s"), WithinRel(0.002, 1e-15));
  CHECK_THAT(parse_duration("500 us"), WithinRel(5e-4, 1e-15));
  CHECK_THAT(parse_duration("2min"), WithinRel(120.0, 1e-15));
  for (const char* wrong : {"2", "0ms", "-2ms", "inf s", "", "ms", "2 %"})
    CHECK_THROWS_WITH(parse_duration(wrong), ContainsSubstring("2ms or 0.002s"));
}

TEST_CASE("advise: the front has what nothing beats in both, and the choice is on it", "[advise]") {
  const std::vector<Rated> points = {rated("a", 0.1, 3),  rated("b", 0.2, 1), rated("c", 0.2, 2),
                                     rated("d", 0.05, 9), rated("e", 0.1, 3), rated("f", 0.06, 9)};
  CHECK(models_of(front_of(points)) == "bad");
  CHECK(front_of({}).empty());
  CHECK(models_of(thinned(std::vector{rated("a", 1, 1), rated("b", 0.95, 2), rated("c", 0.9, 3),
                                      rated("d", 0.85, 4)})) == "acd");
  CHECK(thinned({}).empty());
  CHECK(chosen(points, {.error = 0.1})->setting.model == "a");
  CHECK(chosen(points, {.error = 0.0999})->setting.model == "d");
  CHECK_FALSE(chosen(points, {.error = 0.01}));
  CHECK(nearest(points, {.error = 0.01})->setting.model == "d");
  CHECK(chosen(points, {.cpu_s = 8})->setting.model == "a");
  CHECK(chosen(points, {.cpu_s = 2})->setting.model == "b");
  CHECK_FALSE(chosen(points, {.cpu_s = 0.5}));
  CHECK(nearest(points, {.cpu_s = 0.5})->setting.model == "b");
}

TEST_CASE("advise: a power law is found, and nothing where there is none", "[advise]") {
  const auto fit = [](const std::vector<double>& errors) {
    std::vector<Worked> points;
    for (std::size_t i = 0; i < errors.size(); ++i) points.push_back({std::pow(2, i), errors[i]});
    return fit_power_law(points);
  };
  const auto law = fit({3, 3 / std::pow(2, 1.5), 3 / 8.0});  // 3 work^-1.5
  REQUIRE(law);
  CHECK_THAT(law->exponent, WithinRel(1.5, 1e-12));
  CHECK_THAT(law->at(16), WithinRel(3 / 64.0, 1e-12));

  // At last it halved no more: 0.1, 0.05, 0.04 go on by 0.8 for each doubling.
  CHECK_THAT(fit({0.1, 0.05, 0.04})->at(16), WithinRel(0.04 * 0.8 * 0.8, 1e-12));
  CHECK_FALSE(fit({0.1, 0.05}));
  CHECK_FALSE(fit({0.1, 0.05, 0.06}));
  CHECK_FALSE(fit({0.1, 0.05, 0}));
  CHECK_FALSE(fit({1, 0.01, 0.009}));  // residuals of ln: 0.75, -1.5, 0.75
}

TEST_CASE("advise: what a step costs is told apart into substeps and iterations", "[advise]") {
  const double a = 2e-4, b = 5e-4;
  const auto time = [&](int substeps, int iterations) {
    return Timed{substeps, iterations, substeps * (a + b * iterations)};
  };
  const auto cost = fit_step_cost(std::vector{time(1, 1), time(4, 2), time(8, 10)});
  REQUIRE(cost);
  CHECK_THAT(cost->per_substep, WithinRel(a, 1e-9));
  CHECK_THAT(cost->per_iteration, WithinRel(b, 1e-9));
  CHECK_THAT(fit_step_cost(std::vector{time(2, 4), time(4, 4)})->at(8, 4), WithinRel(8 * (a + 4 * b), 1e-9));
  CHECK_THAT(fit_step_cost(std::vector{Timed{1, 1, 1e-3}, Timed{1, 2, 0.5e-3}})->at(2, 1),
             WithinRel(1.5e-3, 1e-9));
  CHECK_FALSE(fit_step_cost({}));
}

TEST_CASE("advise: the search finds what trying everything finds, in fewer runs", "[advise]") {
  for (const double error : {0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.001}) {
    INFO("error " << error);
    Search search({"a", "b"}, {.error = error}, {});
    CHECK(machine.run(search) < 40);  // of 144
    const auto found = chosen(search.measured(), {.error = error}),
               best = chosen(everything(), {.error = error});
    REQUIRE(found);
    CHECK(found->cpu_s <= best->cpu_s);
  }
  for (const double cpu_s : {2e-4, 1e-3, 2.5e-3, 0.01, 0.04}) {
    INFO("time " << cpu_s);
    Search search({"a", "b"}, {.cpu_s = cpu_s}, {});
    machine.run(search);
    const auto found = chosen(search.measured(), {.cpu_s = cpu_s}),
               best = chosen(everything(), {.cpu_s = cpu_s});
    REQUIRE(found);
    CHECK(found->error <= best->error);
    for (const Rated& point : search.measured())
      CHECK(point.cpu_s <= cpu_s * 1.001 + 1e-9 + 4e-4);  // but the first
  }
}

TEST_CASE("advise: what takes too long is predicted from a law, and only there", "[advise]") {
  Search search({"a", "b"}, {.error = 0.001}, {});
  machine.run(search, 2e-4 * 16);  // a: up to 16 substeps
  for (const Rated& point : search.predicted()) {
    INFO(setting_text(point.setting));
    CHECK(point.predicted);
    CHECK_THAT(point.cpu_s, WithinRel(machine.cpu_s(point.setting), 1e-9));
    const double right = *machine.error(point.setting);
    if (point.setting.model == "a") {  // allows for a law that ends
      CHECK(point.error > right);
      CHECK(point.error < 1.5 * right);
    } else {
      CHECK(point.error > 0.01);  // not on towards 0 by a law that did end
    }
  }
  // Truly 2 / 48² = 0.00087 already; with √√3 of allowance 0.0012.
  CHECK(chosen(search.predicted(), {.error = 0.001})->setting.substeps == 64);

  Search known_to({"a"}, {.error = 0.001}, {.least_error = 0.005});
  machine.run(known_to, 2e-4 * 16);
  CHECK_FALSE(chosen(known_to.predicted(), {.error = 0.0049}));

  Search two({"a"}, {.error = 0.001}, {});
  machine.run(two, 2e-4 * 2);
  CHECK(two.predicted().empty());
}

TEST_CASE("advise: a model that fails is left, and one that diverges is tried finer", "[advise]") {
  Search search({"a", "b"}, {.error = 0.02}, {});
  search.drop("b");
  Imaginary late = machine;
  late.error = [](const Setting& s) { return s.substeps < 8 ? std::nullopt : machine.error(s); };
  late.run(search);
  const auto found = chosen(search.measured(), {.error = 0.02});
  REQUIRE(found);
  CHECK(found->setting == Setting{"a", 12});  // 2 / 12² = 0.014, 2 / 8² = 0.031
}

TEST_CASE("advise: a cantilever's advice is what a run of it gives", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  check_promise(place, "strip.json", "--error 5%");
  CHECK(json::parse(bendlab::test::read(place.folder / "best.json")).at("expect").size() == 1);
  check_promise(place, "strip.json", "--budget 0.1ms");
  check_order(place, "strip.json", {"--error 20%", "--error 8%", "--error 3%", "--error 0.01"});
  CHECK(advice(place, "strip.json --error 8%").at("computed_runs") == 0);
}

TEST_CASE("advise: a curtain's advice is what a run of it gives", "[advise]") {
  Workplace place;
  place.write("curtain.json", curtain);
  check_promise(place, "curtain.json", "--error 6%");
  check_order(place, "curtain.json", {"--budget 0.15ms", "--budget 0.3ms"});
}

TEST_CASE("advise: a motion is compared over time with its own refinement", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  const json told =
      advice(place, "strip.json --error 10% --what motion --models dihedral --set /duration=0.3");
  CHECK(told.at("error_of") == "motion");
  CHECK(told.at("accuracy").at("over_time") == true);
  CHECK(told.at("reference_gap").get<double>() < 0.1);
  CHECK(told.at("advice").at("model") == "dihedral");
  // What swings freely has a motion only.
  CHECK(
      advice(
          place,
          R"(strip.json --error 20% --models dihedral --set /duration=0.2 --set '/effects=[{"type":"gravity"}]')")
          .at("error_of") == "motion");
}

TEST_CASE("advise: what cannot be advised on is refused with what to write", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  const auto refused = [&](const std::string& arguments, int code, const std::string& text) {
    INFO(arguments);
    CHECK(place.run("advise " + arguments) == code);
    CHECK_THAT(place.err(), ContainsSubstring(text));
  };
  refused("strip.json", 2, "--error 5%");
  refused("strip.json --error 5% --budget 2ms", 2, "one of --error");
  refused("strip.json --error 5", 2, "5% or 0.05");
  refused("strip.json --budget 2", 2, "2ms or 0.002s");
  refused("strip.json --error 5% --models dihedrall", 2, "did you mean 'dihedral'");
  refused("strip.json --error 5% --set '/bending={\"k\":0.5}'", 3, "/bending/stiffness");
  refused("strip.json --error 5% --set '/bending={\"k\":0.5}'", 3, "\"flexural_rigidity\": B");
  refused("strip.json --error 5% --set /mesh/cells=[8,16]", 2 + 1, "/mesh/cells");
  refused("strip.json --error 5% --models lod", 3, "at_curvature");
  refused("strip.json --error 5% --set '/accuracy={\"solver\":[\"/solver/substeps=64\"]}'", 3,
          "/accuracy/physical");
  refused("nothing.json --error 5%", 3, "cannot be read");
  refused("strip.json --error 5% --set '/sweep={\"/mesh/cells\":[8],\"/solver/dt\":[0.01,0.02]}'", 3,
          "--set /solver/dt=VALUE");
  refused(
      R"(strip.json --error 5% --set '/bending={"model":"none","stiffness":"physical","quartic_coefficient":1e-8}')",
      3, "/bending/model");
  refused("strip.json --error 5% --write strip.json", 2, "the config itself");
  refused("strip.json --error 5% --write nowhere/best.json", 2, "does not exist");
  refused("strip.json --error 5% --write .", 2, "is a folder");
  CHECK(place.run_files(".vtkhdf").empty());

  // Nothing is that accurate: said, with what comes nearest, and nothing is written.
  CHECK(place.run("advise strip.json --error 0.01% --models none --write best.json") == 1);
  CHECK_THAT(place.out(), ContainsSubstring("no setting meets"));
  CHECK_FALSE(std::filesystem::exists(place.folder / "best.json"));
  CHECK_THAT(place.err(), ContainsSubstring("best.json is not written"));
}

TEST_CASE("advise: a cloth that has not come to rest is noticed, and one that nothing holds has a motion",
          "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  CHECK(place.run("advise strip.json --error 20% --models none --set /duration=0.1") == 1);
  CHECK_THAT(place.out(), ContainsSubstring("still moves at the end of /duration"));
  CHECK(advice(place, "strip.json --error 50% --models dihedral").at("still_moving").get<double>() < 0.02);
  CHECK(advice(place, "strip.json --error 50% --models dihedral --set /duration=0.1 --set /pins/vertices=[]")
            .at("error_of") == "motion");
}

TEST_CASE("advise: a config written elsewhere finds its files, those of other meshes too", "[advise]") {
  Workplace place;
  std::filesystem::create_directories(place.folder / "other");
  for (const char* file : {"sheet.obj", "coarse.obj"})
    place.write(file, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  place.write("sheet.json",
              R"({"name": "sheet", "duration": 0.5, "mesh": {"file": "sheet.obj"}, "pins": {"indices": [3]},
    "bending": {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 1e-4},
    "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 4}],
    "initial": {"after": ["/mesh/file=coarse.obj", "/duration=0.1"]}})");
  place.run("advise sheet.json --error 90% --models dihedral --write other/best.json");
  REQUIRE(std::filesystem::exists(place.folder / "other/best.json"));
  const json written = json::parse(bendlab::test::read(place.folder / "other/best.json"));
  CHECK(written.at("mesh").at("file") == "../sheet.obj");
  CHECK(written.at("initial").at("after") == json{"/mesh/file=\"../coarse.obj\"", "/duration=0.1"});
  CHECK(place.run("validate other/best.json") == 0);
  CHECK(place.run("run other/best.json") == 0);
}
