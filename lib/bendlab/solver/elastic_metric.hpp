// Constant matrices that approximate the Hessian of a scene's elastic energy. The matrices are positive
// semidefinite. They have one scalar for each pair of free vertices; the scalar applies to x, y and z.
//
//   triangle     A d dᵀ / α, summed over warp and weft. A is the rest area, and f = Σ d_i x_i is a column of
//                the deformation gradient. For moves in the plane, this matrix has the stiffness of stretch
//                and of shear together, at rest
//   springs      are replaced by a stiffer membrane that stores as much energy. An entry for each spring
//                would join vertices that are many edges apart, and the Cholesky factor would be almost dense
//   element      κ κᵀ / α, with κ_i = n·∇_i C in the rest shape and the unit vector n along the largest
//                ∇_i C. For a flat hinge this is the Hessian, because all ∇_i C are along the normal
//   director     as a vertex, but not coupled to vertices
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class ElasticMetric {
 public:
  /// Throws std::invalid_argument for elements whose force jumps: no constant matrix approximates jumps.
  explicit ElasticMetric(const SimulationInput& input);

  const std::vector<int>& vertices() const { return vertices_; }  ///< the n free points and directors
  const Eigen::SparseMatrix<double>& bending() const { return bending_; }  ///< n by n, lower half, N/m
  /// Membrane, springs and bending: n by n, lower half, N/m. Triangle t is softness[t] times as soft as
  /// stated, and bending has `bending` times its stated stiffness. Bending that adds at most 1 % to each
  /// diagonal entry is left out. The factor then has less than half as many numbers, because hinges join
  /// vertices that no triangle joins.
  Eigen::SparseMatrix<double> matrix(std::span<const double> softness, double bending = 1) const;

  std::size_t triangle_count() const { return strain_.size(); }
  /// As in StrainConstraints.
  const std::vector<double>& stated_softness() const { return strain_.softness; }
  std::size_t memory_bytes() const;

 private:
  void find_stiffness_of_springs(const SimulationInput& input, const Positions& rest);
  double rest_area(std::size_t t) const;
  Eigen::SparseMatrix<double> membrane(std::span<const double> softness) const;

  std::vector<int> vertices_, free_index_;
  Eigen::SparseMatrix<double> bending_;
  StrainConstraints strain_;
  double compliance_;  // of the membrane, m/N
  // Times the compliance: for differences along the warp and along the weft, which stretch and shear.
  std::array<double, 2> axis_softness_{};
  std::vector<double> stiffness_of_springs_;  // per triangle, N/m; empty: no springs
};

}  // namespace bendlab
