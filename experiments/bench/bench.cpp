#include "experiments/bench/bench.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

#include "bendlab/settings/median.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/machine.hpp"

namespace bendlab {
namespace {

/// Keeps the times that Google Benchmark measured, instead of printing them.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration)
        seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
  }
  std::vector<double> seconds;  // per iteration, of each repetition
};

std::vector<BenchCase> all_cases(const BenchOptions& options) {
  std::vector<BenchCase> all;
  // Set-up cases come first: their peak memory is measured while the heap is as small as in a run.
  for (const auto& family :
       {set_up_cases, cloth_cases, method_cases, effect_cases, run_cases, convergence_cases})
    for (BenchCase& bench_case : family(options)) all.push_back(std::move(bench_case));
  return all;
}

std::regex expression_of(const std::string& filter) {
  try {
    return std::regex(filter);
  } catch (const std::regex_error& error) {
    throw UsageError(fmt::format("--filter '{}' is no regular expression: {}", filter, error.what()));
  }
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  const auto [lowest, highest] = std::ranges::minmax(values);
  return {median(std::move(values)), lowest, highest};
}

std::string bench_id(const std::string& name, const std::string& scalar, int threads) {
  return fmt::format("{}/{}{}", name, scalar, threads > 1 ? fmt::format("/threads:{}", threads) : "");
}

Spread repeated(const std::string& id, int repetitions, double least_s,
                const std::function<double()>& measure) {
  benchmark::ClearRegisteredBenchmarks();
  auto* const registered = benchmark::RegisterBenchmark(id.c_str(), [&](benchmark::State& state) {
    for ([[maybe_unused]] const auto _ : state) state.SetIterationTime(measure());
  });
  registered->UseManualTime()->Repetitions(repetitions);
  least_s > 0 ? registered->MinTime(least_s) : registered->Iterations(1);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, "all");
  benchmark::ClearRegisteredBenchmarks();
  return spread_of(std::move(collector.seconds));
}

Spread ns_per(double count, const Spread& seconds) {
  return {1e9 * seconds.median / count, 1e9 * seconds.lowest / count, 1e9 * seconds.highest / count};
}

StepSeconds timed_step(Simulation& simulation) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = thread_cpu_s();
  if (!simulation.step()) throw std::runtime_error("the cloth of a benchmark diverged");
  const double cpu = thread_cpu_s() - cpu_start;
  return {cpu, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

std::vector<BenchCase> bench_cases(const BenchOptions& options) {
  const std::regex filter = expression_of(options.filter);
  std::vector<BenchCase> all = all_cases(options), chosen;
  std::set<std::string> wanted;
  for (const BenchCase& bench_case : all)
    if (std::regex_search(bench_case.id, filter)) wanted.insert({bench_case.id, bench_case.oracle});
  for (BenchCase& bench_case : all)
    if (wanted.contains(bench_case.id)) chosen.push_back(std::move(bench_case));
  if (chosen.empty())
    throw UsageError(fmt::format(
        "--filter '{}' chooses no benchmark; 'bendlab bench --list' lists all benchmarks", options.filter));
  return chosen;
}

std::vector<BenchRow> run_bench(
    const std::vector<BenchCase>& cases, const std::function<void(const std::string& id)>& on_start,
    const std::function<void(const std::string& id, const std::string& why)>& on_failure) {
  std::vector<BenchRow> rows;
  std::map<std::string, double> ns;  // per id
  for (const BenchCase& bench_case : cases) {
    on_start(bench_case.id);
    try {
      rows.push_back(bench_case.run());
    } catch (const std::exception& error) {
      on_failure(bench_case.id, error.what());
      continue;
    }
    ns[bench_case.id] = rows.back().ns.median;
    if (const auto oracle = ns.find(bench_case.oracle); oracle != ns.end())
      rows.back().ratio_to_oracle = oracle->second / ns[bench_case.id];
  }
  return rows;
}

}  // namespace bendlab
