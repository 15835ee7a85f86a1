// Cholesky factors of a symmetric, positive definite matrix of scalars, made to solve for many right-hand
// sides of three numbers: the x, y and z of points.
//
// CHOLMOD orders (AMD: METIS would not give every run the same order) and factorises, once. Its supernodes
// are then stored row by row in the precision of the points: a row times the points of its columns is one
// pass through memory, in which every number of the factor serves x, y and z at once.
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
  /// `lower`: the lower triangle of the matrix, n by n. Throws std::runtime_error if it is not positive
  /// definite.
  explicit SparseFactor(const Eigen::SparseMatrix<double>& lower);

  /// The right-hand side of row i is right[points[i]], and its solution goes to solution[points[i]]. Without
  /// this call, i itself is.
  void renumber(const std::vector<int>& points);

  /// Solves for x, y and z. w of the solution is 0 where w of the right-hand sides is.
  void solve(const Point<Real>* right, Point<Real>* solution) const;
  void solve(Point<Real>* points) const { solve(points, points); }

  std::size_t size() const { return order_.size(); }      ///< n
  std::size_t entries() const { return values_.size(); }  ///< numbers in the factor
  std::size_t memory_bytes() const;

 private:
  // Consecutive columns that have the same rows below their own.
  struct Supernode {
    int first, columns;
    std::size_t rows, values;  // where its first row below the columns, and its first number, are
    int row_count;
  };

  void keep(const cholmod_factor_struct& factor);

  std::vector<int> order_;  // n, the point of the right-hand sides at each place of the factor
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;  // by supernode: the factor's rows below its columns
  // By supernode: its triangle row by row, the diagonal inverted; then the rows below, `columns` numbers
  // each.
  LargeArray<Real> values_;
  mutable Points<Real> work_;  // n
};

}  // namespace bendlab
