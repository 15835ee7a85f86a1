// Measures the limits for all kernels on this machine: bandwidth of caches and memory, and multiply-adds.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "bendlab/constraints/pack.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"

namespace bendlab {
namespace {

/// The triad a = b + s c, on arrays of `bytes` bytes together.
void triad(benchmark::State& state, std::size_t bytes) {
  using Block = Pack<float>;  // aligned, whole registers
  const std::size_t count = bytes / (3 * sizeof(Block));
  std::vector<Block> a(count), b(count, broadcast(1.0f)), c(count, broadcast(2.0f));
  for ([[maybe_unused]] const auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3.0f * c[i];
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(3 * sizeof(Block) * count));
}

template <class Real>
void multiply_adds(benchmark::State& state) {
  // To keep the units for multiply-adds (fma) busy, there have to be more chains than the latency of an fma
  // times the number of fmas that start per cycle.
  constexpr int chains = 10, rounds = 4096;
  std::array<Pack<Real>, chains> sums{};
  const Pack<Real> factor = broadcast<Real>(Real(0.999)), term = broadcast<Real>(Real(0.001));
  for ([[maybe_unused]] const auto _ : state) {
    std::array<Pack<Real>, chains> x = sums;
    for (int round = 0; round < rounds; ++round)
      for (auto& chain : x) chain = chain * factor + term;
    sums = x;
    benchmark::DoNotOptimize(sums);
  }
  state.counters["flop_per_second"] =
      benchmark::Counter(2.0 * chains * rounds * lanes<Real>, benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

void register_machine_cases(const BenchOptions& options) {
  const auto add = [&](const std::string& id, const auto& work) {
    add_benchmark(id, work)->MinTime(least_s(options));
  };
  for (std::size_t bytes = 16 << 10; bytes <= 256 << 20; bytes *= 4)
    add(fmt::format("triad/{}", bytes), [=](benchmark::State& state) { triad(state, bytes); });
  add("peak/float", multiply_adds<float>);
  add("peak/double", multiply_adds<double>);
}

}  // namespace bendlab
