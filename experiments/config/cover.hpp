// Covering arrays: small sets of rows (one value per axis). For any two axes, or any three, and so on, every
// combination of their values is in a row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace bendlab {

/// How a sweep is covered.
struct Cover {
  int strength = 2;        ///< every combination of the values of this many axes occurs in a row
  std::uint64_t seed = 1;  ///< another seed gives different rows with the same coverage
};

/// One value index per axis.
using CoverRow = std::vector<std::size_t>;

/// Values of some of the axes: pairs (axis, index of a value of this axis), in ascending order of the axes.
using CoverTuple = std::vector<std::pair<std::size_t, std::size_t>>;

struct CoverRows {
  std::vector<CoverRow> rows;  ///< all different, all allowed
  std::size_t tuples = 0;      ///< how many combinations of the values of `strength` axes there are
  std::size_t missing = 0;     ///< how many of these combinations are in no row
  /// Why combinations are missing: the smallest combinations for which no allowed row was found.
  std::vector<CoverTuple> impossible;
};

/// Rows for which `allowed` is true. Every combination of values of any `strength` axes (of all axes, if
/// there are fewer) is in at least one row, except combinations for which no allowed row was found. The
/// search is greedy (Cohen, Dalal, Fredman, Patton: The AETG System, 1997): each row begins with an uncovered
/// combination; then one axis after another takes the value that covers most combinations. Of a few rows that
/// are made in this way, the best row is taken. Pairs of values that `allowed` refuses are remembered and
/// avoided. The same arguments give the same rows on every machine. `sizes` holds the number of values of
/// each axis, each at least 1. Stops once there are more than `most_rows` rows. Throws std::invalid_argument
/// for a strength below 1, and for more than 20 million combinations.
CoverRows covering_rows(std::span<const std::size_t> sizes, const Cover& cover,
                        const std::function<bool(const CoverRow&)>& allowed, std::size_t most_rows);

}  // namespace bendlab
