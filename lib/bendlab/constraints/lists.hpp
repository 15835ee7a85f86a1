// Constraints as plain lists, one list per kind, in the order in which models build the lists.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bendlab/constraints/pair_list.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// |p_a - p_b| = rest(c).
struct DistanceConstraints {
  PairList vertices;  ///< #C pairs (a, b)
  /// #C, m. If empty, a spring's rest length is the distance of its vertices in rest_shape. Most models need
  /// no other lengths, and a list of millions of lengths would be the largest array in memory.
  std::vector<double> rest_length = {};
  std::vector<double> softness = {};  ///< #C, or empty (all 1). XPBD: α is this times the scene's compliance
  std::shared_ptr<const Positions> rest_shape = nullptr;  ///< #V by 3, m; null where the lengths are stored

  std::size_t size() const { return vertices.size(); }
  double rest(std::size_t c) const {  ///< m
    return rest_length.empty() ? length_in(*rest_shape, vertices[c]) : rest_length[c];
  }
  /// Fills rest_length, so that the lengths can be changed.
  void store_rest_lengths();
  /// The springs with permutation[v] in place of each vertex v.
  DistanceConstraints renumbered(const std::vector<int>& permutation) const;

  static double length_in(const Positions& shape, const std::array<int, 2>& pair);  ///< m
};

/// An empty list for springs that are at rest in this shape (#V by 3, m).
DistanceConstraints springs_at_rest_in(const Positions& shape);

/// A triangle and its material coordinates: P = [p1 - p0, p2 - p0] = F Q.
struct StrainConstraints {
  std::vector<std::array<int, 3>> vertices;  ///< #C triples
  /// #C, inverse of Q row by row: {Q⁻¹(0,0), Q⁻¹(0,1), Q⁻¹(1,0), Q⁻¹(1,1)}, 1/m
  std::vector<std::array<double, 4>> inverse_rest;
  std::vector<double> softness = {};  ///< #C, or empty (all 1), times the compliance

  std::size_t size() const { return vertices.size(); }
};

}  // namespace bendlab
