#include "experiments/config/expectations.hpp"

#include <cmath>
#include <string>

#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::expectations_test {
using Catch::Matchers::ContainsSubstring;

namespace {

Experiment with_expect(const std::string& expect, const std::string& rest = "") {
  return parse_experiment(R"({"name": "t", "defaults": "paper",
          )" + rest + R"("expect": )" +
                              expect + "}",
                          "test");
}

void check_problem(const std::string& expect, const std::string& pointer, const std::string& message) {
  CAPTURE(expect);
  try {
    with_expect(expect);
    FAIL("accepted");
  } catch (const ConfigError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].pointer == pointer);
    CHECK_THAT(error.problems()[0].message, ContainsSubstring(message));
  }
}

std::vector<ExpectationResult> results(const Experiment& experiment, std::size_t run, double drop) {
  return check_expectations(experiment.expectations, experiment.runs.at(run),
                            {{"drop", drop}, {"max_stretch", 1.5}});
}

}  // namespace

TEST_CASE("expect: bounds are inclusive, and min, max or both may be stated") {
  const Experiment experiment =
      with_expect(R"([{"metric": "drop", "min": 1, "max": 2, "why": "length of the sheet"},
                                                {"metric": "drop", "max": 1.5, "why": "w"},
                                                {"metric": "drop", "min": 1.5, "why": "w"}])");
  const auto holds = [&](double drop) {
    std::string pattern;
    for (const ExpectationResult& result : results(experiment, 0, drop)) pattern += result.holds ? 'y' : 'n';
    return pattern;
  };
  CHECK(holds(1) == "yyn");
  CHECK(holds(1.5) == "yyy");
  CHECK(holds(2) == "yny");
  CHECK(holds(0.99) == "nyn");
  CHECK(holds(2.01) == "nny");
  CHECK(holds(std::nan("")) == "nnn");
  const ExpectationResult result = results(experiment, 0, 1.25).at(0);
  CHECK(result.measured == 1.25);
  CHECK(result.message == "drop = 1.25, expected at least 1 and at most 2: length of the sheet");
}

TEST_CASE(
    "expect: an unknown metric fails, and the message names the nearest metric and where all are listed") {
  const ExpectationResult result =
      results(with_expect(R"([{"metric": "dropp", "min": 0, "why": "w"}])"), 0, 1).at(0);
  CHECK_FALSE(result.holds);
  CHECK_FALSE(result.measured.has_value());
  CHECK_THAT(result.message, ContainsSubstring("did you mean 'drop'?") &&
                                 ContainsSubstring("`bendlab show` lists the metrics of a run"));
}

TEST_CASE("expect: `where` selects runs by their values") {
  const Experiment experiment = with_expect(
      R"([{"metric": "drop", "min": 0, "why": "w",
           "where": {"/bending/model": "adaptive", "/mesh/cells": 32.0}},
          {"metric": "drop", "min": 0, "why": "w", "where": {"/bending/adaptive/m_min": 1}},
          {"metric": "drop", "min": 0, "why": "w", "where": {"/effects": [{"type": "gravity"}]}},
          {"metric": "drop", "min": 0, "why": "w"}])",
      R"("sweep": {"/bending/model": ["none", "adaptive"], "/mesh/cells": [16, 32]},)");
  REQUIRE(experiment.runs.size() == 4);
  CHECK(results(experiment, 0, 1).size() == 2);  // model none, which has no m_min
  CHECK(results(experiment, 1, 1).size() == 2);
  CHECK(results(experiment, 2, 1).size() == 3);  // adaptive at 16
  CHECK(results(experiment, 3, 1).size() == 4);  // adaptive at 32
}

TEST_CASE("expect: wrong entries are refused") {
  check_problem(R"([{"metric": "drop", "min": 0}])", "/expect/0/why", "is missing");
  check_problem(R"([{"min": 0, "why": "w"}])", "/expect/0/metric", "is missing");
  check_problem(R"([{"metric": "drop", "why": "w"}])", "/expect/0", "give min, max or both");
  check_problem(R"([{"metric": "drop", "why": "w", "min": 2, "max": 1}])", "/expect/0",
                "min is larger than max");
  check_problem(R"([{"metric": "drop", "why": "", "min": 2}])", "/expect/0/why", "must not be empty");
  check_problem(R"([{"metric": "drop", "why": "w", "mni": 2, "max": 1}])", "/expect/0/mni",
                "did you mean 'min'?");
  check_problem(R"(["drop"])", "/expect/0", "expected an object");
  const auto where = [](const std::string& value) {
    return R"([{"metric": "drop", "why": "w", "min": 2, "where": )" + value + "}]";
  };
  check_problem(where("1"), "/expect/0/where", "expected an object");
  check_problem(where(R"({"/mesh/cels": 1})"), "/expect/0/where/~1mesh~1cels", "did you mean '/mesh/cells'?");
  check_problem(where(R"({"/mesh/cells": 0})"), "/expect/0/where/~1mesh~1cells", "from 1 to 4096");
  check_problem(where(R"({"/mesh/cells": 31})"), "/expect/0/where", "matches no run");
}

TEST_CASE("expect: an override may leave an expectation without runs") {
  const std::string text = R"({"name": "t", "defaults": "paper",
          "expect": [{"metric": "drop", "min": 0, "why": "w",
                                                        "where": {"/mesh/cells": 32}}]})";
  const std::vector<std::string> overrides = {"/mesh/cells=4"};
  CHECK_NOTHROW(parse_experiment(text, "test", overrides));
}

}  // namespace bendlab::expectations_test
