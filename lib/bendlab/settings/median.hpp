// Medians.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bendlab {

/// The median, or the larger of two middle values. Reorders `values`, which must not be empty.
inline double upper_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The median, or the mean of two middle values.
inline double median(std::vector<double> values) {
  const double upper = upper_median(values);
  if (values.size() % 2 == 1) return upper;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  return 0.5 * (upper + *std::max_element(values.begin(), middle));
}

}  // namespace bendlab
