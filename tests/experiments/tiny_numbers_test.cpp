// Stiffnesses, lengths and masses near the smallest and largest numbers. In any precision, a sheet with
// hardly any bending stiffness hangs like a sheet without, and no number becomes infinite.
#include <cmath>
#include <string>

#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::tiny_numbers_test {
namespace {

using Catch::Matchers::WithinRel;
using nlohmann::json;
using test::Workplace;

// A square of 6 cells pinned at a corner.
std::string config(const std::string& bending, const std::string& more) {
  const bool has_solver = more.find("\"solver\"") != std::string::npos;
  return R"({"name": "tiny", "duration": 0.5, "mesh": {"cells": 6}, "output": {"frames_per_second": 10},
             "bending": )" +
         bending + more + (has_solver ? "}" : R"(, "solver": {"method": "pbd"}})");
}

double drop_without_bending(Workplace& here, const std::string& more = "") {
  here.write("none.json", config(R"({"model": "none"})", more));
  REQUIRE(here.run("run none.json --json") == 0);
  return here.out_lines().at(0).at("summary").at("drop").get<double>();
}

TEST_CASE("A sheet with hardly any bending stiffness hangs like a sheet without", "[tiny]") {
  Workplace here;
  const double drop = drop_without_bending(here);
  here.write("tiny.json", config(R"({"flexural_rigidity": 1e-20})", R"(,
      "sweep": {"/bending/flexural_rigidity": [1e-20, 1e-36, 1e-50, 1e-300],
                "/bending/model": ["discrete_shells", "isometric", "choi_ko", "adaptive", "lod", "sparse_lod",
                                   "prestressed"],
                "/solver/precision": ["single", "double"]})"));
  REQUIRE(here.run("run tiny.json --json") == 0);
  for (const json& run : here.out_lines()) {
    INFO(run.at("point"));
    CHECK(run.at("status") == "complete");
    // Another model means another order of constraints, so the rounding in single precision differs.
    CHECK_THAT(run.at("summary").at("drop").get<double>(), WithinRel(drop, 1e-3));
  }
}

TEST_CASE("A compliance beyond the range of single precision means no bending stiffness", "[tiny]") {
  Workplace here;
  const double drop = drop_without_bending(here);
  here.write("soft.json", config(R"({"compliance": 1})", R"(,
      "sweep": {"/bending/compliance": [1e30, 1e45, 1e300],
                "/bending/model": ["discrete_shells", "choi_ko", "adaptive", "sparse_lod"]})"));
  REQUIRE(here.run("run soft.json --json") == 0);
  for (const json& run : here.out_lines()) {
    INFO(run.at("point"));
    CHECK_THAT(run.at("summary").at("drop").get<double>(), WithinRel(drop, 1e-3));
  }
}

TEST_CASE("Implicit steps and an equilibrium work with a tiny rigidity, too", "[tiny]") {
  Workplace here;
  const std::string membrane = R"(, "material": {"strain": {"stiffness": "compliance", "compliance": 1e-3}})";
  for (const std::string method : {"quasi_newton", "vbd", "newton"}) {
    INFO(method);
    const std::string more = membrane + R"(, "solver": {"method": ")" + method + R"("})";
    const double drop = drop_without_bending(here, more);
    here.write("tiny.json", config(R"({"flexural_rigidity": 1e-20})", more + R"(,
        "sweep": {"/bending/flexural_rigidity": [1e-20, 1e-50],
                  "/bending/model": ["discrete_shells", "adaptive"]})"));
    REQUIRE(here.run("run tiny.json --json") == 0);
    for (const json& run : here.out_lines()) {
      INFO(run.at("point"));
      // Iterations have not converged, so the result depends slightly on the order of sums.
      CHECK_THAT(run.at("summary").at("drop").get<double>(), WithinRel(drop, 0.01));
    }
  }
}

}  // namespace
}  // namespace bendlab::tiny_numbers_test
