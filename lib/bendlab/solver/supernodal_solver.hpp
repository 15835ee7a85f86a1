// Cholesky factors of a sparse matrix whose pattern stays and whose values change.
#pragma once

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <mutex>
#include <span>

#include "bendlab/solver/one_blas_thread.hpp"

namespace bendlab {

/// A symmetric block on the diagonal, which begins at row and column `at`.
struct DiagonalBlock {
  int at;
  Eigen::Matrix3d value;
};

class SupernodalSolver {
 public:
  SupernodalSolver() {
    one_blas_thread();
    factor_.cholmod().print = 0;  // "not positive definite" is an expected result
  }

  /// Factorises lower + diagonal + blocks; the first call also finds the elimination order. Returns false if
  /// the matrix is not positive definite. `lower` must have an entry wherever a block has an entry.
  /// If AMD's order is poor, CHOLMOD tries METIS, which uses the random numbers of the whole process. A lock
  /// therefore lets only one run at a time find its order. Otherwise the orders, and the bits of the results,
  /// would depend on the other runs.
  bool factorise(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXd& diagonal,
                 std::span<const DiagonalBlock> blocks = {}) {
    Eigen::SparseMatrix<double> matrix = lower;
    matrix.diagonal() += diagonal;
    for (const DiagonalBlock& block : blocks)
      for (int column = 0; column < 3; ++column)
        for (int row = column; row < 3; ++row)
          matrix.coeffRef(block.at + row, block.at + column) += block.value(row, column);
    if (!ordered_) {
      static std::mutex one_at_a_time;
      const std::lock_guard guard(one_at_a_time);
      factor_.analyzePattern(matrix), ordered_ = true;
    }
    factor_.factorize(matrix);
    bytes_ = std::max(bytes_, static_cast<std::size_t>(factor_.cholmod().memory_usage));
    return factor_.info() == Eigen::Success;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return factor_.solve(right); }

  /// The largest memory that CHOLMOD has used so far. An archive writes and reads it by reference.
  std::size_t memory_bytes() const { return bytes_; }
  std::size_t& memory_bytes() { return bytes_; }

 private:
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
  bool ordered_ = false;
  std::size_t bytes_ = 0;
};

}  // namespace bendlab
