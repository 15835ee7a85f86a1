// A flat sheet bent to a cylinder of curvature κ, to leading order in κ: how much the distances of vertices
// decrease, and by which angles the edges fold. The bent sheet is made of flat triangles; it is not a smooth
// cylinder. The edges keep their lengths. So if two vertices are t edges apart, their distance decreases (1 -
// 1/t²) times as much as the chord of a smooth arc.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The value of a form in the direction d = (c, s), a unit vector: Σ form[k] c^(N-1-k) s^k.
template <std::size_t N>
double value_in(const std::array<double, N>& form, const Vector2& direction) {
  double sum = 0, power = 1;
  for (const double coefficient : form)
    sum = sum * direction.x() + coefficient * power, power *= direction.y();
  return sum;
}
using QuadraticForm = std::array<double, 3>;
using QuarticForm = std::array<double, 5>;

/// #V by 2, m: coordinates in the sheet's plane, right-handed about the normal of most triangles. If the
/// sheet lies in z = 0, the coordinates are x and y. Empty if the rest shape is not flat (to 10⁻⁶ of its
/// size).
std::vector<Vector2> plane_coordinates(const RestMesh& rest);

/// Fold angle divided by κ, in m, at the edge q0 q1 between the triangles with q2 and q3, if z = ½ κ (q·d)²
/// at the four vertices and each triangle is flat.
QuadraticForm fold(const std::array<Vector2, 4>& q);

/// Weights in 1/m: for any small heights z of the four vertices the fold angle is Σ weight z.
std::array<double, 4> fold_weights(const std::array<Vector2, 4>& q);

/// A hinge unfolded into a plane: p0 and p1 are the ends of the edge, p2 and p3 the vertices opposite the
/// edge.
std::array<Vector2, 4> unfolded(const std::array<Vector3, 4>& p);

/// The bent sheet: z = ½ κ (p·d)² at the vertices, linear on every triangle, and the displacements κ² w in
/// the plane that minimise the strain energy Σ area |ε|² (von Kármán: ε = sym ∇w + ½ ∇z ∇zᵀ).
class UnitBend {
 public:
  /// Throws std::invalid_argument if the rest shape is not flat.
  explicit UnitBend(const RestMesh& rest);

  std::span<const Vector2> plane() const { return plane_; }  ///< #V, plane_coordinates()

  /// The decrease of the distance between a and b, divided by κ², in m³.
  QuarticForm shortening(int a, int b) const;

  /// w of a vertex, in m³, if the sheet bends in the direction d.
  Vector2 displacement(int vertex, const Vector2& direction) const;

  /// Some meshes cannot bend without strain of the membrane. A membrane of stiffness 1 N/m (energy ½ |ε|² per
  /// area) then has the energy ¼ C κ⁴ per area, averaged over all directions of bending. Returns C in m⁴.
  double membrane_quartic() const { return membrane_quartic_; }

 private:
  std::vector<Vector2> plane_;
  std::vector<std::array<Vector2, 5>> displacement_;  // w of each vertex, quartic forms
  double membrane_quartic_ = 0;
};

/// Mean of a form's square over all directions.
double mean_square(const QuarticForm& form);

}  // namespace bendlab
