// Cholesky factors of a symmetric, positive definite matrix of scalars. A right-hand side is an array of
// points, and x, y and z are solved for at the same time.
//
// CHOLMOD orders and factorises the matrix, once. (The order is AMD's, because METIS would not give every run
// the same order.) The supernodes of the factor are then stored row by row in the precision of the points.
// One pass through memory multiplies a row and the points of its columns, and uses every number of the factor
// for x, y and z.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "bendlab/constraints/point.hpp"

struct cholmod_factor_struct;  // CHOLMOD's

namespace bendlab {

template <class Real>
class SparseFactor {
 public:
  /// `lower`: the lower triangle of the matrix, n by n. Throws std::runtime_error if the matrix is not
  /// positive definite.
  explicit SparseFactor(const Eigen::SparseMatrix<double>& lower);

  /// solve() then reads the right-hand side of row i from right[points[i]], and writes the solution to
  /// solution[points[i]]. Without this call, points[i] is i.
  void renumber(const std::vector<int>& points);

  /// Solves for x, y and z. w of the solution is 0 if w of all right-hand sides is 0.
  void solve(const Point<Real>* right, Point<Real>* solution) const;
  void solve(Point<Real>* points) const { solve(points, points); }

  std::size_t size() const { return order_.size(); }      ///< n
  std::size_t entries() const { return values_.size(); }  ///< numbers in the factor
  std::size_t memory_bytes() const;

 private:
  // Consecutive columns with the same rows below the triangle of these columns.
  struct Supernode {
    int first, columns;
    std::size_t rows, values;  // where its data begin in rows_ and in values_
    int row_count;
  };

  void keep(const cholmod_factor_struct& factor);

  std::vector<int> order_;  // n, the point of the right-hand sides for each row of the factor
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;  // by supernode: the rows of the factor below its columns
  // For each supernode: the triangle row by row, with inverted diagonal, then the rows below the triangle.
  LargeArray<Real> values_;
  mutable Points<Real> work_;  // n
};

}  // namespace bendlab
