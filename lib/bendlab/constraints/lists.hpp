// Constraints as plain lists, one per kind: as models build them, before they are ordered.
#pragma once

#include <array>
#include <vector>

namespace bendlab {

/// |p_a - p_b| = rest_length.
struct DistanceConstraints {
  std::vector<std::array<int, 2>> vertices;  ///< #C pairs (a, b)
  std::vector<double> rest_length;           ///< #C, m
  std::vector<double> softness;  ///< #C, or empty (all 1); XPBD: α is it times the scene's compliance

  std::size_t size() const { return vertices.size(); }
};

/// A triangle and its material coordinates: P = [p1 - p0, p2 - p0] = F Q.
struct StrainConstraints {
  std::vector<std::array<int, 3>> vertices;  ///< #C triples
  /// #C, inverse of Q row by row: {Q⁻¹(0,0), Q⁻¹(0,1), Q⁻¹(1,0), Q⁻¹(1,1)}, 1/m
  std::vector<std::array<double, 4>> inverse_rest;

  std::size_t size() const { return vertices.size(); }
};

}  // namespace bendlab
