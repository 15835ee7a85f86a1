// How a flat sheet responds if it is bent a little. The sheet's constraints are calibrated on a cylinder. The
// sheet itself does not become a cylinder, but takes the shape near the cylinder that has the least energy.
//
//     unrelaxed: z = ½ κ : (p p)     relaxed: vertices leave that surface, some upwards, some downwards
//
//     o---o---o---o---o              o   o   o             the mean curvature stays,
//                                      o   o               the energy falls
//
// Angles are linear in small heights z, so the energy is ½ zᵀ K z. The response is computed by linear
// homogenisation: for each of the three curvatures, vertices at the sheet's boundary and pins are held on the
// surface, and all other vertices minimise the energy. Energy per area and mean curvature are measured well
// inside the sheet. A membrane that does not stretch prevents this relaxation above a curvature of about 4
// √(B / Y) / h² (Y: the membrane's stiffness in N/m, h: the length of an edge).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The energy of a constraint at small heights: ½ stiffness (Σ weight z)².
struct HeightStencil {
  std::array<int, 4> vertices;
  std::array<double, 4> weight;  ///< 1/m, sum zero
  double stiffness;              ///< N m
};

/// The symmetric matrix D, in N m, of the energy per area ½ κᵀ D κ with κ = (κxx, κyy, κxy) in coordinates of
/// the sheet's plane.
using Rigidity = Eigen::Matrix3d;

/// The rigidity B of the energy ½ B κ² if the sheet is bent along d to a cylinder.
double cylinder_rigidity(const Rigidity& rigidity, const Vector2& d);

/// The rigidity 1 / (D⁻¹)_dd of a narrow strip along d that is bent by a moment and free to curve across and
/// to twist. On an isotropic sheet, the rigidity of the strip is 1 - ν² times the rigidity of the cylinder.
double strip_rigidity(const Rigidity& rigidity, const Vector2& d);

class SheetResponse {
 public:
  /// `plane` (#V) is from plane_coordinates(). `rest` and `plane` are kept by reference. `patch`: only
  /// vertices fewer than `patch` edges away from the innermost vertex are measured, which is fast on any
  /// mesh; 0: the whole sheet is measured.
  SheetResponse(const RestMesh& rest, const Pins& pins, std::span<const Vector2> plane, int patch = 0);

  /// Whether the sheet has vertices at least `least_depth` edges away from its boundary and pins.
  bool measurable() const;
  static constexpr int least_depth = 5;

  struct Answer {
    Rigidity unrelaxed;  ///< on the smooth surface, where a membrane that does not stretch holds the sheet
    Rigidity relaxed;
    /// #C by 3: Σ weight z of the relaxed sheet for each unit curvature.
    Eigen::Matrix<double, Eigen::Dynamic, 3> angles;
  };
  /// The response with the stencils' stiffnesses times `factor` (#C). Nothing if the sheet is not
  /// measurable(), or if some interior vertex can move without resistance.
  std::optional<Answer> operator()(std::span<const HeightStencil> stencils,
                                   std::span<const double> factor) const;

 private:
  const RestMesh& rest_;
  std::span<const Vector2> plane_;
  std::vector<int> depth_;      // #V, edges to the nearest held vertex
  std::vector<double> window_;  // #V, weight in the measurement
  std::vector<double> area_;    // #V, m²
};

}  // namespace bendlab
