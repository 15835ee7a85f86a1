#include "bendlab/solver/spring_rows.hpp"

#include <algorithm>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {
namespace {

// Calls action(vertex, other vertex, spring) for each end of each spring whose vertex needs a row.
template <class Action>
void for_each_end(const std::vector<Spring>& springs, const std::vector<char>& needs_row,
                  const Action& action) {
  for (const Spring& spring : springs) {
    const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
    if (needs_row[a]) action(a, b, spring);
    if (needs_row[b]) action(b, a, spring);
  }
}

}  // namespace

template <class Real>
SpringRows<Real> make_spring_rows(const std::vector<Spring>& springs, const std::vector<char>& needs_row) {
  const std::size_t slice_count = (needs_row.size() + group_size - 1) / group_size;
  std::vector<std::size_t> length(slice_count * group_size, 0);
  for_each_end(springs, needs_row, [&](std::size_t vertex, std::size_t, const Spring&) { ++length[vertex]; });

  SpringRows<Real> rows;
  for (std::size_t slice = 0; slice < slice_count; ++slice) {
    const auto begin = length.begin() + static_cast<std::ptrdiff_t>(slice * group_size);
    const std::size_t first = rows.other.size(), longest = *std::max_element(begin, begin + max_lanes);
    rows.slices.push_back(first);
    rows.other.resize(first + longest * group_size);
    for (std::size_t lane = first; lane < rows.other.size(); ++lane)
      rows.other[lane] = offset_of(static_cast<int>(slice * group_size + lane % group_size));
  }
  rows.slices.push_back(rows.other.size());
  rows.rest_length.resize(rows.other.size(), 0);
  rows.stiffness.resize(rows.other.size(), 0);

  std::vector<std::size_t> filled(length.size(), 0);
  for_each_end(springs, needs_row, [&](std::size_t vertex, std::size_t other, const Spring& spring) {
    const std::size_t lane =
        rows.slices[vertex / group_size] + filled[vertex]++ * group_size + vertex % group_size;
    rows.other[lane] = offset_of(static_cast<int>(other));
    rows.rest_length[lane] = static_cast<Real>(spring.rest_length);
    rows.stiffness[lane] = static_cast<Real>(spring.stiffness);
  });
  return rows;
}

template SpringRows<float> make_spring_rows(const std::vector<Spring>&, const std::vector<char>&);
template SpringRows<double> make_spring_rows(const std::vector<Spring>&, const std::vector<char>&);

}  // namespace bendlab
