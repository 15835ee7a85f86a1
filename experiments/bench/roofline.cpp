#include "experiments/bench/roofline.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "bendlab/constraints/pack.hpp"
#include "experiments/run/machine.hpp"

namespace bendlab {
namespace {

constexpr std::size_t smallest_set = std::size_t{1} << 14,  // fits every first-level cache
    largest_set = std::size_t{1} << 28;                     // bytes
constexpr double probe_s = 4e-3;
constexpr int probes = 7;

/// Seconds per call of `work`: the best of a few probes, because other programs may disturb a probe.
template <class Work>
double best_seconds(const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int probe = 0; probe < probes; ++probe) {
    int calls = 0;
    const double start = thread_cpu_s();
    double elapsed = 0;
    while (elapsed < probe_s) {
      work();
      ++calls;
      elapsed = thread_cpu_s() - start;
    }
    best = std::min(best, elapsed / calls);
  }
  return best;
}

double measure_triad(std::size_t bytes) {
  using Block = Pack<float>;  // aligned, whole registers
  const std::size_t count = bytes / (3 * sizeof(Block));
  std::vector<Block> a(count), b(count, broadcast(1.0f)), c(count, broadcast(2.0f));
  // A call has to take much longer than reading the clock.
  const std::size_t rounds = std::max<std::size_t>(1, (std::size_t{1} << 20) / bytes);
  const double seconds = best_seconds([&] {
    for (std::size_t round = 0; round < rounds; ++round) {
      for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3.0f * c[i];
      benchmark::ClobberMemory();
    }
  });
  return static_cast<double>(3 * sizeof(Block) * count * rounds) / seconds;
}

template <class Real>
double measure_peak() {
  // To keep the units for multiply-adds (fma) busy, there have to be more chains than the latency of an fma
  // times the number of fmas that start per cycle.
  constexpr int chains = 10, rounds = 4096;
  std::array<Pack<Real>, chains> sums{};
  const Pack<Real> factor = broadcast<Real>(Real(0.999)), term = broadcast<Real>(Real(0.001));
  const double seconds = best_seconds([&] {
    std::array<Pack<Real>, chains> x = sums;
    for (int round = 0; round < rounds; ++round)
      for (auto& chain : x) chain = chain * factor + term;
    sums = x;
    benchmark::DoNotOptimize(sums);
  });
  return 2.0 * chains * rounds * lanes<Real> / seconds;
}

}  // namespace

double triad_bandwidth(std::size_t bytes) {
  static std::map<std::size_t, double> measured;
  const std::size_t size = std::clamp(bytes, smallest_set, largest_set);
  const auto [entry, is_new] = measured.try_emplace(size, 0.0);
  if (is_new) entry->second = measure_triad(size);
  return entry->second;
}

double peak_flops(std::size_t scalar_bytes) {
  static const double in_float = measure_peak<float>(), in_double = measure_peak<double>();
  return scalar_bytes == sizeof(float) ? in_float : in_double;
}

std::size_t streamed_bytes(const ConstraintCost& cost, std::size_t scalar_bytes) {
  return static_cast<std::size_t>(cost.corners) * 4 +
         static_cast<std::size_t>(cost.rest_scalars) * scalar_bytes;
}

double roofline_seconds(const ConstraintCost& cost, std::size_t scalar_bytes, double points_per_constraint,
                        std::size_t scene_bytes) {
  const auto streamed = static_cast<double>(streamed_bytes(cost, scalar_bytes));
  const double point = cost.moved_scalars * static_cast<double>(scalar_bytes);
  return std::max({cost.flops / peak_flops(scalar_bytes),
                   (streamed + cost.corners * point) / triad_bandwidth(smallest_set),
                   (streamed + points_per_constraint * point) / triad_bandwidth(scene_bytes)});
}

double solve_roofline_seconds(std::size_t entries, std::size_t scalar_bytes) {
  constexpr double flops = 2 * 2 * 3;  // forward and backward: a product and a sum for x, y and z
  const auto count = static_cast<double>(entries);
  return std::max(flops * count / peak_flops(scalar_bytes),
                  2 * count * static_cast<double>(scalar_bytes) / triad_bandwidth(entries * scalar_bytes));
}

}  // namespace bendlab
