// Covering arrays by brute force, and sweeps that take one instead of every combination.
#include "experiments/config/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "experiments/config/experiment.hpp"
#include "experiments/config/schema.hpp"
#include "tests/catch.hpp"

namespace bendlab {
namespace {

using Catch::Matchers::ContainsSubstring;
using Sizes = std::vector<std::size_t>;
using Allowed = std::function<bool(const CoverRow&)>;

constexpr std::size_t most = 10000;

bool anything(const CoverRow&) {
  return true;
}

bool has(const CoverRow& row, const CoverTuple& tuple) {
  return std::ranges::all_of(tuple, [&](const auto& part) { return row[part.first] == part.second; });
}

bool in_one_of(const std::vector<CoverRow>& rows, const CoverTuple& tuple) {
  return std::ranges::any_of(rows, [&](const CoverRow& row) { return has(row, tuple); });
}

// Calls visit(tuple) for every combination of values of `strength` axes from `from` on, each added to
// `tuple`.
template <class Visit>
void for_each_tuple(const Sizes& sizes, std::size_t strength, std::size_t from, CoverTuple& tuple,
                    const Visit& visit) {
  if (tuple.size() == strength) return visit(tuple);
  for (std::size_t axis = from; axis < sizes.size(); ++axis)
    for (std::size_t value = 0; value < sizes[axis]; ++value) {
      tuple.emplace_back(axis, value);
      for_each_tuple(sizes, strength, axis + 1, tuple, visit);
      tuple.pop_back();
    }
}

std::vector<CoverTuple> tuples(const Sizes& sizes, std::size_t strength) {
  std::vector<CoverTuple> all;
  CoverTuple tuple;
  for_each_tuple(sizes, std::min(strength, sizes.size()), 0, tuple,
                 [&](const CoverTuple& each) { all.push_back(each); });
  return all;
}

std::vector<CoverRow> product(const Sizes& sizes) {
  std::vector<CoverRow> rows;
  for (const CoverTuple& tuple : tuples(sizes, sizes.size())) {
    CoverRow& row = rows.emplace_back();
    for (const auto& [axis, value] : tuple) row.push_back(value);
  }
  return rows;
}

Sizes random_sizes(std::mt19937_64& generator, std::size_t axes, std::size_t largest) {
  Sizes sizes;
  for (std::size_t a = 0; a < axes; ++a) sizes.push_back(1 + generator() % largest);
  return sizes;
}

// The sizes of the axes of configs/plain/metres.json.
const Sizes plain = {9, 4, 3, 7, 2, 7, 12, 3, 3, 4, 3, 3, 2, 2};

Experiment experiment(const std::string& rest, const std::vector<std::string>& overrides = {}) {
  return parse_experiment(R"({"name": "t", "defaults": "paper", )" + rest + "}", "test", overrides);
}

void check_problem(const std::string& rest, const std::string& pointer, const std::string& message) {
  ConfigProblems problems;
  try {
    experiment(rest);
  } catch (const ConfigError& error) {
    problems = error.problems();
  }
  CAPTURE(rest);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].pointer == pointer);
  CHECK_THAT(problems[0].message, ContainsSubstring(message));
}

}  // namespace

TEST_CASE("cover: every combination of the strength is in a row, whatever the axes", "[cover]") {
  std::mt19937_64 generator(1);
  for (int strength = 1; strength <= 4; ++strength)
    for (int trial = 0; trial < 8; ++trial) {
      const Sizes sizes =
          random_sizes(generator, 1 + generator() % 7, 5);  // axes of one value, fewer axes than the strength
      CAPTURE(strength, sizes);
      const CoverRows found = covering_rows(sizes, {strength, 1}, anything, most);
      const std::vector<CoverTuple> wanted = tuples(sizes, static_cast<std::size_t>(strength));
      CHECK(found.tuples == wanted.size());
      CHECK(found.missing == 0);
      CHECK(found.impossible.empty());
      CHECK(
          std::ranges::all_of(wanted, [&](const CoverTuple& tuple) { return in_one_of(found.rows, tuple); }));
      CHECK(std::set<CoverRow>(found.rows.begin(), found.rows.end()).size() == found.rows.size());
      const std::size_t whole =
          std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
      CHECK(found.rows.size() <= whole);
      if (static_cast<std::size_t>(strength) >= sizes.size()) CHECK(found.rows.size() == whole);
    }
}

TEST_CASE("cover: what is refused is in no row, all else is covered, and the reasons are told", "[cover]") {
  std::mt19937_64 generator(2);
  for (int trial = 0; trial < 12; ++trial) {
    const Sizes sizes = random_sizes(generator, 5, 4);
    const std::vector<CoverTuple> pairs = tuples(sizes, 2), triples = tuples(sizes, 3);
    const std::vector<CoverTuple> forbidden = {pairs[generator() % pairs.size()],
                                               pairs[generator() % pairs.size()],
                                               triples[generator() % triples.size()]};
    const Allowed allowed = [&](const CoverRow& row) {
      return std::ranges::none_of(forbidden, [&](const CoverTuple& tuple) { return has(row, tuple); });
    };
    std::vector<CoverRow> possible = product(sizes);
    std::erase_if(possible, [&](const CoverRow& row) { return !allowed(row); });
    for (const int strength : {1, 2, 3}) {
      CAPTURE(trial, strength, sizes, forbidden);
      const CoverRows found = covering_rows(sizes, {strength, 1}, allowed, most);
      CHECK(std::ranges::all_of(found.rows, allowed));
      std::size_t missing = 0;
      for (const CoverTuple& tuple : tuples(sizes, static_cast<std::size_t>(strength))) {
        CHECK(in_one_of(found.rows, tuple) == in_one_of(possible, tuple));
        missing += !in_one_of(found.rows, tuple);
      }
      CHECK(found.missing == missing);
      for (const CoverTuple& tuple : found.impossible) CHECK_FALSE(in_one_of(possible, tuple));
      CHECK(found.impossible.empty() == (missing == 0));
    }
  }
}

TEST_CASE("cover: where nothing is allowed there is no row", "[cover]") {
  const CoverRows none = covering_rows(
      Sizes{2, 3}, {2, 1}, [](const CoverRow&) { return false; }, most);
  CHECK(none.rows.empty());
  CHECK(none.missing == 6);
  CHECK(none.impossible.size() == 5);  // each value by itself
}

TEST_CASE("cover: nothing to vary is one row", "[cover]") {
  CHECK(covering_rows(Sizes{}, {3, 1}, anything, most).rows == std::vector<CoverRow>{{}});
  CHECK(covering_rows(Sizes{1, 1}, {3, 1}, anything, most).rows == std::vector<CoverRow>{{0, 0}});
}

TEST_CASE("cover: the same arguments give the same rows, another seed others", "[cover]") {
  const Sizes sizes = {4, 3, 5, 2, 3};
  const auto rows = [&](std::uint64_t seed) { return covering_rows(sizes, {2, seed}, anything, most).rows; };
  CHECK(rows(1) == rows(1));
  CHECK(rows(1) != rows(2));
}

// At least the product of the largest axes is needed. Published sizes of the method it follows: 17 rows for
// the pairs of 13 axes of three values, 10 axes of two values in 12 rows for triples or fewer is optimal; a
// greedy search may take a quarter more.
TEST_CASE("cover: few rows, in little time", "[cover]") {
  const auto start = std::chrono::steady_clock::now();
  CHECK(covering_rows(plain, {3, 1}, anything, most).rows.size() <= 12 * 9 * 7 * 5 / 4);
  CHECK(covering_rows(Sizes(13, 3), {2, 1}, anything, most).rows.size() <= 17 * 5 / 4);
  CHECK(covering_rows(Sizes(10, 2), {3, 1}, anything, most).rows.size() <= 12 * 3 / 2);
  CHECK(std::chrono::steady_clock::now() - start <
        std::chrono::seconds(20));  // 0.5 s alone; a debug build on a busy machine
}

TEST_CASE("cover: too much is refused before memory is", "[cover]") {
  CHECK_THROWS_AS(covering_rows(Sizes(10, 1000), {3, 1}, anything, most), std::invalid_argument);
  CHECK_THROWS_AS(covering_rows(Sizes{2}, {0, 1}, anything, most), std::invalid_argument);
  CHECK(covering_rows(Sizes{120, 120}, {2, 1}, anything, most).rows.size() == most + 1);
}

TEST_CASE("cover: a sweep's runs hold every pair of its values", "[cover]") {
  const std::string rest = R"("cover": 2, "sweep": {
    "/mesh": [{"generator": "grid", "cells": 4}, {"generator": "disc", "cells": 3}, {"file": "a.obj"}],
    "/pins/vertices": [[], ["top"], ["centre"]],
    "/bending/model": ["none", "lod", "dihedral"], "/bending/k": [0.1, 0.5, 1]})";
  const Experiment covered = experiment(rest), whole = experiment(rest, {"/cover=4"});
  CHECK(whole.runs.size() == 81);
  CHECK(covered.runs.size() >= 9);
  CHECK(covered.runs.size() <= 14);
  CHECK(covered.cover.strength == 2);
  CHECK(covered.cover.tuples == 6 * 9);
  CHECK(covered.cover.missing == 0);
  std::set<std::string> pairs;
  for (const RunConfig& run : covered.runs) {
    REQUIRE(run.point.size() == 4);
    for (const auto& [one, value] : run.point)
      for (const auto& [other, with] : run.point)
        if (one < other) pairs.insert(one + value.dump() + other + with.dump());
  }
  CHECK(pairs.size() == 6 * 9);
  CHECK(experiment(rest, {R"(/cover={"strength": 1, "seed": 7})"}).runs.size() == 3);
}

TEST_CASE("cover: the limit is on what is run, and an override narrows an axis", "[cover]") {
  std::string rest = R"("cover": 2, "sweep": {"/bending/model": "all")";
  for (const char* pointer :
       {"/mesh/cells", "/solver/iterations", "/solver/substeps", "/mesh/seed", "/initial/seed"})
    rest += fmt::format(R"(, "{}": [1, 2, 3, 4, 5, 6, 7, 8])", pointer);
  rest += "}";
  CHECK(experiment(rest).runs.size() < 200);  // of 393 216
  const Experiment narrow = experiment(rest, {"/bending/model=none", "/mesh/cells=2"});
  CHECK(narrow.runs.size() < 130);
  for (const RunConfig& run : narrow.runs) CHECK(run.scene().bending.model.name() == "none");
  CHECK(narrow.cover.missing == 0);
}

TEST_CASE("cover: combinations that a rule refuses are left out and told", "[cover]") {
  const Experiment covered = experiment(R"("cover": 2, "pins": {"vertices": []}, "sweep": {
    "/mesh/generator": ["grid", "tube", "disc"], "/mesh/cells": [2, 4, 6], "/mesh/height": [1, 2]})");
  CHECK(covered.cover.tuples == 9 + 6 + 6);
  CHECK(covered.cover.missing == 1);
  CHECK(covered.cover.refused == std::vector<std::string>{R"(/mesh/generator = "tube", /mesh/cells = 2)"});
  for (const RunConfig& run : covered.runs)
    CHECK_FALSE((run.resolved()["mesh"]["generator"] == "tube" && run.resolved()["mesh"]["cells"] == 2));
}

TEST_CASE("cover: what is wrong in every combination is a problem", "[cover]") {
  check_problem(R"("cover": 2, "sweep": {"/mesh/cells": [2, 0], "/bending/k": [0.1, 0.2]})",
                "/sweep/~1mesh~1cells/1", "got 0");
  check_problem(R"("cover": 2, "sweep": {"/mesh/cels": [2, 0]})", "/sweep/~1mesh~1cels", "cannot be swept");
  check_problem(R"("cover": 2, "pins": {"rings": 2}, "sweep": {"/mesh/cells": [2, 4]})", "/pins/rings",
                "there is no setting 'rings'");
  check_problem(R"("cover": 2, "pins": {"rings": 2})", "/pins/rings", "there is no setting 'rings'");
  check_problem(R"("cover": 0, "sweep": {"/mesh/cells": [2, 4]})", "/cover/strength", "from 1 to 6");
  check_problem(R"("cover": {"seed": 2})", "/cover/strength", "is missing");
  check_problem(R"("cover": "all")", "/cover", "expected a strength");
  check_problem(R"("cover": {"strength": 2, "sed": 2})", "/cover/sed", "no setting 'sed'");
}

TEST_CASE("cover: the schema knows it", "[cover]") {
  CHECK(schema_json()["properties"]["cover"]["oneOf"].size() == 2);
  CHECK_THAT(schema_text(), ContainsSubstring("/cover"));
}

}  // namespace bendlab
