// The flexural rigidity of a woven sheet, which depends on the direction of bending.
//
//     energy per area   ½ κᵀ D κ,   κ = (κ11, κ22, 2 κ12), 1 along the warp and 2 along the weft
//
//         | D11 D12  0  |       a wide sheet, bent along φ to a cylinder, has the rigidity
//     D = | D12 D22  0  |           D(φ) = D11 c⁴ + 2 (D12 + 2 D66) c² s² + D22 s⁴    (c = cos φ, s = sin φ)
//         |  0   0  D66 |       a narrow strip cut along φ may also curve across and twist, and has 1/S11(φ),
//                                   S11(φ) = S11 c⁴ + (2 S12 + S66) c² s² + S22 s⁴, S = D⁻¹
//
// φ is the angle to the warp. Textile laboratories bend strips. Source: the theory of orthotropic plates
// (Timoshenko and Woinowsky-Krieger 1959, § 85).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// All in N m.
struct OrthotropicRigidity {
  double warp = 0;      ///< D11
  double weft = 0;      ///< D22
  double coupling = 0;  ///< D12
  double twist = 0;     ///< D66

  /// D(φ) of a cylinder, for a unit vector d = (cos φ, sin φ) in coordinates along warp and weft.
  double cylinder(const Vector2& d) const;
  /// 1/S11(φ) of a narrow strip along d.
  double strip(const Vector2& d) const;
  /// The mean of D(φ) over all directions.
  double mean() const;
  /// κᵀ D κ' of two curvatures (κ11, κ22, 2 κ12).
  double product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
};

/// The D of a sheet whose narrow strips have the rigidities `warp`, `weft` and, at 45 degrees, `bias` (N m,
/// above 0). S11 = 1/warp and S12 = -ν / √(warp weft), so a strip along the warp with the curvature κ has the
/// curvature -ν √(warp/weft) κ across. If `bias` is absent, D12 + 2 D66 = √(D11 D22), as in Huber's theory of
/// plates. Throws std::invalid_argument if no sheet has such a bias: it has to be below 4 / (1/warp + 1/weft
/// - 2 ν/√(warp weft)).
OrthotropicRigidity orthotropic_rigidity(double warp, double weft, std::optional<double> bias,
                                         double poisson_ratio);

/// A sheet whose rigidity depends on the direction.
struct DirectedSheet {
  OrthotropicRigidity rigidity;
  std::vector<Vector3> warp;  ///< #T: the direction of the warp in each triangle's rest plane, unit
};

/// #T: the warp axis of each triangle, a unit vector in its rest plane.
std::vector<Vector3> warp_axes(const TriangleMesh& mesh, const std::vector<InverseRest>& coordinates);

/// The weighted mean of axes. An axis has no sign, so the sum uses twice its angle.
class AxisSum {
 public:
  void add(const Vector2& axis, double weight = 1);
  /// Unit; (1, 0) if the axes cancel.
  Vector2 mean() const;
  /// 1 if all axes are parallel, 0 if they cancel.
  double agreement() const { return weight_ > 0 ? sum_.norm() / weight_ : 1; }

 private:
  Vector2 sum_{0, 0};  // of (cos 2φ, sin 2φ)
  double weight_ = 0;
};

}  // namespace bendlab
