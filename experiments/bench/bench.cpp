#include "experiments/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

bool has_failed = false;  // a benchmark of this process

/// Leaves out the mean and the deviation, which a single disturbed repetition changes.
template <class Reporter>
class Brief : public Reporter {
 public:
  using Reporter::Reporter;
  using Run = benchmark::BenchmarkReporter::Run;
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> kept = runs;
    std::erase_if(kept, [](const Run& run) {
      return run.aggregate_name == "mean" || run.aggregate_name == "stddev" || run.aggregate_name == "cv";
    });
    if (!kept.empty()) Reporter::ReportRuns(kept);
  }
};

void add_context() {
  const BuildInfo& build = build_info();
  const auto add = [](const char* key, std::string_view value) {
    benchmark::AddCustomContext(key, std::string(value));
  };
  add("processor", processor_name());
  add("compiler", build.compiler);
  add("flags", build.flags);
  add("build_type", build.build_type);
  add("vector_bits", std::to_string(8 * pack_bytes));
  add("version", build.version);
  add("git_commit", build.git_commit);
  add("git_dirty", build.git_dirty ? "true" : "false");
  add("source_hash", build.source_hash);
}

}  // namespace

std::string bench_id(const std::string& name, const std::string& scalar, int threads) {
  return fmt::format("{}/{}{}", name, scalar, threads > 1 ? fmt::format("/threads:{}", threads) : "");
}

benchmark::internal::Benchmark* add_benchmark(const std::string& id,
                                              std::function<void(benchmark::State&)> work) {
  const auto guarded = [work = std::move(work)](benchmark::State& state) {
    try {
      work(state);
    } catch (const std::exception& error) {
      has_failed = true;
      state.SkipWithError(error.what());
    }
  };
  using Values = std::vector<double>;
  return benchmark::RegisterBenchmark(id.c_str(), guarded)
      ->ComputeStatistics("lowest", [](const Values& values) { return std::ranges::min(values); })
      ->ComputeStatistics("highest", [](const Values& values) { return std::ranges::max(values); });
}

double least_s(const BenchOptions& options) {
  return options.quick ? 0.005 : 0.15;
}

void set_counters(benchmark::State& state, std::int64_t vertices, std::int64_t constraints, double items) {
  using benchmark::Counter;
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["constraints"] = static_cast<double>(constraints);
  state.counters["seconds_per_item"] = Counter(items, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

std::pair<std::string, std::shared_ptr<void>>& last_scene() {
  static std::pair<std::string, std::shared_ptr<void>> last;
  return last;
}

StepSeconds timed_step(Simulation& simulation) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = thread_cpu_s();
  if (!simulation.step()) throw std::runtime_error("the cloth of a benchmark diverged");
  const double cpu = thread_cpu_s() - cpu_start;
  return {cpu, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

double cpu_seconds(const std::function<void()>& work) {
  const double start = thread_cpu_s();
  work();
  return thread_cpu_s() - start;
}

int run_benchmarks(const BenchOptions& options) {
  has_failed = false;
  std::vector<std::string> flags = {"bendlab", "--benchmark_report_aggregates_only=true",
                                    "--benchmark_filter=" + options.filter,
                                    fmt::format("--benchmark_repetitions={}", options.repetitions),
                                    fmt::format("--benchmark_list_tests={}", options.list)};
  flags.insert(flags.end(), options.flags.begin(), options.flags.end());
  std::vector<char*> arguments;
  for (std::string& flag : flags) arguments.push_back(flag.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return exit_usage;

  [[maybe_unused]] static const bool is_added = (add_context(), true);
  // Set-up cases come first: their peak memory is measured while the heap is as small as in a run.
  register_set_up_cases(options);
  register_machine_cases(options);
  register_cloth_cases(options);
  register_method_cases(options);
  register_effect_cases(options);
  register_run_cases(options);

  Brief<benchmark::ConsoleReporter> table(benchmark::ConsoleReporter::OO_Tabular);
  Brief<benchmark::JSONReporter> json;
  benchmark::BenchmarkReporter* reporter = &table;
  if (options.json) reporter = &json;
  const std::size_t matches = benchmark::RunSpecifiedBenchmarks(reporter);
  benchmark::ClearRegisteredBenchmarks();
  last_scene() = {};
  return matches == 0 ? exit_usage : has_failed ? exit_failed : exit_ok;
}

}  // namespace bendlab
