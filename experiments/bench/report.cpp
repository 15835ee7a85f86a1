#include <fmt/format.h>

#include <cmath>

#include "bendlab/constraints/pack.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/roofline.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/version.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

constexpr int schema_version = 1;  // raised when a key changes its meaning

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json row_json(const BenchRow& row) {
  Json json = {{"name", row.name},
               {"scalar", row.scalar},
               {"threads", row.threads},
               {"vertices", row.vertices},
               {"constraints", row.constraints},
               {"ns_per_constraint", row.ns.median},
               {"ns_lowest", row.ns.lowest},
               {"ns_highest", row.ns.highest},
               {"repetitions", row.repetitions},
               {"ratio_to_oracle", json_of(row.ratio_to_oracle)},
               {"roofline_fraction", json_of(row.roofline_fraction)}};
  json.update(row.more);
  return json;
}

std::string cell(double value, const char* format = "{:.2f}") {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "";
}

std::string more_text(const Json& more) {
  std::string text;
  for (const auto& [key, value] : more.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, format_number(value.get<double>()));
  return text;
}

}  // namespace

Json bench_context() {
  const BuildInfo& build = build_info();
  const auto gigabytes = [](std::size_t kilobytes) { return 1e-9 * triad_bandwidth(kilobytes << 10); };
  return {{"schema_version", schema_version},
          {"date", utc_now()},
          {"host", host_name()},
          {"processor", processor_name()},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"build_type", build.build_type},
          {"vector_bits", 8 * pack_bytes},
          {"version", build.version},
          {"git_commit", build.git_commit},
          {"git_dirty", build.git_dirty},
          {"source_hash", build.source_hash},
          {"triad_16_KiB_GB_per_s", gigabytes(16)},
          {"triad_512_KiB_GB_per_s", gigabytes(512)},
          {"triad_8_MiB_GB_per_s", gigabytes(8 << 10)},
          {"triad_256_MiB_GB_per_s", gigabytes(256 << 10)},
          {"peak_float_Gflop_per_s", 1e-9 * peak_flops(sizeof(float))},
          {"peak_double_Gflop_per_s", 1e-9 * peak_flops(sizeof(double))}};
}

std::string bench_json(const std::vector<BenchRow>& rows) {
  std::string text = fmt::format("{{\"context\": {},\n \"rows\": [", bench_context().dump(2));
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += fmt::format("{}\n  {}", i ? "," : "", row_json(rows[i]).dump());
  return text + "\n]}\n";
}

std::string bench_text(const std::vector<BenchRow>& rows) {
  Table table({"benchmark", "scalar", "threads", "vertices", "constraints", "ns", "lowest", "highest",
               "× oracle", "roofline", "other values"});
  for (const BenchRow& row : rows)
    table.add_row({row.name, row.scalar, std::to_string(row.threads), std::to_string(row.vertices),
                   std::to_string(row.constraints), cell(row.ns.median), cell(row.ns.lowest),
                   cell(row.ns.highest), cell(row.ratio_to_oracle.value_or(NAN), "{:.1f}"),
                   cell(row.roofline_fraction.value_or(NAN)), more_text(row.more)});
  const Json context = bench_context();
  std::string text =
      fmt::format("{} ({} bits), {}\n", processor_name(), 8 * pack_bytes, build_info().compiler);
  text += fmt::format(
      "triad {:.0f}, {:.0f}, {:.0f} and {:.0f} GB/s on 16 KiB, 512 KiB, 8 MiB and 256 MiB; peak {:.0f} "
      "Gflop/s in float, {:.0f} in double\nns per constraint and projection (set_up: per spring; effect: per "
      "vertex and step; method: per vertex and iteration; solve: per vertex): median, lowest and highest of "
      "the repetitions; CPU time for one thread, wall time for several\n\n",
      context["triad_16_KiB_GB_per_s"].get<double>(), context["triad_512_KiB_GB_per_s"].get<double>(),
      context["triad_8_MiB_GB_per_s"].get<double>(), context["triad_256_MiB_GB_per_s"].get<double>(),
      context["peak_float_Gflop_per_s"].get<double>(), context["peak_double_Gflop_per_s"].get<double>());
  return text + table.text();
}

}  // namespace bendlab
