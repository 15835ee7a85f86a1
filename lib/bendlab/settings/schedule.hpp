// A factor that changes in the course of a run: linear between keyframes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace bendlab {

struct Schedule {
  std::vector<double> times;    ///< s, ascending; empty: the factor is always 1
  std::vector<double> factors;  ///< at these times; before the first and after the last they stay the same

  bool is_given() const { return !times.empty() || !factors.empty(); }

  double at(double time) const {
    if (times.empty()) return 1;
    const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    if (next == 0) return factors.front();
    if (next == times.size()) return factors.back();
    const double share = (time - times[next - 1]) / (times[next] - times[next - 1]);
    return factors[next - 1] + share * (factors[next] - factors[next - 1]);
  }

  /// Whether the factor is ever above its earlier value, or above 1 at the start.
  bool rises() const {
    return std::ranges::adjacent_find(factors, std::less{}) != factors.end() ||
           (is_given() && factors.front() > 1);
  }

  /// Whether the factor is 1 from the start until `end`, s.
  bool is_always_1(double end) const {
    for (std::size_t i = 0; i < times.size() && (i == 0 || times[i - 1] < end); ++i)
      if (factors[i] != 1) return false;
    return true;
  }

  /// The largest size of a factor.
  double largest() const {
    double size = times.empty() ? 1 : 0;
    for (const double factor : factors) size = std::max(size, std::abs(factor));
    return size;
  }

  double least() const { return factors.empty() ? 1 : *std::ranges::min_element(factors); }

  /// What is wrong with the keyframes; empty if they are sound.
  std::string problem() const {
    if (times.size() != factors.size())
      return fmt::format("factors has {} numbers, but times has {}: state a factor for every time",
                         factors.size(), times.size());
    for (std::size_t i = 1; i < times.size(); ++i)
      if (!(times[i] > times[i - 1]))
        return fmt::format("times must grow, but {} s comes after {} s", times[i], times[i - 1]);
    return {};
  }
};

}  // namespace bendlab
