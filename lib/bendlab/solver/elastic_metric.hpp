// Constant matrices that approximate the Hessian of a scene's elastic energy. They are positive semidefinite
// and have one scalar for each pair of free vertices, the same for x, y and z.
//
//   triangle     A d dᵀ / α, summed over warp and weft. A is the rest area, and f = Σ d_i x_i is a column of
//                the deformation gradient. This is the stiffness of stretch and shear together at rest, in
//                each direction of the plane
//   springs      make the membrane stiffer: the stiffness of equally strained springs, spread over the
//                triangles. An entry for each spring would couple vertices many edges apart, and the
//                Cholesky factor would be almost dense
//   element      κ κᵀ / α, with κ_i = n·∇_i C in the rest shape and n along the largest ∇_i C. The ∇_i C of a
//                flat hinge are multiples of the normal, so this is the Hessian of a flat hinge
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class ElasticMetric {
 public:
  /// Throws std::invalid_argument for elements whose force jumps: no constant matrix approximates it.
  explicit ElasticMetric(const SimulationInput& input);

  const std::vector<int>& vertices() const { return vertices_; }           ///< the n free vertices
  const Eigen::SparseMatrix<double>& bending() const { return bending_; }  ///< n by n, lower half, N/m
  /// n by n, lower half, N/m, springs included. Triangle t of the mesh is softness[t] times as soft as
  /// stated.
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
  std::vector<double> stiffness_of_springs_;  // per triangle, N/m; empty: no springs
};

}  // namespace bendlab
