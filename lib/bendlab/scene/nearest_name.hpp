// Suggestions "did you mean …?": finds the allowed name that is most similar to a mistyped name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace bendlab {

/// The number of edits that change `from` to `to`: insertions, deletions, replacements and swaps of
/// neighbouring letters (optimal string alignment). Upper and lower case count as equal.
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The candidate with the smallest edit distance to `name` (ties go to the first), or "" if the distance is
/// too large for a typing mistake. 1 edit is allowed, and 1 more for every four letters.
template <class Names>
std::string nearest_name(std::string_view name, const Names& candidates) {
  const auto distance = [&](std::string_view candidate) { return edit_distance(name, candidate); };
  const auto nearest = std::ranges::min_element(candidates, {}, distance);
  if (nearest == std::ranges::end(candidates) || distance(*nearest) > 1 + name.size() / 4) return "";
  return std::string(*nearest);
}

/// For example "; did you mean 'cells'?", or "" if no candidate is similar enough.
template <class Names>
std::string suggestion(std::string_view name, const Names& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace bendlab
