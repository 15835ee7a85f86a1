// Springs by vertex: each vertex has a row of its own springs, so that each vertex can sum its springs
// independently. A spring is in two rows: those of its two ends.
//
//   slice   the rows of max_lanes consecutive vertices, one row in each SIMD lane; as long as the longest row
//
//   lane    0      1      2    …
//           s0     s1     s0        a vertex's springs in the order of the list; shorter rows end in padded
//           s3     s4     s2        lanes, whose spring leads from the vertex to itself and has no stiffness
//           s7      ·     s5
//
// A vertex always sums its springs in the same order, so the bits of the sums depend on the list alone.
#pragma once

#include <cstddef>
#include <vector>

#include "bendlab/constraints/large_array.hpp"

namespace bendlab {

/// A spring between the permuted vertices a and b.
struct Spring {
  int a, b;
  double rest_length;  ///< m
  double stiffness;    ///< N/m
};

template <class Real>
struct SpringRows {
  std::vector<std::size_t> slices;  ///< first lane of each slice, then the number of lanes
  LargeArray<int> other;            ///< offset_of() the other end
  LargeArray<Real> rest_length;     ///< m
  LargeArray<Real> stiffness;       ///< N/m

  std::size_t slice_count() const { return slices.size() - 1; }
};

/// Makes a row for each vertex. `needs_row`: #V; 0: the row is empty.
template <class Real>
SpringRows<Real> make_spring_rows(const std::vector<Spring>& springs, const std::vector<char>& needs_row);

}  // namespace bendlab
