// "Did you mean …?": the allowed name that a mistyped one is nearest to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace bendlab {

/// Insertions, deletions, replacements and swaps of neighbours that lead from one name to the other, case
/// ignored (optimal string alignment).
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The candidate with the smallest edit distance to `name` (ties go to the first), or "" if that candidate is
/// too far away for a slip: more than 1 edit, and one more per four letters.
template <class Names>
std::string nearest_name(std::string_view name, const Names& candidates) {
  const auto distance = [&](std::string_view candidate) { return edit_distance(name, candidate); };
  const auto nearest = std::ranges::min_element(candidates, {}, distance);
  if (nearest == std::ranges::end(candidates) || distance(*nearest) > 1 + name.size() / 4) return "";
  return std::string(*nearest);
}

/// "; did you mean 'cells'?", or "" if no candidate is near.
template <class Names>
std::string suggestion(std::string_view name, const Names& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace bendlab
