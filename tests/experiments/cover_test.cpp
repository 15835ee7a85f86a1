// Covering arrays, compared with a search through all combinations, and sweeps that use them.
#include "experiments/config/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "experiments/config/experiment.hpp"
#include "experiments/config/schema.hpp"
#include "tests/catch.hpp"

namespace bendlab::cover_test {
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

// Calls visit(tuple) for every combination of values of `strength` axes from the axis `from` on. Each call
// appends such a combination to `tuple`.
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
                 [&](const CoverTuple& complete) { all.push_back(complete); });
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

TEST_CASE("cover: for any axes, every combination of the given strength is in a row", "[cover]") {
  std::mt19937_64 generator(1);
  for (int strength = 1; strength <= 4; ++strength)
    for (int trial = 0; trial < 8; ++trial) {
      const Sizes sizes = random_sizes(generator, 1 + generator() % 7,
                                       5);  // also axes with a single value, and fewer axes than the strength
      CAPTURE(strength, sizes);
      const CoverRows cover = covering_rows(sizes, {strength, 1}, anything, most);
      const std::vector<CoverTuple> wanted = tuples(sizes, static_cast<std::size_t>(strength));
      CHECK(cover.tuples == wanted.size());
      CHECK(cover.missing == 0);
      CHECK(cover.impossible.empty());
      CHECK(
          std::ranges::all_of(wanted, [&](const CoverTuple& tuple) { return in_one_of(cover.rows, tuple); }));
      CHECK(std::set<CoverRow>(cover.rows.begin(), cover.rows.end()).size() == cover.rows.size());
      const std::size_t whole =
          std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
      CHECK(cover.rows.size() <= whole);
      if (static_cast<std::size_t>(strength) >= sizes.size()) CHECK(cover.rows.size() == whole);
    }
}

TEST_CASE("cover: refused combinations are in no row and listed, and all other combinations are covered",
          "[cover]") {
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
      const CoverRows cover = covering_rows(sizes, {strength, 1}, allowed, most);
      CHECK(std::ranges::all_of(cover.rows, allowed));
      std::size_t missing = 0;
      for (const CoverTuple& tuple : tuples(sizes, static_cast<std::size_t>(strength))) {
        CHECK(in_one_of(cover.rows, tuple) == in_one_of(possible, tuple));
        missing += !in_one_of(cover.rows, tuple);
      }
      CHECK(cover.missing == missing);
      for (const CoverTuple& tuple : cover.impossible) CHECK_FALSE(in_one_of(possible, tuple));
      CHECK(cover.impossible.empty() == (missing == 0));
    }
  }
}

TEST_CASE("cover: if nothing is allowed there are no rows", "[cover]") {
  const CoverRows none = covering_rows(
      Sizes{2, 3}, {2, 1}, [](const CoverRow&) { return false; }, most);
  CHECK(none.rows.empty());
  CHECK(none.missing == 6);
  CHECK(none.impossible.size() == 5);  // every single value
}

TEST_CASE("cover: without axes there is one row", "[cover]") {
  CHECK(covering_rows(Sizes{}, {3, 1}, anything, most).rows == std::vector<CoverRow>{{}});
  CHECK(covering_rows(Sizes{1, 1}, {3, 1}, anything, most).rows == std::vector<CoverRow>{{0, 0}});
}

TEST_CASE("cover: the same arguments give the same rows, and another seed gives other rows", "[cover]") {
  const Sizes sizes = {4, 3, 5, 2, 3};
  const auto rows = [&](std::uint64_t seed) { return covering_rows(sizes, {2, seed}, anything, most).rows; };
  CHECK(rows(1) == rows(1));
  CHECK(rows(1) != rows(2));
}

// The product of the largest axes is a lower bound. Published sizes of this method: 17 rows for the pairs of
// 13 axes with three values. For the triples of 10 axes with two values, 12 rows are optimal. A greedy search
// may take a quarter more.
TEST_CASE("cover: the number of rows is small", "[cover]") {
  CHECK(covering_rows(plain, {3, 1}, anything, most).rows.size() <= 12 * 9 * 7 * 5 / 4);
  CHECK(covering_rows(Sizes(13, 3), {2, 1}, anything, most).rows.size() <= 17 * 5 / 4);
  CHECK(covering_rows(Sizes(10, 2), {3, 1}, anything, most).rows.size() <= 12 * 3 / 2);
}

TEST_CASE("cover: too many combinations are refused before memory runs out", "[cover]") {
  CHECK_THROWS_AS(covering_rows(Sizes(10, 1000), {3, 1}, anything, most), std::invalid_argument);
  CHECK_THROWS_AS(covering_rows(Sizes{2}, {0, 1}, anything, most), std::invalid_argument);
  CHECK(covering_rows(Sizes{120, 120}, {2, 1}, anything, most).rows.size() == most + 1);
}

TEST_CASE("cover: the runs of a sweep hold every pair of its values", "[cover]") {
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
    for (const auto& [first, value] : run.point)
      for (const auto& [second, partner] : run.point)
        if (first < second) pairs.insert(first + value.dump() + second + partner.dump());
  }
  CHECK(pairs.size() == 6 * 9);
  CHECK(experiment(rest, {R"(/cover={"strength": 1, "seed": 7})"}).runs.size() == 3);
}

TEST_CASE("cover: the limit applies to the covering runs, and an override replaces an axis", "[cover]") {
  std::string rest = R"("cover": 2, "sweep": {"/bending/model": "all")";
  for (const char* pointer :
       {"/mesh/cells", "/solver/iterations", "/solver/substeps", "/mesh/seed", "/initial/seed"})
    rest += fmt::format(R"(, "{}": [1, 2, 3, 4, 5, 6, 7, 8])", pointer);
  rest += "}";
  CHECK(experiment(rest).runs.size() < 200);  // of 393 216 combinations
  const Experiment narrow = experiment(rest, {"/bending/model=none", "/mesh/cells=2"});
  CHECK(narrow.runs.size() < 130);
  for (const RunConfig& run : narrow.runs) CHECK(run.scene().bending.model.name() == "none");
  CHECK(narrow.cover.missing == 0);
}

TEST_CASE("cover: combinations that a rule refuses are left out and reported", "[cover]") {
  const Experiment covered = experiment(R"("cover": 2, "pins": {"vertices": []}, "sweep": {
    "/mesh/generator": ["grid", "tube", "disc"], "/mesh/cells": [2, 4, 6], "/mesh/height": [1, 2]})");
  CHECK(covered.cover.tuples == 9 + 6 + 6);
  CHECK(covered.cover.missing == 1);
  CHECK(covered.cover.refused == std::vector<std::string>{R"(/mesh/generator = "tube", /mesh/cells = 2)"});
  for (const RunConfig& run : covered.runs)
    CHECK_FALSE((run.resolved()["mesh"]["generator"] == "tube" && run.resolved()["mesh"]["cells"] == 2));
}

TEST_CASE("cover: a mistake in every combination is a problem of the config", "[cover]") {
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

TEST_CASE("cover: the schema describes /cover", "[cover]") {
  CHECK(schema_json()["properties"]["cover"]["oneOf"].size() == 2);
  CHECK_THAT(schema_text(), ContainsSubstring("/cover"));
}

}  // namespace bendlab::cover_test
