// Advice on settings: its parts with made-up numbers, and its promises on small scenes.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "experiments/advise/advice.hpp"
#include "experiments/advise/search.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::advise_test {
using bendlab::test::Workplace;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;
using nlohmann::json;

namespace {

// `strain` is the strain beyond the strain of the reference; `stretch` is the longest triangle over the
// longest triangle of the reference.
Trial trial(const std::string& model, double error, double cpu_s, double strain = 0, double stretch = 1) {
  return {
      .setting = {model, "pbd"}, .error = error, .cpu_s = cpu_s, .more_strain = strain, .stretch = stretch};
}

constexpr double not_compared = std::numeric_limits<double>::infinity();

std::string models_of(const std::vector<Trial>& trials) {
  std::string models;
  for (const Trial& candidate : trials) models += candidate.setting.model;
  return models;
}

// The chosen model, and whether it meets the demand: "a", or else "nearest b".
std::string choice_text(const std::vector<Trial>& trials, const Demand& demand) {
  const Trial choice = *choice_of(trials, demand);
  return (meets(choice, demand) ? "" : "nearest ") + choice.setting.model;
}

// A made-up machine on which the error and time of every setting are known. With more substeps every model
// converges to a different cloth. Model h is nearest to the stated cloth, a is the cheapest, and dearer
// models are nearer.
struct Imaginary {
  std::map<std::string, double> bias, price;  // remaining error; s per substep
  std::vector<std::size_t> rounds{};          // the number of settings run in each round

  static Imaginary with_eight_models() {
    Imaginary machine;
    for (int m = 0; m < 8; ++m) {
      const std::string name(1, static_cast<char>('a' + m));
      machine.bias[name] = 0.016 * std::pow(2, -m), machine.price[name] = 1e-4 * std::pow(1.2, m);
    }
    return machine;
  }

  Trial trial_of(const Setting& s) const {
    return {.setting = s,
            .error = std::min(0.5, 1.0 / s.substeps) + bias.at(s.model),
            .cpu_s = price.at(s.model) * s.substeps};
  }

  // All models, with these numbers of substeps to start from.
  std::vector<SettingKind> kinds(const std::vector<int>& substeps) const {
    std::vector<SettingKind> all;
    for (const auto& [model, unused] : bias) {
      all.push_back({{model, "pbd"}, {}});
      for (const int count : substeps) all.back().works.emplace_back(count, 1);
    }
    return all;
  }

  // The trials of the search, with at most 512 substeps.
  std::vector<Trial> search(const Demand& demand, const std::vector<int>& substeps) {
    Search search(demand, 512, [this](const std::vector<Setting>& settings) {
      rounds.push_back(settings.size());
      REQUIRE(rounds.size() < 100);
      std::vector<Trial> trials;
      for (const Setting& setting : settings) trials.push_back(trial_of(setting));
      return trials;
    });
    search.run(kinds(substeps));
    return search.trials();
  }
};

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

struct Scenes : Workplace {
  Scenes() { write("strip.json", cantilever), write("curtain.json", curtain); }

  // The output of the program, which must exit with `code`.
  std::string answer(const std::string& arguments, int code = 0) {
    INFO(arguments);
    CHECK(run("advise " + arguments) == code);
    return out() + err();
  }

  json advice(const std::string& arguments, int code = 0) {
    answer(arguments + " --json", code);
    INFO(err());
    return out_lines().at(0);
  }

  json written() const { return json::parse(bendlab::test::read(folder / "best.json")); }

  // Runs the written config, and checks that its error equals the error of the advised setting to the bit.
  json kept_promise(const std::string& arguments) {
    const json result = advice(arguments + " --write best.json"), best = result.at("advice");
    write("accuracy", result.at("accuracy").dump());
    REQUIRE(run("run best.json --json --set /accuracy=\"$(cat accuracy)\"") == 0);
    CHECK(out_lines().at(0).at("summary").at("error_physical_rms") == best.at("error"));
    CHECK_FALSE(written().contains("accuracy"));
    CHECK(written().at("bending").at("model") == best.at("model"));
    CHECK(written().at("solver").at("method") == best.at("method"));
    return best;
  }
};

}  // namespace

TEST_CASE("advise: demands are errors as shares or times with units", "[advise]") {
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

TEST_CASE(
    "advise: the front has the settings that none beats in both error and time, and the choice is on it",
    "[advise]") {
  const std::vector<Trial> trials = {trial("a", 0.1, 3),  trial("b", 0.2, 1), trial("c", 0.2, 2),
                                     trial("d", 0.05, 9), trial("e", 0.1, 3), trial("f", 0.06, 9)};
  CHECK(models_of(front_of(trials)) == "bad");
  CHECK(front_of({}).empty());
  CHECK(models_of(thinned(std::vector{trial("a", 1, 1), trial("b", 0.95, 2), trial("c", 0.9, 3),
                                      trial("d", 0.85, 4)})) == "acd");
  CHECK(thinned({}).empty());
  CHECK_FALSE(choice_of({}, {.error = 0.1}));
  CHECK(choice_text(trials, {.error = 0.1}) == "a");
  CHECK(choice_text(trials, {.error = 0.0999}) == "d");
  CHECK(choice_text(trials, {.error = 0.01}) == "nearest d");
  CHECK(choice_text(trials, {.cpu_s = 8}) == "a");
  CHECK(choice_text(trials, {.cpu_s = 2}) == "b");
  CHECK(choice_text(trials, {.cpu_s = 0.5}) == "nearest b");
}

TEST_CASE(
    "advise: a setting is fit or unfit by its error, strain and stretch, and unfit ones count by degree",
    "[advise]") {
  CHECK(unfit(trial("a", 0.2, 1, 0.1, 1.5)).empty());
  CHECK(unfit(trial("a", 0.21, 1)) == "error");
  CHECK(unfit(trial("a", not_compared, 1)) == "error");
  CHECK(unfit(trial("a", 0.01, 1, 0.11)) == "strain");
  CHECK(unfit(trial("a", 0.01, 1, 0, 1.6)) == "stretch");
  CHECK(unfit({.error = 0.01, .implausible = true}) == "implausible");
  CHECK(unfit(trial("a", std::nan(""), 1)) == "error");
  CHECK(unfit(trial("a", 0.01, 1, std::nan(""))) == "strain");
  CHECK(unfit(trial("a", 1, 1, 1, 9)) == "strain");  // the first of several reasons

  CHECK(judged_error(trial("a", 0.1, 1)) == 0.1);
  CHECK_THAT(judged_error(trial("a", 0.01, 1, 0.3)),
             WithinRel(0.6, 1e-12));  // 3 times the largest fit strain
  CHECK_THAT(judged_error(trial("a", 1.89, 1, 0.2)), WithinRel(1.89, 1e-12));
  CHECK_THAT(judged_error(trial("a", not_compared, 1, 0.3, 1.5)), WithinRel(0.6, 1e-12));
  CHECK_THAT(judged_error({.implausible = true}), WithinRel(0.2, 1e-12));
  const Demand error{.error = 0.05}, time{.cpu_s = 2};
  CHECK_THAT(score(trial("a", 0.01, 3), error), WithinRel(3.0, 1e-12));
  CHECK_THAT(score(trial("a", 0.1, 3), error), WithinRel(6.0, 1e-12));
  CHECK_THAT(score(trial("a", 0.1, 3), time), WithinRel(0.15, 1e-12));
  CHECK_THAT(score(trial("a", 0.1, 1), time), WithinRel(0.1, 1e-12));
}

TEST_CASE("advise: an unfit setting is not chosen and does not hide a fit setting", "[advise]") {
  // a to d are fast or accurate, but their poses are ruined.
  const std::vector<Trial> trials = {trial("a", 1.89, 1, 30000),  trial("b", 0.01, 1, 0.5),
                                     trial("c", 0.02, 2, 0, 2.6), trial("d", not_compared, 2, 0.3),
                                     trial("e", 0.15, 5),         trial("f", 0.04, 9),
                                     trial("g", 0.01, 10, 0.2)};
  CHECK(models_of(front_of(trials)) == "ef");
  CHECK(choice_text(trials, {.error = 0.05}) == "f");
  CHECK(choice_text(trials, {.error = 0.9}) == "e");
  CHECK(choice_text(trials, {.cpu_s = 20}) == "f");
  CHECK(choice_text(trials, {.error = 0.02}) == "nearest f");
  CHECK(choice_text(trials, {.cpu_s = 4}) == "nearest e");  // only four ruined settings are that fast

  const std::vector<Trial> ruins(trials.begin(), trials.begin() + 4);
  CHECK(front_of(ruins).empty());
  CHECK(choice_text(ruins, {.error = 0.99}) == "nearest d");
  CHECK(choice_text(ruins, {.cpu_s = 1.5}) == "nearest b");  // the best within the time
  CHECK(choice_text(ruins, {.cpu_s = 0.5}) == "nearest d");  // no setting is within the time
}

TEST_CASE("advise: if nothing is advised, the reasons are stated", "[advise]") {
  struct Case {
    std::vector<Trial> trials;
    Demand demand;
    bool anything_fit;
    std::string text;
    double gap = 0, strain = 0;  // of the reference
  };
  const std::vector<Trial> good = {trial("a", 0.1, 1)};
  const std::vector<Trial> slow = {trial("a", 0.1, 1, 0, 2.5), trial("b", 0.1, 3)};
  const std::vector<Trial> alike = {trial("a", 0.37, 1), trial("b", 0.371, 1), trial("c", 0.37, 2),
                                    trial("d", 0.375, 3)};
  const std::vector<Case> cases = {
      {{trial("a", 1.89, 1, 30000), trial("b", 0.01, 1, 0.5), trial("c", 0.3, 3)},
       {.error = 0.05},
       false,
       "Of 3 settings tried, 2 stretched the cloth by more than 10 % (rms; the smallest: 50 %); 1 had an "
       "error above 20 % (the smallest: 30 %)."},
      {slow,
       {.cpu_s = 2},
       true,
       "No setting that is fast enough gives a usable result. Of 1 setting that fast, 1 stretched a "
       "triangle to more than 1.5 times the largest stretch of the reference (the smallest: 2.5 times)."},
      {slow, {.cpu_s = 0.5}, true, "No setting is that fast: the fastest setting takes 1e+03 ms."},
      {good, {.cpu_s = 2}, false, "The reference itself has an error of 68500 %, so", 685},
      {good, {.error = 0.05}, true, "The reference itself has an error of 10 %: cloth", 0.1},
      {good, {.error = 0.05}, false, "The reference itself is stretched by 3000 %", 0, 30},
      {alike, {.error = 0.05}, false, "not come to rest"},
      {{}, {.error = 0.05}, false, "No setting gave an error."}};
  for (const Case& example : cases) {
    Advice advice;
    advice.trials = example.trials, advice.front = front_of(example.trials);
    advice.reference.gap = example.gap, advice.reference.strain = example.strain;
    CHECK(advice.anything_fit() == example.anything_fit);
    const AdviceOptions options{.demand = example.demand, .time_limit_s = 40};
    std::vector<std::string> why = why_none(advice, options);
    CHECK_THAT(fmt::format("{}", fmt::join(why, " ")),
               ContainsSubstring(example.text) && !ContainsSubstring("limit"));
    if (!advice.reference.tells()) continue;
    advice.not_tried = {{"d", "pbd"}, {"e", "pbd"}};
    CHECK_THAT(why_none(advice, options).back(), ContainsSubstring("2 settings"));
    advice.is_met = true;
    CHECK(why_none(advice, options).empty());
  }
}

TEST_CASE("advise: the search finds nearly the best of all settings in a few runs", "[advise]") {
  for (const Demand& demand : {Demand{.error = 0.05}, Demand{.error = 0.02}, Demand{.error = 0.006},
                               Demand{.cpu_s = 0.0015}, Demand{.cpu_s = 0.006}, Demand{.cpu_s = 0.03}}) {
    Imaginary machine = Imaginary::with_eight_models();
    const std::vector<Trial> trials = machine.search(demand, {4, 16, 64, 256});
    std::vector<Trial> all;
    for (const SettingKind& kind : machine.kinds({}))
      for (int substeps = 1; substeps <= 512; ++substeps) {
        all.push_back({.setting = kind.setting});
        all.back().setting.substeps = substeps;
        all.back() = machine.trial_of(all.back().setting);
      }
    const Trial choice = *choice_of(trials, demand), best = *choice_of(all, demand);
    INFO(trials.size() << " runs; " << setting_text(choice.setting) << " for " << setting_text(best.setting));
    REQUIRE(meets(choice, demand));
    // The last two runs of a kind differ by less than 15 %. Halving may drop the best model in favour of a
    // model that is equally good so far.
    CHECK(score(choice, demand) < 1.3 * score(best, demand));
    CHECK(trials.size() < 45);  // of 8 × 512 settings
  }
}

TEST_CASE("advise: every round keeps half of the kinds, until three are left", "[advise]") {
  Imaginary machine = Imaginary::with_eight_models();
  machine.search({.cpu_s = 0.03}, {1});
  const std::vector<std::size_t>& rounds = machine.rounds;
  REQUIRE(rounds.size() > 3);
  CHECK(rounds[0] == 8);
  CHECK(rounds[1] == 4);
  CHECK(rounds[2] <= 3);
}

TEST_CASE("advise: a kind starts with suitable work and is considered only once", "[advise]") {
  std::vector<Setting> asked;
  const auto run = [&](const std::vector<Setting>& settings) {
    asked.insert(asked.end(), settings.begin(), settings.end());
    return std::vector<Trial>();  // no setting could be run
  };
  const SettingKind kind{{"a", "pbd"}, {{64, 1}, {1, 1}, {4, 1}, {16, 1}}};
  SettingKind multilevel = kind, coarse = kind;
  multilevel.setting.solver = R"({"levels":12})", coarse.setting.cells = 12;
  Search search({.error = 0.05}, 512, run);
  CHECK_FALSE(search.run({kind, kind}));
  CHECK(asked == std::vector<Setting>{{"a", "pbd", "{}", 16}});  // the middle of its amounts of work
  CHECK_FALSE(search.run({kind}));
  CHECK(asked.size() == 1);
  search.run({multilevel, coarse});
  CHECK(asked.size() == 3);
}

TEST_CASE("advise: settings beyond the limits of work, or with no further gain, are not run", "[advise]") {
  Imaginary machine{.bias = {{"a", 0.1}}, .price = {{"a", 1e-4}}};
  const std::vector<Trial> trials = machine.search({.error = 0.01}, {8});
  for (const Trial& candidate : trials) CHECK(candidate.setting.substeps <= 512);
  CHECK(trials.size() <= 4);  // 0.225, 0.131, 0.108, 0.102: hardly better in the end
}

TEST_CASE("advise: the program knows every kind of setting of the measured fronts", "[advise]") {
  REQUIRE(measured_fronts().size() > 10);
  for (const SettingKind& kind : measured_fronts()) {
    json settings = json::parse(cantilever);
    settings["bending"]["model"] = kind.setting.model;
    settings["solver"] = json::parse(kind.setting.solver);
    settings["solver"].update({{"method", kind.setting.method},
                               {"substeps", kind.works.front().first},
                               {"iterations", kind.works.front().second}});
    settings.erase("expect");
    INFO(setting_text(kind.setting));
    CHECK_NOTHROW(parse_experiment(settings.dump(), "fronts"));
  }
}

TEST_CASE("advise: a run with the advised setting has the promised error", "[advise][slow]") {
  Scenes place;
  const std::string models = " --models dihedral,isometric,lod,mid_edge";
  place.kept_promise("strip.json --error 5%" + models);
  CHECK(place.written().at("expect").size() == 1);
  place.kept_promise("strip.json --budget 0.1ms" + models);
  // Advice for another demand uses the existing runs.
  const json again = place.advice("strip.json --error 8%" + models);
  CHECK(again.at("computed_runs").get<std::size_t>() * 2 < again.at("points").size());

  CHECK(place.kept_promise("strip.json --error 5% --methods quasi_newton").at("method") == "quasi_newton");
  CHECK(place.kept_promise("strip.json --error 1% --methods newton --models dihedral").at("method") ==
        "newton");
  // If the config has another method, the search starts from this method, but may advise another one.
  const std::string implicit = "strip.json --set /solver/method=quasi_newton --set /solver/membrane=auto ";
  CHECK(place.kept_promise(implicit + "--error 5% --methods pbd --models isometric").at("method") == "pbd");

  place.kept_promise("curtain.json --error 6%");
  // The advised setting is always a row of the table.
  const std::string text = place.answer("curtain.json --error 6%");
  const std::size_t end = text.find(" ms of CPU"), begin = text.rfind(' ', end - 1);
  CHECK_THAT(text, ContainsSubstring("  " + text.substr(begin + 1, end - begin - 1) + "\n"));
}

TEST_CASE("advise: coarser meshes are offered, and compared with the mesh of the config", "[advise][slow]") {
  Scenes place;
  const std::string fine =
      "curtain.json --set /mesh/cells=24 --methods pbd --models dihedral,none --error 15%";
  // A quarter of the vertices takes a quarter of the time, and the pose of a curtain needs few cells.
  CHECK(place.kept_promise(fine).at("cells").get<int>() <= 12);
  CHECK(place.written().at("mesh").at("cells").get<int>() <= 12);
  // On another mesh an index means another vertex, so coarser meshes are not offered.
  const json indexed = place.advice(fine + R"( --set '/pins={"indices":[600,624]}')");
  CHECK(indexed.at("advice").at("cells") == nullptr);
}

TEST_CASE("advise: the answer at the end of the time limit is the best setting so far", "[advise]") {
  const Scenes place;
  const Question question(place.folder / "curtain.json", {"/mesh/cells=6", "/duration=1"});
  const Demand demand{.error = 0.0005};
  const auto advised = [&] {
    AdviceOptions options{.demand = demand, .models = {"dihedral", "none"}, .time_limit_s = 16};
    options.campaign.out = place.folder / "results", options.campaign.jobs = 1;
    // A clock that counts runs: each complete run file is a second.
    options.now_s = [&] { return static_cast<double>(place.run_files(".vtkhdf").size()); };
    return advise(question, options, [](const std::string&) {});
  };
  const Advice first = advised();
  REQUIRE(first.choice);
  CHECK(first.choice->setting == choice_of(first.trials, demand)->setting);
  CHECK_FALSE(first.not_tried.empty());
  for (const Setting& setting : first.not_tried)
    CHECK(std::ranges::find(first.trials, setting, &Trial::setting) == first.trials.end());
  // The same command continues: it reuses the runs, and tries settings that were not tried.
  CHECK(advised().trials.size() > first.trials.size());
}

TEST_CASE("advise: if the time limit is over before there is a reference, no run begins", "[advise]") {
  Scenes place;
  for (const char* what : {"", " --what motion"})
    CHECK_THAT(place.answer(std::string("curtain.json --error 5% --time-limit 0.001us") + what, 1),
               ContainsSubstring("--time-limit"));
  CHECK(place.run_files(".vtkhdf").empty());
}

TEST_CASE("advise: all settings are compared with the same reference of the config", "[advise]") {
  Scenes place;
  // With 64 substeps, two measurements of the reference's stiffness would differ by 3.2 %, too much for a
  // reference.
  const json result = place.advice(
      "strip.json --error 5% --models dihedral,none "
      R"(--set '/accuracy={"physical":["/solver/substeps=256"]}')");
  CHECK(result.at("error_of") == "own");
  int references = 0;
  for (const std::filesystem::path& file : place.run_files(".vtkhdf"))
    references += file.string().find("references") != std::string::npos;
  CHECK(references == 1);
}

TEST_CASE("advise: a motion is compared over time with its refinement", "[advise]") {
  Scenes place;
  const json result =
      place.advice("strip.json --error 10% --what motion --models dihedral --set /duration=0.3");
  CHECK(result.at("error_of") == "motion");
  CHECK(result.at("accuracy").at("over_time") == true);
  CHECK(result.at("reference_gap").get<double>() < 0.1);
  CHECK(result.at("advice").at("model") == "dihedral");
  // Cloth without damping or without pins has no rest pose, only a motion.
  const std::string brief = "strip.json --error 50% --models dihedral --set /duration=0.1 ";
  CHECK(place.advice(brief + R"(--set '/effects=[{"type":"gravity"}]')").at("error_of") == "motion");
  CHECK(place.advice(brief + "--set /pins/vertices=[]").at("error_of") == "motion");
}

TEST_CASE("advise: impossible requests are refused with a hint what to write", "[advise]") {
  Scenes place;
  struct Case {
    std::string arguments;
    int code;
    std::string text;
  };
  std::filesystem::create_symlink("elsewhere.json", place.folder / "link.json");
  const std::vector<Case> cases = {
      {"", 2, "--error 5%"},
      {"--error 5% --budget 2ms", 2, "either --error"},
      {"--error 5", 2, "5% or 0.05"},
      {"--budget 2", 2, "2ms or 0.002s"},
      {"--error 5% --models dihedrall", 2, "did you mean 'dihedral'"},
      {"--error 5% --methods quasi_newtn", 2, "did you mean 'quasi_newton'"},
      {"--error 5% --methods vbd", 2, "newton, pbd, quasi_newton"},
      {R"(--error 5% --set '/bending={"k":0.5}')", 3, "/bending/stiffness"},
      {R"(--error 5% --set '/bending={"k":0.5}')", 3, "\"flexural_rigidity\": B"},
      {"--error 5% --set /mesh/cells=[8,16]", 3, "/mesh/cells"},
      {R"(--error 5% --set '/accuracy={"solver":["/solver/substeps=64"]}')", 3, "/accuracy/physical"},
      {R"(--error 5% --set '/sweep={"/mesh/cells":[8],"/solver/dt":[0.01,0.02]}')", 3,
       "--set /solver/dt=VALUE"},
      {R"(--error 5% --set '/bending={"model":"none","stiffness":"physical","quartic_coefficient":1e-8}')", 3,
       "/bending/model"},
      {"--error 5% --write strip.json", 2, "the config itself"},
      {"--error 5% --write nowhere/best.json", 2, "does not exist"},
      {"--error 5% --write .", 2, "is a folder"},
      {"--error 5% --write link.json", 2, "is a link"},
      {"--error 5% --write /dev/null", 2, "is not a regular file"}};
  for (const Case& example : cases)
    CHECK_THAT(place.answer("strip.json " + example.arguments, example.code),
               ContainsSubstring(example.text));
  CHECK_THAT(place.answer("nothing.json --error 5%", 3), ContainsSubstring("cannot be read"));
  CHECK(place.run_files(".vtkhdf").empty());

  // A method that the scene does not allow is named with the reason.
  CHECK_THAT(place.answer(R"(strip.json --error 20% --models dihedral --set '/effects=[{"type":"gravity"},)"
                          R"({"type":"viscous_drag","coefficient":4},{"type":"strain_limiting"}]')"),
             ContainsSubstring("/effects/2 strain_limiting"));
}

TEST_CASE("advise: if no setting meets the demand, the answer says so and names the nearest setting",
          "[advise][slow]") {
  Scenes place;
  // A fit setting that is too slow may be used nevertheless.
  CHECK_THAT(place.answer("strip.json --budget 1us --models dihedral", 1),
             ContainsSubstring("no setting meets 0.001 ms") && ContainsSubstring("No setting is that fast") &&
                 ContainsSubstring("to use the nearest setting:"));
  // A strip without bending stiffness hangs straight down, but with the stated stiffness it would stick out.
  // So no setting is recommended, for any demand.
  const std::string limp =
      "strip.json --models none --set /bending/flexural_rigidity=0.01 --set /duration=0.7 ";
  for (const std::string demand : {"--error 99%", "--budget 1s"}) {
    const std::string text = place.answer(limp + "--write best.json " + demand, 1);
    CHECK_THAT(text, !ContainsSubstring("to use") && !ContainsSubstring("--set"));
    CHECK_THAT(text, ContainsSubstring("nothing to advise") &&
                         ContainsSubstring("the nearest setting is none") &&
                         ContainsSubstring("which should not be used") &&
                         ContainsSubstring("had an error above 20 %") && ContainsSubstring("unfit: ") &&
                         ContainsSubstring("no setting is fit to be used"));
    CHECK_FALSE(std::filesystem::exists(place.folder / "best.json"));
    const json result = place.advice(limp + demand, 1);
    CHECK(result.at("advice").is_null());
    CHECK(result.at("anything_fit") == false);
    CHECK(result.at("set").empty());
    CHECK(result.at("front").empty());
    CHECK(result.at("nearest").at("unfit") == "error");
    CHECK(result.at("why_none").at(0).get<std::string>().starts_with("Of "));
  }
  // With one iteration the strip needs long to reach its rest pose. On its way it passes the rest pose of a
  // stiff strip.
  CHECK_THAT(place.answer(limp + "--methods quasi_newton --budget 0.01ms", 1),
             ContainsSubstring("whose pose still changes: the last is none, quasi_newton"));
  CHECK_THAT(place.answer("strip.json --error 20% --models none --set /duration=0.1", 1),
             ContainsSubstring("still moves at the end of /duration"));
}

TEST_CASE("advise: the warnings of the advised setting's run are printed", "[advise]") {
  Scenes place;
  // The cloth is as long as the curtain of a theatre.
  place.run("advise strip.json --error 90% --methods pbd --models dihedral --set /mesh/scale=130");
  CHECK_THAT(place.out(),
             ContainsSubstring("The run with this setting has the warning units: the cloth is 3"));
}

TEST_CASE("advise: a config written to another folder finds its files, including those of /initial/after",
          "[advise]") {
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
  REQUIRE(place.run("advise sheet.json --error 90% --models dihedral --write other/best.json") == 0);
  const json written = json::parse(bendlab::test::read(place.folder / "other/best.json"));
  CHECK(written.at("mesh").at("file") == "../sheet.obj");
  CHECK(written.at("initial").at("after") == json{"/mesh/file=\"../coarse.obj\"", "/duration=0.1"});
  CHECK(place.run("validate other/best.json") == 0);
  CHECK(place.run("run other/best.json") == 0);
}

}  // namespace bendlab::advise_test
