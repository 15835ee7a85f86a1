// Where on the sheet a constraint resists bending, and how much less the constraint bends near a clamp.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/bending/stiffness_fit.hpp"
#include "bendlab/bending/triangle_finder.hpp"

namespace bendlab {

/// #T: whether all corners of a triangle are pinned. Such a triangle is held: it does not bend.
std::vector<char> held_triangles(const RestMesh& rest, const Pins& pins);

/// How the energy of a constraint is shared among vertices. Held triangles do not bend, so a constraint that
/// reaches into them keeps only the share `seen` of its angle or shortening.
struct Span {
  Shares shares;
  double seen = 1;
};

/// The span of a hinge. The energy of the hinge belongs to the third of each triangle that is nearest to the
/// edge. If one of the two triangles is held, the hinge keeps half of its angle.
Span hinge_span(const std::array<int, 4>& hinge, const Pins& pins);

/// The spans of vertex pairs. The line between two vertices, s from 0 to 1, bends by κ(s) and shortens by δ:
///
///     δ = ½ ∫∫ G κ(s) κ(s') ds ds',   G = min(s, s') (1 - max(s, s')),   ∂δ/∂κ(s) = ∫ G κ(s') ds'
///
/// A point's share of the energy is its share of the moment ∂δ/∂κ(s). On a line that bends evenly, this
/// moment is ∝ s (1 - s). A part of the line on held triangles does not bend.
class PairSpans {
 public:
  /// `held` is from held_triangles(), `plane` from UnitBend::plane(). All arguments are kept by reference.
  PairSpans(const RestMesh& rest, const Pins& pins, const std::vector<char>& held,
            std::span<const Vector2> plane);

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
