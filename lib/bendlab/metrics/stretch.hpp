// Principal stretches of a deformed cloth against its rest shape.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Singular values of a triangle's deformation gradient, largest ≥ smallest ≥ 0; both 1 at rest.
struct PrincipalStretches {
  double largest = 1, smallest = 1;
};

/// Four metrics that summarise the stretches of all triangles. A maximum over no triangles is NaN.
struct StretchSummary {
  double mean_strain = 0;      ///< mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|)
  double max_stretch = 0;      ///< largest σ₁
  double pin_max_stretch = 0;  ///< largest σ₁ over triangles that touch a pinned vertex
  /// Largest σ₁ over triangles within 0.1 sizes (rest box diagonal) of a pin that the scene names.
  double pin_region_stretch = 0;
};

class StretchMeter {
 public:
  StretchMeter(const RestMesh& rest, const Pins& pins);

  /// #T principal stretches of the cloth at `positions` (#V by 3, m); NaN if a position is not finite. Both
  /// stretches of a degenerate rest triangle (see bad_triangles.hpp) are always 1.
  std::vector<PrincipalStretches> measure(const Positions& positions) const;
  StretchSummary summarise(std::span<const PrincipalStretches> stretches) const;

 private:
  Triangles triangles_;
  std::vector<InverseRest> inverse_rest_;
  std::vector<char> at_pin_, near_pin_, degenerate_;  // #T
};

}  // namespace bendlab
