// Advice on settings: its parts on made-up numbers, and what it promises on small scenes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "experiments/advise/demand.hpp"
#include "experiments/advise/fit.hpp"
#include "experiments/advise/fitness.hpp"
#include "experiments/advise/front.hpp"
#include "experiments/advise/ladder.hpp"
#include "experiments/advise/reasons.hpp"
#include "experiments/advise/search.hpp"
#include "experiments/advise/variant.hpp"
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

// With more strain than its reference has, and its longest triangle over that of the reference.
Rated stretched(const std::string& model, double error, double cpu_s, double strain, double stretch = 1) {
  return {{model}, error, cpu_s, false, {strain, stretch}};
}

const std::vector<Setting> model_a = {Setting{"a"}}, models_a_and_b = {Setting{"a"}, Setting{"b"}};

constexpr double not_compared = std::numeric_limits<double>::infinity();

std::string models_of(const std::vector<Rated>& points) {
  std::string models;
  for (const Rated& point : points) models += point.setting.model;
  return models;
}

// A machine that was made up: error and time of every setting are known.
struct Imaginary {
  std::function<std::optional<double>(const Setting&)> error;
  std::function<double(const Setting&)> cpu_s;
  std::function<Strained(const Setting&)> strained = [](const Setting&) { return Strained{}; };

  // Measures what the search asks for, the cheapest at a time, while it costs at most `most`.
  int run(Search& search, double most = 1e9) const {
    int runs = 0;
    for (auto next = search.next(); !next.empty() && next.front().cpu_s.value_or(0) <= most;
         next = search.next()) {
      const Setting& setting = next.front().setting;
      search.add(setting, error(setting), cpu_s(setting), strained(setting));
      REQUIRE(++runs < 2000);
    }
    return runs;
  }
};

// Two models that converge with the square of the substeps, one of them to a cloth that is off by 3 %;
// iterations help as their root; single precision rounds the finest settings off; a, the better one, costs
// twice as much.
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
  "mesh": {"generator": "equilateral", "width": 0.23335, "height": 0.12, "rows": "perpendicular",
           "cells": 10},
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

json check_promise(Workplace& place, const std::string& config, const std::string& demand) {
  INFO(config << " " << demand);
  const json told = advice(place, config + " " + demand + " --write best.json");
  const json best = told.at("advice");
  REQUIRE(best.at("predicted") == false);
  CHECK(error_of_written(place, "best.json", told) == best.at("error").get<double>());  // the same bits
  const json written = json::parse(bendlab::test::read(place.folder / "best.json"));
  CHECK_FALSE(written.contains("accuracy"));
  CHECK(written.at("bending").at("model") == best.at("model"));
  return best;
}

// Looser first: what is asked for leaves ever less error. In one method: where several reach the same pose in
// the same time, noise chooses between them.
void check_order(Workplace& place, const std::string& config, const std::vector<std::string>& demands) {
  double error = 1e9;
  for (const std::string& demand : demands) {
    const json best = advice(place, config + " --methods pbd " + demand).at("advice");
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

TEST_CASE("advise: what is fit, and by how much another is not", "[advise]") {
  CHECK(unfit(0.2, {0.1, 1.5}) == Unfit::no);
  CHECK(unfit(0.21, {}) == Unfit::error);
  CHECK(unfit(not_compared, {}) == Unfit::error);
  CHECK(unfit(0.01, {0.11, 1}) == Unfit::strain);
  CHECK(unfit(0.01, {0, 1.6}) == Unfit::stretch);
  CHECK(unfit(0.01, {0, 1, true}) == Unfit::implausible);
  CHECK(unfit(std::nan(""), {}) == Unfit::error);
  CHECK(unfit(0.01, {std::nan(""), 1}) == Unfit::strain);
  // The first of several.
  CHECK(unfit(1, {1, 9}) == Unfit::strain);
  CHECK_THAT(beyond_limits(0.1, {0.05, 1.25}), WithinRel(0.5, 1e-12));
  CHECK_THAT(beyond_limits(1.89, {0.2, 1}), WithinRel(1.89 / 0.2, 1e-12));
  CHECK_THAT(beyond_limits(not_compared, {0.3, 1.5}), WithinRel(3.0, 1e-12));
}

TEST_CASE("advise: nothing unfit is chosen, or hides what is fit", "[advise]") {
  // a to d are as fast and as accurate as one could wish, and ruins.
  const std::vector<Rated> points = {
      stretched("a", 1.89, 1, 30000),       stretched("b", 0.01, 1, 0.5), stretched("c", 0.02, 2, 0, 2.6),
      stretched("d", not_compared, 2, 0.3), rated("e", 0.15, 5),          rated("f", 0.04, 9),
      stretched("g", 0.01, 10, 0.2)};
  CHECK(models_of(fit_ones(points)) == "ef");
  CHECK(models_of(front_of(points)) == "ef");
  CHECK(models_of(unfit_front_of(points)) == "bcd");  // 5, 3.2 and 3 times beyond; g is slower than e
  CHECK(chosen(points, {.error = 0.05})->setting.model == "f");
  CHECK(chosen(points, {.error = 0.9})->setting.model == "e");
  CHECK(chosen(points, {.cpu_s = 20})->setting.model == "f");
  CHECK_FALSE(chosen(points, {.cpu_s = 4}));  // four are that fast
  CHECK_FALSE(chosen(points, {.error = 0.02}));
  CHECK(nearest(points, {.error = 0.02})->setting.model == "f");
  CHECK(nearest(points, {.cpu_s = 4})->setting.model == "e");

  const std::vector<Rated> ruins(points.begin(), points.begin() + 4);
  CHECK(front_of(ruins).empty());
  CHECK_FALSE(chosen(ruins, {.error = 0.99}));
  CHECK_FALSE(chosen(ruins, {.cpu_s = 100}));
  CHECK(nearest(ruins, {.error = 0.05})->setting.model == "d");
  CHECK(nearest(ruins, {.cpu_s = 1.5})->setting.model == "b");  // of those within the time
  CHECK(nearest(ruins, {.cpu_s = 0.5})->setting.model == "d");  // none is
}

TEST_CASE("advise: the reasons why nothing is advised", "[advise]") {
  const auto told = [](const Advice& advice, const Demand& demand) {
    std::string text;
    for (const std::string& sentence : why_none(advice, demand, 40)) text += sentence + "\n";
    return text;
  };
  const auto of = [](std::vector<Rated> points) {
    Advice advice;
    advice.points = std::move(points);
    advice.front = front_of(advice.points);
    return advice;
  };
  Advice ruins = of({stretched("a", 1.89, 1, 30000), stretched("b", 0.01, 1, 0.5), rated("c", 0.3, 3)});
  CHECK_FALSE(anything_fit(ruins));
  CHECK_THAT(told(ruins, {.error = 0.05}),
             ContainsSubstring("Of 3 settings run, 2 stretched the cloth by more than 10 % (rms; the "
                               "least: 50 %); 1 had more than 20 % of error (the least: 30 %)."));
  CHECK_THAT(told(ruins, {.error = 0.05}), !ContainsSubstring("time limit"));
  ruins.out_of_time = true;
  CHECK_THAT(told(ruins, {.error = 0.05}), ContainsSubstring("The time limit (40 s) ended"));

  const Advice budget = of({stretched("a", 0.1, 1, 0, 2.5), rated("b", 0.1, 3)});
  CHECK(anything_fit(budget));
  CHECK_THAT(
      told(budget, {.cpu_s = 2}),
      ContainsSubstring("Nothing fit was found within that time") &&
          ContainsSubstring("1 stretched a triangle to more than 1.5 times its length (the least: 2.5)"));
  CHECK_THAT(told(budget, {.cpu_s = 0.5}), ContainsSubstring("the fastest setting takes 1e+03 ms"));

  Advice chaotic = of({rated("a", 0.1, 1)});
  chaotic.reference_gap = 685;
  CHECK_FALSE(anything_fit(chaotic));
  CHECK_THAT(told(chaotic, {.cpu_s = 2}), ContainsSubstring("The reference itself is known to 68500 % only"));
  chaotic.reference_gap = 0.1;
  CHECK(anything_fit(chaotic));
  CHECK_THAT(told(chaotic, {.error = 0.05}), ContainsSubstring("The reference itself is known to 10 % only"));
  Advice ruined = of({rated("a", 0.1, 1)});
  ruined.reference_strain = 30;
  CHECK_FALSE(anything_fit(ruined));
  CHECK_THAT(told(ruined, {.error = 0.05}), ContainsSubstring("The reference itself is stretched by 3000 %"));

  CHECK_THAT(told(of({rated("a", 0.37, 1), rated("b", 0.371, 1), rated("c", 0.37, 2), rated("d", 0.375, 3)}),
                  {.error = 0.05}),
             ContainsSubstring("not come to rest"));
  CHECK_THAT(told(of({}), {.error = 0.05}), ContainsSubstring("No setting gave an error"));
  Advice good = of({rated("a", 0.1, 1)});
  good.best = good.points.front();
  CHECK(why_none(good, {.error = 0.2}, 40).empty());
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
    Search search(models_a_and_b, {.error = error}, {});
    CHECK(machine.run(search) < 40);  // of 144
    const auto found = chosen(search.measured(), {.error = error}),
               best = chosen(everything(), {.error = error});
    REQUIRE(found);
    CHECK(found->cpu_s <= best->cpu_s);
  }
  for (const double cpu_s : {5e-4, 1e-3, 2.5e-3, 0.01, 0.04}) {
    INFO("time " << cpu_s);
    Search search(models_a_and_b, {.cpu_s = cpu_s}, {});
    machine.run(search);
    const auto found = chosen(search.measured(), {.cpu_s = cpu_s}),
               best = chosen(everything(), {.cpu_s = cpu_s});
    REQUIRE(found);
    CHECK(found->error <= best->error);
    for (const Rated& point : search.measured())
      CHECK(point.cpu_s <= cpu_s * 1.001 + 1e-9 + 4e-4);  // but the first
  }
  // A time that suffices for nothing fit: the fastest fit setting is found, which is 4 substeps of b.
  Search search(models_a_and_b, {.cpu_s = 2e-4}, {});
  machine.run(search);
  CHECK_FALSE(chosen(search.measured(), {.cpu_s = 2e-4}));
  CHECK(nearest(search.measured(), {.cpu_s = 2e-4})->setting == Setting{"b", 4});
}

TEST_CASE("advise: what takes too long is predicted from a law, and only there", "[advise]") {
  Search search(models_a_and_b, {.error = 0.001}, {});
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

  Search known_to(model_a, {.error = 0.001}, {.least_error = 0.005});
  machine.run(known_to, 2e-4 * 16);
  CHECK_FALSE(chosen(known_to.predicted(), {.error = 0.0049}));

  Search two(model_a, {.error = 0.001}, {});
  machine.run(two, 2e-4 * 2);
  CHECK(two.predicted().empty());
}

TEST_CASE("advise: a model that fails is left, and one that diverges is tried finer", "[advise]") {
  Search search(models_a_and_b, {.error = 0.02}, {});
  search.drop({"b"});
  Imaginary late = machine;
  late.error = [](const Setting& s) { return s.substeps < 8 ? std::nullopt : machine.error(s); };
  late.run(search);
  const auto found = chosen(search.measured(), {.error = 0.02});
  REQUIRE(found);
  CHECK(found->setting == Setting{"a", 12});  // 2 / 12² = 0.014, 2 / 8² = 0.031
}

TEST_CASE("advise: where coarse settings are ruins the search goes on to finer ones", "[advise]") {
  // Below 16 substeps the cloth is torn apart, and looks right.
  Imaginary torn = machine;
  torn.error = [](const Setting& s) -> std::optional<double> {
    return s.substeps < 16 ? 0.001 : *machine.error(s);
  };
  torn.strained = [](const Setting& s) { return Strained{s.substeps < 16 ? 50.0 / s.substeps : 0.01}; };
  for (const Demand& demand : {Demand{.error = 0.02}, Demand{.error = 0.9}, Demand{.cpu_s = 0.02}}) {
    Search search(models_a_and_b, demand, {});
    CHECK(torn.run(search) < 60);  // of 144
    const auto found = chosen(search.measured(), demand);
    REQUIRE(found);
    CHECK(found->setting.substeps >= 16);
    // None of the more iterations were tried on ruins while finer ones were left.
    int on_ruins = 0;
    for (const Rated& point : search.measured())
      on_ruins += point.setting.substeps < 16 && point.setting.iterations > 1;
    CHECK(on_ruins == 0);
  }

  // The same where ruins are not compared; what is between a ruin and a fit one is tried for the time it
  // saves.
  torn.error = [](const Setting& s) { return s.substeps < 16 ? std::optional<double>() : machine.error(s); };
  Search search(model_a, {.error = 0.1}, {});
  CHECK(search.may_be_stretched({"a", 8}));
  torn.run(search);
  CHECK(chosen(search.measured(), {.error = 0.1})->setting == Setting{"a", 16});
  CHECK(std::ranges::count(search.measured(), Setting{"a", 12}, &Rated::setting) == 1);
  CHECK_FALSE(search.may_be_stretched({"a", 32}));
  CHECK(search.may_be_stretched({"a", 8}));

  // Nothing is ever fit: it ends, without a choice.
  torn.strained = [](const Setting&) { return Strained{3}; };
  Search hopeless(models_a_and_b, {.error = 0.1}, {});
  torn.run(hopeless);
  CHECK_FALSE(chosen(hopeless.measured(), {.error = 0.99}));
  CHECK(nearest(hopeless.measured(), {.error = 0.1}));
}

TEST_CASE("advise: variants beside one differ from it in one thing, and none is named twice", "[advise]") {
  const Variant from{.tethers = true, .shear = "green", .flight_limit = 0, .radius = 0.02};
  const std::vector<Variant> beside = neighbours(from, {.tethers = true, .radii = {0.02, 0.04}});
  for (const Variant& each : beside) {
    INFO(variant_text(each));
    CHECK((each.tethers != from.tethers) + (each.shear != from.shear) +
              (each.flight_limit != from.flight_limit) + (each.radius != from.radius) ==
          1);
    CHECK(std::ranges::count(beside, each) == 1);
  }
  CHECK(beside.size() == 6);  // no tethers; two forms; a limit; 0.04 m and the config's own radius
  for (const Variant& each : neighbours(from, {.tethers = false})) CHECK(each.tethers);
}

TEST_CASE("advise: a variant in another method has nothing that the method lacks", "[advise]") {
  const Variant pbd{.tethers = true, .shear = "green", .flight_limit = 0.25, .radius = 0.02};
  const Variant implicit = in_method(pbd, "quasi_newton", true);
  CHECK(implicit == Variant{.shear = "green", .radius = 0.02, .method = "quasi_newton", .softened = true});
  CHECK(in_method(implicit, "newton", true) == Variant{.shear = "green", .radius = 0.02, .method = "newton"});
  CHECK(variant_text(implicit) == "softened membrane, green shear, springs of 0.02 m");
  // Beside it: its membrane as stated, the other integrator, shears and radius, the other methods; nothing of
  // pbd's own.
  const std::vector<Variant> beside =
      neighbours(implicit, {.tethers = true, .methods = {"pbd", "quasi_newton", "newton"}});
  CHECK(beside.size() == 7);
  CHECK(std::ranges::count(beside, Variant{.tethers = true, .shear = "green", .radius = 0.02}) == 1);
  CHECK(std::ranges::count(beside, in_method(implicit, "quasi_newton")) == 1);
  for (const Variant& each : beside) CHECK((each.method == "pbd") == each.tethers);
  // pbd's neighbours in quasi_newton have either membrane.
  CHECK(neighbours(pbd, {.methods = {"quasi_newton"}}).size() == neighbours(pbd, {.methods = {}}).size() + 2);
}

TEST_CASE("advise: each method climbs its own ladder", "[advise]") {
  const Setting pbd{"a"}, implicit{.model = "a", .variant = {.method = "quasi_newton"}},
      newton{.model = "a", .variant = {.method = "newton"}};
  CHECK(coarsest(newton).double_precision);
  CHECK_FALSE(coarsest(implicit).double_precision);
  CHECK(ladder_of(pbd).below({"a", 8}, 3)->substeps == 1);
  CHECK_FALSE(ladder_of(pbd).below({"a", 4}, 3));
  Setting high = implicit;
  high.substeps = 2, high.iterations = 20;
  CHECK(ladder_of(high).below(high, 1)->iterations == 10);
  CHECK(ladder_of(high).below(high, 1)->substeps == 2);
  CHECK_FALSE(ladder_of(high).on_main_way(high));
  CHECK(ladder_of(pbd).is_between({"a", 48}));
  CHECK_FALSE(ladder_of(implicit).is_between(implicit));
  for (const Setting& way : ladder_of(newton).ways(coarsest(newton))) CHECK(way.double_precision);
  Setting compared = pbd;
  compared.variant.method = "vbd";
  CHECK_THROWS_WITH(ladder_of(compared), ContainsSubstring("vbd"));
}

// Three methods whose error and time are known. At rest the iterations of quasi_newton count, wherever they
// are; newton is exact, and dear.
const Imaginary methods_at_rest{
    .error = [](const Setting& s) -> std::optional<double> {
      if (s.variant.method == "pbd") return machine.error(s);
      if (s.variant.method == "newton") return 1e-4;
      const double rounded = s.double_precision ? 0 : 0.003;
      return 0.3 / std::pow(s.iterations * s.substeps, 2) + rounded + (s.variant.softened ? 0.004 : 0);
    },
    .cpu_s =
        [](const Setting& s) {
          if (s.variant.method == "pbd") return machine.cpu_s(s);
          const double iteration = s.variant.method == "newton" ? 0.02 : s.double_precision ? 6e-4 : 4e-4;
          return s.substeps * (1e-4 + iteration * s.iterations);
        }};

TEST_CASE("advise: the search finds the best of several methods, and runs no dear one in vain", "[advise]") {
  const auto kind = [](const char* model, const char* method, bool softened = false) {
    return coarsest({.model = model, .variant = {.method = method, .softened = softened}});
  };
  const std::vector<Setting> kinds = {kind("a", "pbd"), kind("b", "pbd"), kind("a", "quasi_newton"),
                                      kind("a", "quasi_newton", true), kind("a", "newton")};
  const Search::Limits limits{.forecast = [](const Setting& s) -> std::optional<double> {
    return s.variant.method == "newton" ? std::optional(0.03) : std::nullopt;
  }};
  std::vector<Rated> all = everything();
  for (const Setting& start : kinds)
    for (const Setting& way : ladder_of(start).ways(start))
      for (const int rung : ladder_of(start).rungs) {
        const Setting setting = ladder_of(start).with_rung(way, rung);
        all.push_back({setting, *methods_at_rest.error(setting), methods_at_rest.cpu_s(setting)});
      }
  for (const double error : {0.4, 0.1, 0.02, 0.01, 0.006, 0.001, 0.0002}) {
    INFO("error " << error);
    Search search(kinds, {.error = error}, limits);
    CHECK(methods_at_rest.run(search) < 60);  // of more than 200
    const auto found = chosen(search.measured(), {.error = error}), best = chosen(all, {.error = error});
    REQUIRE(found);
    CHECK(found->cpu_s <= best->cpu_s);
    const auto is_newton = [](const Rated& point) { return point.setting.variant.method == "newton"; };
    CHECK(std::ranges::any_of(search.measured(), is_newton) == (error < 0.001));
  }
  Search search(kinds, {.cpu_s = 0.01}, limits);
  methods_at_rest.run(search);
  const auto found = chosen(search.measured(), {.cpu_s = 0.01}), best = chosen(all, {.cpu_s = 0.01});
  REQUIRE(found);
  CHECK(found->error <= best->error);
}

TEST_CASE("advise: a kind that is considered later is searched from a quarter of the substeps on",
          "[advise]") {
  const Variant tethered{.tethers = true};
  Imaginary remedied = machine;  // tethers make an error of a quarter
  remedied.error = [](const Setting& s) -> std::optional<double> {
    return *machine.error(s) / (s.variant.tethers ? 4 : 1);
  };
  Search search(model_a, {.error = 0.02}, {});
  remedied.run(search);
  const Rated before = *chosen(search.measured(), {.error = 0.02});
  CHECK_FALSE(search.consider(before.setting));
  Setting other = before.setting;
  other.variant = tethered;
  CHECK(search.consider(other));
  CHECK_FALSE(search.consider(other));
  REQUIRE_FALSE(search.next().empty());
  REQUIRE(before.setting.substeps == 12);  // the largest power of two in a quarter of it is 2
  CHECK(search.next().front().setting == Setting{"a", 2, 1, false, tethered});
  remedied.run(search);
  const Rated after = *chosen(search.measured(), {.error = 0.02});
  CHECK(after.setting.variant == tethered);
  CHECK(after.cpu_s < before.cpu_s);
  search.drop(other);
  CHECK_FALSE(search.consider(other));
}

TEST_CASE("advise: a prediction takes the strain along", "[advise]") {
  Imaginary soft = machine;
  soft.strained = [](const Setting& s) { return Strained{3.0 / s.substeps}; };
  Search search(model_a, {.error = 0.001}, {});
  soft.run(search, 2e-4 * 16);  // up to 16 substeps, of a strain of 0.19
  const std::vector<Rated> predicted = search.predicted();
  REQUIRE(predicted.size() == 4);  // 24, 32, 48, 64
  for (const Rated& point : predicted) {
    INFO(setting_text(point.setting));
    CHECK_THAT(point.strained.rms, WithinRel(3.0 / point.setting.substeps, 1e-9));
    CHECK((unfit(point) == Unfit::strain) == (point.setting.substeps < 32));
  }
}

TEST_CASE("advise: a cantilever's advice is what a run of it gives", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  check_promise(place, "strip.json", "--error 5%");
  CHECK(json::parse(bendlab::test::read(place.folder / "best.json")).at("expect").size() == 1);
#ifdef NDEBUG  // a debug build takes longer
  check_promise(place, "strip.json", "--budget 0.1ms");
#endif
  check_order(place, "strip.json", {"--error 20%", "--error 8%", "--error 3%", "--error 0.01"});
  // Short runs are timed anew, so that the search may go another way; most of its runs are there already.
  const json again = advice(place, "strip.json --error 8%");
  CHECK(again.at("computed_runs").get<std::size_t>() * 2 < again.at("points").size());
}

TEST_CASE("advise: a curtain's advice is what a run of it gives", "[advise]") {
  Workplace place;
  place.write("curtain.json", curtain);
  check_promise(place, "curtain.json", "--error 6%");
  // The advised setting is a row of the table, whatever else is left out of it.
  REQUIRE(place.run("advise curtain.json --error 6%") == 0);
  const std::string text = bendlab::test::read(place.folder / "stdout");
  const std::size_t end = text.find(" ms of CPU"), begin = text.rfind(' ', end - 1);
  CHECK_THAT(text, ContainsSubstring("  " + text.substr(begin + 1, end - begin - 1) + "  measured"));
  check_order(place, "curtain.json", {"--budget 0.15ms", "--budget 0.3ms"});
}

TEST_CASE("advise: every method's advice is what a run of it gives", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  const json implicit = check_promise(place, "strip.json", "--error 5% --methods quasi_newton,newton");
  CHECK(implicit.at("method") == "quasi_newton");
  CHECK(json::parse(bendlab::test::read(place.folder / "best.json")).at("solver").at("method") ==
        "quasi_newton");
  const json exact = check_promise(place, "strip.json", "--error 1% --methods newton --models dihedral");
  CHECK(exact.at("method") == "newton");
  CHECK(exact.at("precision") == "double");
  // Among all methods the choice is no slower than what one of them reaches; times vary.
  const json free = advice(place, "strip.json --error 5%").at("advice");
  CHECK(free.at("cpu_s_per_frame").get<double>() < 2 * implicit.at("cpu_s_per_frame").get<double>());
  // A config that has another method goes on from its own, and may be advised to leave it.
  const std::string own = "strip.json --set /solver/method=quasi_newton --set /solver/membrane=auto ";
  check_promise(place, own, "--error 5% --methods pbd --models isometric");
  const json written = json::parse(bendlab::test::read(place.folder / "best.json"));
  CHECK(written.at("solver").at("method") == "pbd");
  check_promise(place, own, "--error 2% --methods quasi_newton");
}

TEST_CASE("advise: the config's own reference is the same for every method", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  const std::string own =
      R"(strip.json --error 5% --models dihedral --set '/accuracy={"physical":["/solver/substeps=64"]}')";
  const json told = advice(place, own);
  CHECK(told.at("error_of") == "own");
  int references = 0;
  for (const std::filesystem::path& file : place.run_files(".vtkhdf"))
    references += file.string().find("references") != std::string::npos;
  CHECK(references == 1);
}

TEST_CASE("advise: a method that the scene does not allow is named with the reason", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  place.write("curtain.json", curtain);
  const auto says = [&](const std::string& arguments, const std::string& text) {
    INFO(arguments);
    place.run("advise --models dihedral --error 20% " + arguments);
    INFO(place.out() << place.err());
    CHECK_THAT(place.out(), ContainsSubstring(text));
  };
  const std::string membrane =
      "quasi_newton, newton: not searched: /material/strain/stiffness must be \"compliance\"";
  says("curtain.json", membrane);
  says("curtain.json", "--set /material/strain/compliance=1e-05");
  says(
      "curtain.json --methods quasi_newton --set /material/strain/stiffness=compliance "
      "--set /material/strain/compliance=1e-5",
      "take dihedral, quasi_newton, ");
  says(R"(strip.json --set '/effects=[{"type":"gravity"},{"type":"viscous_drag","coefficient":4},)"
       R"({"type":"strain_limiting"}]')",
       "quasi_newton, newton: not searched: /effects/2 strain_limiting works with the projection");
  says("strip.json", "newton: not run: its coarsest setting would take about");
  CHECK(place.run("advise curtain.json --error 5% --methods quasi_newton") == 3);
  CHECK_THAT(place.err(), ContainsSubstring("k has no energy"));
  CHECK(place.run("advise strip.json --error 5% --methods vbd") == 2);
  CHECK_THAT(place.err(), ContainsSubstring("pbd, quasi_newton, newton"));
  CHECK(place.run("advise strip.json --error 5% --methods quasi_newtn") == 2);
  CHECK_THAT(place.err(), ContainsSubstring("did you mean 'quasi_newton'"));
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
  const std::string undamped = R"( --set '/effects=[{"type":"gravity"}]')";
  const json swinging =
      advice(place, "strip.json --error 20% --models dihedral --set /duration=0.2" + undamped);
  CHECK(swinging.at("error_of") == "motion");
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
  refused("strip.json --error 5% --set '/accuracy={\"solver\":[\"/solver/substeps=64\"]}'", 3,
          "/accuracy/physical");
  refused("nothing.json --error 5%", 3, "cannot be read");
  refused("strip.json --error 5% --set '/sweep={\"/mesh/cells\":[8],\"/solver/dt\":[0.01,0.02]}'", 3,
          "--set /solver/dt=VALUE");
  const std::string limp =
      R"( --set '/bending={"model":"none","stiffness":"physical","quartic_coefficient":1e-8}')";
  refused("strip.json --error 5%" + limp, 3, "/bending/model");
  refused("strip.json --error 5% --write strip.json", 2, "the config itself");
  refused("strip.json --error 5% --write nowhere/best.json", 2, "does not exist");
  refused("strip.json --error 5% --write .", 2, "is a folder");
  std::filesystem::create_symlink("elsewhere.json", place.folder / "link.json");
  refused("strip.json --error 5% --write link.json", 2, "is a link");
  refused("strip.json --error 5% --write /dev/null", 2, "is no file");
  CHECK(place.run_files(".vtkhdf").empty());

  // Nothing is that accurate: said, with what comes nearest, and nothing is written.
  CHECK(place.run("advise strip.json --error 0.01% --models none --write best.json") == 1);
  CHECK_THAT(place.out(), ContainsSubstring("nothing to advise"));
  CHECK_FALSE(std::filesystem::exists(place.folder / "best.json"));
  CHECK_THAT(place.err(), ContainsSubstring("best.json is not written"));

  // What is fit, and not as fast as demanded, may be used all the same.
  CHECK(place.run("advise strip.json --budget 1us --models dihedral") == 1);
  CHECK_THAT(place.out(), ContainsSubstring("no setting meets 0.001 ms") &&
                              ContainsSubstring("Nothing is that fast") &&
                              ContainsSubstring("to use the nearest:"));
}

TEST_CASE("advise: where nothing is fit nothing is recommended, whatever was asked for", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  const std::string stiff =
      "advise strip.json --models none --set /bending/flexural_rigidity=0.01 --set /duration=0.7 ";
  // A strip without bending stiffness hangs straight down: with the stated one it would stand out.
  for (const char* demand : {"--error 99%", "--budget 1s"}) {
    INFO(demand);
    CHECK(place.run(stiff + "--write best.json " + demand) == 1);
    INFO(place.out());
    CHECK_THAT(place.out(), !ContainsSubstring("to use") && !ContainsSubstring("--set"));
    CHECK_THAT(place.out(), ContainsSubstring("nothing to advise") && ContainsSubstring("nearest is none") &&
                                ContainsSubstring("which is not to be used") &&
                                ContainsSubstring("had more than 20 % of error") &&
                                ContainsSubstring("unfit: "));
    CHECK_FALSE(std::filesystem::exists(place.folder / "best.json"));
    CHECK_THAT(place.err(), ContainsSubstring("no setting is fit to be advised"));
    CHECK(place.run(stiff + "--json " + demand) == 1);
    const json told = place.out_lines().at(0);
    CHECK(told.at("advice").is_null());
    CHECK(told.at("anything_fit") == false);
    CHECK(told.at("set").empty());
    CHECK(told.at("front").empty());
    CHECK(told.at("nearest").at("unfit") == "error");
    CHECK(told.at("why_none").at(0).get<std::string>().starts_with("Of "));
  }
}

TEST_CASE("advise: a setting that is fit but unconverged is advised with its run's warning", "[advise]") {
  Workplace place;
  place.write("curtain.json", curtain);
  // A substep leaves a neck at each pin of this sheet, and its pose is hardly wrong.
  const std::string fine = "curtain.json --models dihedral --set /mesh/cells=32 ";
  REQUIRE(place.run("advise " + fine + "--error 20% --write best.json") == 0);
  CHECK_THAT(place.out(),
             ContainsSubstring("(measured, unconverged)") &&
                 ContainsSubstring("Its run warns (unconverged): the membrane should not stretch"));
  CHECK(advice(place, fine + "--error 20%").at("advice").at("unconverged") == true);
  CHECK(place.run("run best.json") == 0);
  CHECK_THAT(place.out(), ContainsSubstring("warning unconverged"));
  const json more = advice(place, fine + "--error 0.2%");  // what takes more substeps has none
  CHECK(more.at("advice").at("unconverged") == false);
  place.run("advise " + fine + "--error 0.2%");
  CHECK_THAT(place.out(), !ContainsSubstring("(unconverged)"));
}

TEST_CASE("advise: a pose that an unconverged method passes by accident is not advised", "[advise]") {
  Workplace place;
  place.write("strip.json", cantilever);
  // Without bending stiffness a strip hangs straight down; one iteration takes long to get there, and passes
  // where a stiff strip is at rest.
  const std::string slow =
      "strip.json --models none --methods quasi_newton --set /bending/flexural_rigidity=0.01 "
      "--set /duration=0.7 ";
  CHECK(place.run("advise " + slow + "--error 5%") == 1);
  CHECK_THAT(place.out(), ContainsSubstring("its pose does not stay, error"));
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
              R"({"name": "sheet", "defaults": "paper",
          "duration": 0.5, "mesh": {"file": "sheet.obj"}, "pins": {"indices": [3]},
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
