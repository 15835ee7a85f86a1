#include "bendlab/constraints/lists.hpp"

namespace bendlab {

void DistanceConstraints::store_rest_lengths() {
  if (!rest_length.empty()) return;
  std::vector<double> lengths;
  lengths.reserve(size());
  for (std::size_t c = 0; c < size(); ++c) lengths.push_back(rest(c));
  rest_length = std::move(lengths);
  rest_shape = nullptr;
}

DistanceConstraints DistanceConstraints::renumbered(const std::vector<int>& permutation) const {
  const auto at = [&](int v) { return permutation[static_cast<std::size_t>(v)]; };
  DistanceConstraints list{.vertices = {}, .rest_length = rest_length, .softness = softness};
  list.vertices.reserve(size());
  for (const auto& [a, b] : vertices) list.vertices.push_back({at(a), at(b)});
  if (!rest_shape) return list;
  Positions shape(rest_shape->rows(), 3);
  for (int v = 0; v < static_cast<int>(shape.rows()); ++v) shape.row(at(v)) = rest_shape->row(v);
  list.rest_shape = std::make_shared<const Positions>(std::move(shape));
  return list;
}

// Not inline, so that every caller gets the same bits: each inlined copy may fuse products and sums
// differently.
double DistanceConstraints::length_in(const Positions& shape, const std::array<int, 2>& pair) {
  const Vector3 a = shape.row(pair[0]).transpose(), b = shape.row(pair[1]).transpose();
  return (a - b).norm();
}

DistanceConstraints springs_at_rest_in(const Positions& shape) {
  return {.vertices = {}, .rest_shape = std::make_shared<const Positions>(shape)};
}

}  // namespace bendlab
