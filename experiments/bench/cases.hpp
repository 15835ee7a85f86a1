// The benchmarks, and what they have in common.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace bendlab {

class Simulation;
struct BenchOptions;

/// Bandwidths of caches and memory, and the rate of floating-point operations.
void register_machine_cases(const BenchOptions& options);

/// Strain, crossover springs, dense rings and whole steps on a moving cloth, and their oracles.
void register_cloth_cases(const BenchOptions& options);

/// Time of each effect's passes in a step, per vertex, for several sizes.
void register_effect_cases(const BenchOptions& options);

/// An iteration of each solver method, per vertex, for several sizes; also gradient and solve of quasi_newton
/// alone.
void register_method_cases(const BenchOptions& options);

/// Time and peak memory of setting up the rings, pairs, colours and batches of `adaptive`.
void register_set_up_cases(const BenchOptions& options);

/// The time that recording adds to a run, and the time of eight runs with one job and with two.
void register_run_cases(const BenchOptions& options);

/// `name/scalar[/threads:N]`.
std::string bench_id(const std::string& name, const std::string& scalar, int threads = 1);

/// Registers a benchmark that reports the lowest and the highest value of its repetitions. If `work` throws,
/// this benchmark fails, and the next benchmark begins.
benchmark::internal::Benchmark* add_benchmark(const std::string& id,
                                              std::function<void(benchmark::State&)> work);

/// Least time of a repetition, s.
double least_s(const BenchOptions& options);

/// Counters of a row. `items` (constraints times iterations, or vertices) is the work of a call: the cost of
/// a row is its time per item.
void set_counters(benchmark::State& state, std::int64_t vertices, std::int64_t constraints, double items);

/// The scene that was used last, and its key.
std::pair<std::string, std::shared_ptr<void>>& last_scene();

/// The scene with this key, which `make` makes unless it is the scene of the last call. Google Benchmark
/// calls a benchmark several times per row, and making a scene can take longer than measuring it. Only one
/// scene is kept, because two large scenes would only cost memory.
template <class Make>
auto& staged(const std::string& key, const Make& make) {
  using Made = typename decltype(make())::element_type;
  auto& last = last_scene();
  if (last.first != key) {
    last = {};
    last.second = make();
    last.first = key;
  }
  return *static_cast<Made*>(last.second.get());
}

/// Seconds of a step: processor time of this thread, and wall time.
struct StepSeconds {
  double cpu, wall;
};
/// Throws std::runtime_error if the cloth diverged.
StepSeconds timed_step(Simulation& simulation);

/// Processor seconds of a call.
double cpu_seconds(const std::function<void()>& work);

}  // namespace bendlab
