// Where on the sheet a constraint resists bending, and how much of a curvature it sees beside what is held.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/bending/stiffness_fit.hpp"
#include "bendlab/bending/triangle_finder.hpp"

namespace bendlab {

/// #T: triangles with all corners pinned stay as they are; the sheet bends beyond them.
std::vector<char> held_triangles(const RestMesh& rest, const Pins& pins);

/// Whose a constraint's energy is, and by how much a held part of it lessens what it sees of a curvature.
struct Span {
  Shares shares;
  double seen = 1;
};

/// Of a hinge: the thirds of its triangles that are nearest to the edge. A held one leaves half the angle.
Span hinge_span(const std::array<int, 4>& hinge, const Pins& pins);

/// Of pairs, by the theory of a line from 0 to 1 that bends by κ(s) and shortens by δ:
///
///     δ = ½ ∫∫ G κ(s) κ(s') ds ds',   G = min(s, s') (1 - max(s, s')),   ∂δ/∂κ(s) = ∫ G κ(s') ds'
///
/// A place's share is that of the moment there, s (1 - s) on a line that bends evenly; a held part does not
/// bend.
class PairSpans {
 public:
  /// `held` is held_triangles(), `plane` UnitBend's; all are kept by reference.
  PairSpans(const RestMesh& rest, const Pins& pins, const std::vector<char>& held,
            std::span<const Vector2> plane);

  /// Of the pair a, b: `seen` is the share of its shortening that is left.
  Span operator()(int a, int b) const;

 private:
  std::size_t sample_count(int a, int b, double length) const;

  double mean_edge_;
  const Pins& pins_;
  const std::vector<char>& held_;
  std::span<const Vector2> plane_;
  TriangleFinder find_;
};

}  // namespace bendlab
