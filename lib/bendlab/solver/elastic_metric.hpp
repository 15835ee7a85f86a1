// Constant matrices that resemble the Hessian of a scene's elastic energy: a scalar for each pair of free
// vertices, the same for x, y and z, positive semidefinite.
//
//   triangle     Σ over warp and weft: A d dᵀ / α, A the rest area, f = Σ d_i x_i a column of the deformation
//                gradient: what stretch and shear together resist at rest in each direction of the plane
//   springs      as a stiffer membrane: what springs that are strained alike resist, spread over the
//                triangles. Each by itself would join vertices many edges apart, and the factor would be as
//                good as dense
//   element      κ κᵀ / α, κ_i = n·∇_i C in the rest shape, n along the largest ∇_i C; for a flat hinge ∇_i C
//                are multiples of the normal, and this is its Hessian
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class ElasticMetric {
 public:
  /// Throws std::invalid_argument for elements whose force jumps: no matrix resembles that.
  explicit ElasticMetric(const SimulationInput& input);

  const std::vector<int>& vertices() const { return vertices_; }           ///< n, the free ones
  const Eigen::SparseMatrix<double>& bending() const { return bending_; }  ///< n by n, lower half, N/m
  /// n by n, lower half, N/m, springs included. Mesh triangle t is softness[t] times as soft as stated.
  Eigen::SparseMatrix<double> membrane(std::span<const double> softness) const;

  std::size_t triangle_count() const { return strain_.size(); }
  std::size_t memory_bytes() const;

 private:
  void find_stiffness_of_springs(const SimulationInput& input, const Positions& rest);
  double rest_area(std::size_t t) const;

  std::vector<int> vertices_, free_index_;
  Eigen::SparseMatrix<double> bending_;
  StrainConstraints strain_;
  double compliance_;                         // of the membrane, m/N
  std::vector<double> stiffness_of_springs_;  // per triangle, N/m; empty: there are none
};

}  // namespace bendlab
