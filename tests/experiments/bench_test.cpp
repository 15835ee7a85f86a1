// `bendlab bench` measures, and programs can read its output.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bendlab/effects/effect.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/run/errors.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::bench_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

std::string output_of(const std::string& arguments) {
  std::FILE* const pipe = popen(
      ("'" + std::string(places::program) + "' bench --quick " + arguments + " 2>/dev/null").c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  for (std::array<char, 4096> buffer;
       const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe);)
    text.append(buffer.data(), count);
  CHECK(pclose(pipe) == 0);
  return text;
}

/// Name of a benchmark, without what Google Benchmark adds to it → its median, lowest or highest values.
std::map<std::string, nlohmann::json> rows_of(const std::string& filter,
                                              const std::string& statistic = "median") {
  const auto json = nlohmann::json::parse(output_of("--json --repetitions 3 --filter '" + filter + "'"));
  std::map<std::string, nlohmann::json> rows;
  for (const auto& row : json.at("benchmarks")) {
    const std::string name = row.at("run_name");
    const std::size_t end = std::min(name.find("/min_time"), name.find("/iterations"));
    if (row.at("aggregate_name") == statistic) rows[name.substr(0, end)] = row;
  }
  return rows;
}

}  // namespace

TEST_CASE("bench prints the context and the range of each benchmark as JSON", "[bench]") {
  const auto json = nlohmann::json::parse(
      output_of("--json --repetitions 3 --filter '^(strain|crossover)(_oracle)?/32/float'"));
  for (const char* key :
       {"date", "host_name", "processor", "compiler", "flags", "vector_bits", "git_commit"}) {
    INFO(key);
    CHECK(json.at("context").contains(key));
  }
  const auto& rows = json.at("benchmarks");
  REQUIRE(rows.size() == 3 * 4);  // median, lowest and highest of two kernels and their oracles
  for (std::size_t first = 0; first < rows.size(); first += 3) {
    for (const char* time : {"real_time", "seconds_per_item"}) {
      INFO(rows[first].at("run_name") << " " << time);
      CHECK(rows[first + 1].at(time) > 0);
      CHECK(rows[first + 1].at(time) <= rows[first].at(time));
      CHECK(rows[first].at(time) <= rows[first + 2].at(time));
    }
    CHECK(rows[first].at("vertices") == 33 * 33);
    CHECK(rows[first].at("repetitions") == 3);
  }
  const auto& strain = rows[6];
  CHECK_THAT(strain.at("run_name").get<std::string>(), ContainsSubstring("strain/32/float"));
  CHECK(strain.at("constraints") == 2 * 32 * 32);            // no triangle has three corners on a pinned side
  CHECK(rows[9].at("constraints") == 3 * 32 * 32 - 2 * 32);  // interior edges
  CHECK_THAT(1e9 * strain.at("seconds_per_item").get<double>() * 10 * 2 * 32 * 32,  // ten iterations
             WithinRel(strain.at("real_time").get<double>(), 1e-9));  // of the medians of three equal ratios
}

TEST_CASE("bench measures set-up, recording, sweeps and the limits of the machine", "[bench]") {
  const auto rows = rows_of("^(set_up|recording|sweep|triad/16384|peak/float)/");
  REQUIRE(rows.size() == 5);
  CHECK(rows.at("set_up/32/float").at("peak_bytes_per_spring") > 0);
  CHECK(rows.at("set_up/32/float").at("rings_and_pairs_s") > 0);
  CHECK(rows.at("recording/16/float/threads:2").at("wall_ratio") > 0);
  CHECK(rows.at("recording/16/float/threads:2").at("writer_cpu_s") > 0);
  CHECK(rows.at("sweep/8/float/threads:2").at("speed_up") > 0);
  CHECK(rows.at("triad/16384").at("bytes_per_second") > 0);
  CHECK(rows.at("peak/float").at("flop_per_second") > 0);
}

TEST_CASE("bench measures the solver methods and the parts of quasi_newton", "[bench][slow]") {
  const auto rows = rows_of("^(method|gradient|solve|law)");
  const auto row = [&](const std::string& id) {
    INFO(id);
    REQUIRE(rows.contains(id));
    CHECK(rows.at(id).at("seconds_per_item") > 0);
    return rows.at(id);
  };
  row("solve_oracle/32/double");
  for (const char* scalar : {"float", "double"}) {
    for (const char* method : {"method/pbd/32", "method/quasi_newton/32"}) {
      CHECK(row(bench_id(method, scalar)).at("constraints") == 33 * 33);  // per vertex
      row(bench_id(method, scalar, 2));
    }
    CHECK(row(bench_id("solve/32", scalar)).at("bytes_per_second") > 0);
    // The timed gradient agrees with the oracle, up to the rounding of float for a stiff membrane.
    CHECK_THAT(row(bench_id("gradient/32", scalar)).at("force_N").get<double>(),
               WithinRel(row("gradient_oracle/32/double").at("force_N").get<double>(), 0.01));
  }
  for (const char* method : {"method/newton/32", "method/vbd/32"}) row(bench_id(method, "double"));
  for (const char* method : {"pbd", "quasi_newton"})
    for (const char* law : {"discrete_shells/one_rigidity", "mid_edge/friction"})
      row(fmt::format("law/{}/{}/32/float", method, law));
}

TEST_CASE("bench prints a table with the range below the median", "[bench]") {
  const std::string table = output_of("--repetitions 2 --filter '^dense(_oracle)?/32/double'");
  for (const char* text : {"dense/32", "dense_oracle/32", "median", "lowest", "highest", "seconds_per_item"})
    CHECK_THAT(table, ContainsSubstring(text));
}

TEST_CASE("bench measures every effect in a scene where it acts", "[bench][effects]") {
  const auto rows = rows_of("^effect/");
  for (const EffectKind* effect : effects()) {
    const std::string id = fmt::format("effect/{}/32/float", effect->name);
    INFO(id);
    REQUIRE(rows.contains(id));
    CHECK(rows.at(id).at("acted_per_step") > 0);
    CHECK(rows.at(id).at("seconds_per_item") > 0);
  }
}

TEST_CASE("bench: an error of a benchmark is reported, the others are measured, and no match is wrong usage",
          "[bench]") {
  add_benchmark("lost", [](benchmark::State&) { throw std::runtime_error("no such luck"); });
  std::ostringstream output;
  std::streambuf* const before = std::cout.rdbuf(output.rdbuf());
  const int code =
      run_benchmarks({.filter = "^(lost|peak/float)", .quick = true, .repetitions = 2, .json = true});
  std::cout.rdbuf(before);
  CHECK(code == exit_failed);
  const auto rows = nlohmann::json::parse(output.str()).at("benchmarks");
  CHECK(rows.size() == 2 + 3);  // two repetitions that failed; median, lowest and highest
  CHECK(rows[0].at("error_message") == "no such luck");
  CHECK(run_benchmarks({.filter = "no such benchmark"}) == exit_usage);
  CHECK(run_benchmarks({.filter = "("}) == exit_usage);
}

}  // namespace bendlab::bench_test
