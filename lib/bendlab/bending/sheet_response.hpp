// How a flat sheet answers when it is bent a little: not to the cylinder that its constraints are calibrated
// on, but to whatever shape near it costs the least.
//
//     as told, z = ½ κ : (p p)       relaxed: vertices leave the surface, one kind up, the other down
//
//     o---o---o---o---o              o   o   o             the mean curvature stays,
//                                      o   o               the energy falls
//
// Small heights z make linear angles, so the energy is ½ zᵀ K z. The response is linear homogenisation:
// vertices at the sheet's boundary and pins are held on the surface, all others take the least energy, for
// the three curvatures in turn; energy per area and mean curvature are taken well inside. A membrane that
// does not stretch forbids such a relaxation from a curvature of about 4 √(B / Y) / h² on (Y its stiffness in
// N/m, h the length of an edge).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// A constraint as small heights see it: the energy ½ stiffness (Σ weight z)².
struct HeightStencil {
  std::array<int, 4> vertices;
  std::array<double, 4> weight;  ///< 1/m, sum zero
  double stiffness;              ///< N m
};

/// Symmetric D of the energy per area ½ κᵀ D κ, κ = (κxx, κyy, κxy) in the coordinates of the sheet's plane:
/// N m.
using Rigidity = Eigen::Matrix3d;

/// Bent along d to a cylinder: the rigidity B of the energy ½ B κ².
double cylinder_rigidity(const Rigidity& rigidity, const Vector2& d);

/// Of a narrow strip along d that is bent by a moment and may curve across and twist as it likes: 1 /
/// (D⁻¹)_dd. On an isotropic sheet it is 1 - ν² of a cylinder's.
double strip_rigidity(const Rigidity& rigidity, const Vector2& d);

class SheetResponse {
 public:
  /// `plane` #V are plane_coordinates(); all are kept by reference. `patch`: no farther than so many edges
  /// from the innermost vertex, which is enough for a number and makes it cheap on any mesh; 0: the whole
  /// sheet.
  SheetResponse(const RestMesh& rest, const Pins& pins, std::span<const Vector2> plane, int patch = 0);

  /// Whether there is enough of the sheet inside to measure: vertices at least `least_depth` edges from its
  /// boundary and pins.
  bool measurable() const;
  static constexpr int least_depth = 5;

  struct Answer {
    Rigidity as_told;  ///< on the smooth surface: what a membrane that does not stretch leaves
    Rigidity relaxed;  ///< of its own
    Eigen::Matrix<double, Eigen::Dynamic, 3>
        angles;  ///< #C, Σ weight z of the relaxed sheet for each unit curvature
  };
  /// Of stencils times `factor` (#C). Nothing where the sheet has no interior, or does not resist everywhere
  /// there.
  std::optional<Answer> operator()(std::span<const HeightStencil> stencils,
                                   std::span<const double> factor) const;

 private:
  const RestMesh& rest_;
  std::span<const Vector2> plane_;
  std::vector<int> depth_;      // #V, edges from what is held
  std::vector<double> window_;  // #V, how much of it is measured
  std::vector<double> area_;    // #V, m²
};

}  // namespace bendlab
