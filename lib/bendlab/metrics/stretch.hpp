// Principal stretches of a deformed cloth, relative to the rest shape.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Singular values σ₁ (largest) and σ₂ (smallest) of a triangle's deformation gradient; 1 and 1 at rest.
struct PrincipalStretches {
  double largest = 1, smallest = 1;
};

/// Four metrics that summarise the stretches of all triangles. A maximum over no triangles is NaN.
struct StretchSummary {
  double mean_strain = 0;      ///< mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|)
  double max_stretch = 0;      ///< largest σ₁
  double pin_max_stretch = 0;  ///< largest σ₁ over triangles that touch a pinned vertex
  /// Largest σ₁ over triangles within 0.1 rest box diagonals of a vertex listed in /pins.
  double pin_region_stretch = 0;
};

class StretchMeter {
 public:
  StretchMeter(const RestMesh& rest, const Pins& pins);

  /// #T principal stretches of the cloth at `positions` (#V by 3, m); NaN if a position of the triangle is
  /// not finite. The stretches of a triangle without area at rest (see bad_triangles.hpp) are always 1.
  std::vector<PrincipalStretches> measure(const Positions& positions) const;
  StretchSummary summarise(std::span<const PrincipalStretches> stretches) const;

 private:
  Triangles triangles_;
  std::vector<InverseRest> inverse_rest_;
  std::vector<char> at_pin_, near_pin_, degenerate_;  // #T
};

}  // namespace bendlab
