// Constant matrices that resemble the Hessian of a scene's elastic energy: a scalar for each pair of free
// vertices, the same for x, y and z, positive semidefinite.
//
//   triangle     Σ over warp and weft: d dᵀ / α, with the weights d of f = Σ d_i x_i: what stretch and shear
//                together resist at rest in each direction of the plane
//   spring       1 / α for the difference of its ends
//   element      κ κᵀ / α, κ_i = n·∇_i C in the rest shape, n along the largest ∇_i C; for a flat hinge ∇_i C
//                are multiples of the normal, and this is its Hessian
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

struct ElasticMetric {
  std::vector<int> vertices;                      ///< n, the free vertices
  Eigen::SparseMatrix<double> membrane, bending;  ///< n by n, the lower triangles, N/m
};

/// Throws std::invalid_argument for elements whose force jumps: no matrix resembles that.
ElasticMetric elastic_metric(const SimulationInput& input);

}  // namespace bendlab
