// `bendlab bench` measures, and programs can read its output.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "bendlab/effects/effect.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/roofline.hpp"
#include "experiments/run/errors.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

std::string output_of(const std::string& arguments) {
  std::FILE* const pipe =
      popen(("'" + std::string(places::program) + "' bench --quick " + arguments).c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  for (std::array<char, 4096> buffer;
       const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe);)
    text.append(buffer.data(), count);
  CHECK(pclose(pipe) == 0);
  return text;
}

nlohmann::json rows_of(const std::string& filter) {
  return nlohmann::json::parse(output_of("--json --repetitions 2 --filter '" + filter + "'")).at("rows");
}

}  // namespace

TEST_CASE("bench prints a context and a row per benchmark as JSON", "[bench]") {
  const auto json =
      nlohmann::json::parse(output_of("--json --repetitions 3 --filter '^(strain|crossover)/32/float'"));
  for (const char* key :
       {"schema_version", "date", "host", "processor", "compiler", "flags", "vector_bits"}) {
    INFO(key);
    CHECK(json.at("context").contains(key));
  }
  const auto& rows = json.at("rows");
  REQUIRE(rows.size() == 4);  // the two kernels, and before them their oracles
  for (const auto& row : rows) {
    CHECK(row.at("scalar") == "float");
    CHECK(row.at("threads") == 1);
    CHECK(row.at("vertices") == 33 * 33);
    CHECK(row.at("repetitions") == 3);
    CHECK(row.at("ns_lowest") <= row.at("ns_per_constraint"));
    CHECK(row.at("ns_per_constraint") <= row.at("ns_highest"));
    CHECK(row.at("roofline_fraction") > 0);
  }
  CHECK(rows[2].at("name") == "strain/32");
  CHECK(rows[2].at("constraints") == 2 * 32 * 32);           // no triangle has three corners on a pinned side
  CHECK(rows[3].at("constraints") == 3 * 32 * 32 - 2 * 32);  // interior edges
  CHECK(rows[0].at("ratio_to_oracle").is_null());
  const double ratio =
      rows[0].at("ns_per_constraint").get<double>() / rows[2].at("ns_per_constraint").get<double>();
  CHECK_THAT(rows[2].at("ratio_to_oracle").get<double>(),
             WithinRel(ratio, 1e-12));  // the rounding of a division
}

TEST_CASE("bench measures set-up, recording, sweeps and convergence", "[bench]") {
  const auto rows = rows_of("^(set_up|recording|sweep|convergence/corner/10)/");
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].at("peak_bytes_per_spring") > 0);
  CHECK(rows[0].at("springs_per_s") > 0);
  CHECK(rows[1].at("wall_ratio") > 0);
  CHECK(rows[1].at("writer_cpu_s") > 0);
  CHECK(rows[2].at("speed_up") > 0);
  CHECK(rows[3].at("ns_per_constraint").is_null());
  CHECK(rows[3].at("colour_over_mesh") > 0);
}

TEST_CASE("bench measures the solver methods and the parts of quasi_newton", "[bench]") {
  const auto rows = rows_of("^(method|gradient|solve|law)");
  const auto row = [&](const std::string& name, const std::string& scalar, int threads = 1) {
    INFO(name << " " << scalar << " " << threads);
    const auto match = std::ranges::find_if(rows, [&](const auto& entry) {
      return entry.at("name") == name && entry.at("scalar") == scalar && entry.at("threads") == threads;
    });
    REQUIRE(match != rows.end());
    CHECK(match->at("ns_per_constraint") > 0);
    return *match;
  };
  for (const char* scalar : {"float", "double"}) {
    for (const char* method : {"method/pbd/32", "method/quasi_newton/32"}) {
      CHECK(row(method, scalar).at("constraints") == 33 * 33);  // per vertex
      row(method, scalar, 2);
    }
    for (const char* part : {"gradient/32", "solve/32"}) {
      CHECK(row(part, scalar).at("ratio_to_oracle") > 0);
      CHECK(row(part, scalar).at("roofline_fraction") > 0);
    }
    // The timed gradient agrees with the oracle, up to the rounding of float for a stiff membrane.
    CHECK_THAT(row("gradient/32", scalar).at("force_N").get<double>(),
               WithinRel(row("gradient_oracle/32", "double").at("force_N").get<double>(), 0.01));
  }
  for (const char* method : {"method/newton/32", "method/vbd/32"}) row(method, "double");
  for (const char* method : {"pbd", "quasi_newton"})
    for (const char* law : {"discrete_shells/one_rigidity", "mid_edge/friction"})
      CHECK(row(fmt::format("law/{}/{}/32", method, law), "float").at("step_ms") > 0);
  CHECK(row("solve/32", "float").at("entries_per_vertex") > 5);
  CHECK(row("method/quasi_newton/32", "float").at("roofline_fraction") > 0);
}

TEST_CASE("the lower bound for the time of a solve counts every entry twice", "[bench]") {
  constexpr std::size_t entries = std::size_t{1} << 20;
  CHECK(solve_roofline_seconds(entries, 4) >= 12.0 * entries / peak_flops(4));
  CHECK(solve_roofline_seconds(entries, 8) >= 16.0 * entries / triad_bandwidth(8 * entries));
}

TEST_CASE("bench prints a table with the spread beside the median", "[bench]") {
  const std::string table = output_of("--repetitions 2 --filter '^dense/32/double'");
  for (const char* text : {"dense/32", "dense_oracle/32", "lowest", "highest", "roofline", "GB/s"})
    CHECK_THAT(table, ContainsSubstring(text));
}

TEST_CASE("a filter that matches no benchmark is an error", "[bench]") {
  CHECK_THROWS_AS(bench_cases({.filter = "no such benchmark"}), UsageError);
  CHECK_THROWS_AS(bench_cases({.filter = "("}), UsageError);
}

TEST_CASE("median and range of a few values are right", "[bench]") {
  const Spread odd = spread_of({5, 1, 3}), even = spread_of({4, 1, 3, 2});
  CHECK(odd.median == 3);
  CHECK(odd.lowest == 1);
  CHECK(odd.highest == 5);
  CHECK(even.median == 2.5);
  CHECK(std::isnan(spread_of({}).median));
}

TEST_CASE("the roofline model counts the bytes that a constraint moves", "[bench]") {
  CHECK(streamed_bytes(distance_cost, 4) == 4 + 4);        // index of the end, rest length
  CHECK(streamed_bytes(strain_cost, 8) == 3 * 4 + 4 * 8);  // three indices, Q⁻¹
  // No kernel can beat either limit: flops at the peak, streamed bytes at the bandwidth of their cache level.
  const std::size_t scene = std::size_t{1} << 22;
  const double least = roofline_seconds(strain_cost, 4, 0.5, scene);
  CHECK(least >= strain_cost.flops / peak_flops(4));
  CHECK(least >= 28 / triad_bandwidth(scene));
}

TEST_CASE("bench measures every effect in a scene where it acts", "[bench][effects]") {
  const nlohmann::json rows = rows_of("^effect/");
  for (const EffectKind* effect : effects()) {
    INFO(effect->name);
    const std::string name = "effect/" + std::string(effect->name) + "/32";
    const auto row = std::ranges::find_if(rows, [&](const auto& entry) { return entry.at("name") == name; });
    REQUIRE(row != rows.end());
    CHECK(row->at("acted_per_step") > 0);
    CHECK(row->at("ns_per_constraint") > 0);
  }
}

TEST_CASE("bench: a case that fails is reported, and the other cases are measured", "[bench]") {
  const auto row = [](double ns) { return [ns] { return BenchRow{.ns = {.median = ns}}; }; };
  const auto fails = []() -> BenchRow { throw std::runtime_error("no such luck"); };
  const std::vector<BenchCase> cases = {
      {"lost", "", fails}, {"oracle", "", row(6)}, {"kernel", "oracle", row(2)}, {"other", "lost", row(1)}};
  std::string failures;
  const std::vector<BenchRow> rows = run_bench(
      cases, [](const std::string&) {},
      [&](const std::string& id, const std::string& why) { failures += id + why; });
  CHECK(failures == "lostno such luck");
  REQUIRE(rows.size() == 3);
  CHECK(rows[1].ratio_to_oracle == 3.0);
  CHECK_FALSE(rows[2].ratio_to_oracle);
}

}  // namespace bendlab
