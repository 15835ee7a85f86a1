// The descriptions of measures agree with the metrics of runs.
#include <set>

#include "experiments/config/experiment.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/measures/metrics.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::measures_test {
namespace {

using test::Workplace;

template <class Make>
void add_names(Make make, std::set<std::string>& names) {
  if (!make) return;
  for (const auto& row : make()) {
    CHECK(names.insert(row.name).second);  // no name has two meanings
    CHECK_FALSE(row.unit.empty());
    CHECK_FALSE(row.meaning.empty());
  }
}

}  // namespace

TEST_CASE("measures: each describes its metrics, their units and its cost", "[measures]") {
  std::set<std::string> names, of_frames, of_triangles, of_runs;
  for (const Measure* measure : measures()) {
    CHECK(names.insert(std::string(measure->name)).second);
    CAPTURE(measure->name);
    CHECK_FALSE(measure->summary.empty());
    CHECK_FALSE(measure->cost.empty());
    REQUIRE(measure->begin);
    add_names(measure->columns, of_frames), add_names(measure->fields, of_triangles);
    add_names(measure->gives, of_runs);
    CHECK_THAT(measures_text(), Catch::Matchers::ContainsSubstring(std::string(measure->name) + ": "));
  }
  CHECK(measures_json().size() == names.size());
}

TEST_CASE("measures: the summary of a run has exactly the metrics of its measures", "[measures]") {
  const Workplace here;
  const auto experiment_with = [](const std::string& more) {
    return parse_experiment(
        R"({"name": "all", "defaults": "paper",
          "duration": 0.1, "mesh": {"cells": 8, "width": 0.2, "height": 0.1},
            "pins": {"vertices": ["left"], "ring": 0, "distance": 0.06},
            "bending": {"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 1e-4}, )" +
            more + "}",
        "test");
  };
  const auto summary_of = [&](const Experiment& experiment) {
    return execute_run(experiment, experiment.runs.front(), here.folder / "out").summary;
  };
  const Experiment everything = experiment_with(R"("effects": [{"type": "gravity"}],
      "output": {"measures": ["stability", "stiffness", "drape"]},
      "accuracy": {"solver": ["/solver/substeps=4"], "over_time": true})");
  const auto plain = summary_of(experiment_with(R"("effects": [])")), all = summary_of(everything);
  for (const auto& [name, value] : all) {
    CAPTURE(name, value);
    CHECK_FALSE(problem_with_metric(everything, name));
  }
  for (const char* name :
       {"stability_reach", "stiffness_flexural_rigidity", "drape_coefficient", "error_solver_rms",
        "effective_bending_stiffness", "drop", "mean_strain", "kinetic_energy", "degenerate_triangles"})
    CHECK(all.contains(name));
  for (const char* name :
       {"stability_reach", "stiffness_flexural_rigidity", "drape_coefficient", "error_solver_rms"})
    CHECK_FALSE(plain.contains(name));
}

// A strip hangs by its left side along x, and its membrane slowly becomes 4 times as stiff. With the tension
// ρ g (L - x), the energy of the stated stiffness Y is w (ρ g)² L³ / 6 Y over the square of the factor.
TEST_CASE("measures: the work of keyframes is that of a strip which is pulled up slowly", "[measures]") {
  const Workplace here;
  const auto findings_of = [&](const std::string& bending) {
    const Experiment experiment = parse_experiment(
        R"({"name": "lift", "duration": 7, "mesh": {"cells": 24, "width": 0.5, "height": 0.1},
          "pins": {"vertices": ["left"]},
          "bending": {"model": "discrete_shells", "flexural_rigidity": 1e-5)" +
            bending + R"(},
          "material": {"density": 0.2, "strain": {"stiffness": "physical", "membrane_stiffness": 200,
            "over_time": {"times": [3, 6], "factors": [1, 4]}}},
          "solver": {"membrane": "stated"},
          "effects": [{"type": "gravity", "acceleration": [9.81, 0, 0]},
                      {"type": "viscous_drag", "coefficient": 2}]})",
        "test");
    return execute_run(experiment, experiment.runs.front(), here.folder / ("out" + bending.substr(0, 1)));
  };
  const double tension = 0.2 * 9.81 * 0.5;  // N/m, at the pins
  const double energy = 0.1 * tension * tension * 0.5 / (6 * 200);
  CHECK_THAT(findings_of("").summary.at("keyframe_work"),
             Catch::Matchers::WithinRel(energy * (1 - 1.0 / 4), 0.01));  // strains of at most 0.5 %
  CHECK_FALSE(findings_of(R"(, "hysteresis": {"hb": 1e-5})").summary.contains("keyframe_work"));
}

TEST_CASE("measures: an unknown measure is refused, and the message lists the known measures", "[measures]") {
  CHECK_THROWS_WITH(parse_experiment(R"({"name": "none", "defaults": "paper",
          "output": {"measures": ["motion"]}})",
                                     "test"),
                    Catch::Matchers::ContainsSubstring("/output/measures") &&
                        Catch::Matchers::ContainsSubstring("stability"));
}

TEST_CASE("measures: a metric that no run can have is an error before the first run", "[measures]") {
  Workplace here;
  const auto validate = [&](const std::string& metric, const std::string& more) {
    here.write("e.json", R"({"name": "e", "defaults": "paper",
          "mesh": {"cells": 2}, )" +
                             more + R"("expect": [{"metric": ")" + metric +
                             R"(", "min": 0, "why": "any"}]})");
    return here.run("validate e.json");
  };
  CHECK(validate("max_stretch", "") == 0);
  CHECK(validate("model_whatever", "") == 0);
  CHECK(validate("max_strech", "") == 3);
  CHECK_THAT(here.err(), Catch::Matchers::ContainsSubstring("/expect/0/metric") &&
                             Catch::Matchers::ContainsSubstring("did you mean 'max_stretch'?"));
  CHECK(validate("stability_reach", "") == 3);
  CHECK_THAT(here.err(), Catch::Matchers::ContainsSubstring("stability, to /output/measures"));
  CHECK(validate("stability_reach", R"("output": {"measures": ["stability"]}, )") == 0);
}

TEST_CASE("measures: the median is taken over the last simulated second", "[measures]") {
  const std::vector<Column> columns = {{"a", "1", "any"}, {"b", "1", "any"}};
  const std::vector<double> times = {0, 1, 1.5, 2};
  const std::vector<std::vector<double>> rows = {{100, 1}, {90, 2}, {3, 8}, {1, 5}};
  const FrameHistory frames(columns, times, rows, true);
  CHECK(frames.last_second_median("a") == 2);  // of 3 and 1; the frame at 1 s is a second before the end
  CHECK(FrameHistory(columns, times, rows, false).last_second_median("a") ==
        1);  // times of an equilibrium are steps, not seconds
  CHECK(frames.largest("b") == 8);
  CHECK(frames.last("b") == 5);
  CHECK_THROWS_AS(frames.last("c"), std::logic_error);
}

}  // namespace bendlab::measures_test
