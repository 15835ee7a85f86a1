// Cholesky factors of a symmetric, positive definite matrix of scalars. They solve for many right-hand sides
// of points, whose x, y and z are solved for at once.
//
// CHOLMOD orders and factorises the matrix, once. (It orders by AMD, because METIS would not give every run
// the same order.) Its supernodes are then stored row by row in the precision of the points. The product of a
// row and the points of its columns is one pass through memory, in which every number of the factor serves x,
// y and z.
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
  /// this call, i takes the place of points[i].
  void renumber(const std::vector<int>& points);

  /// Solves for x, y and z. w of the solution is 0 if w of all right-hand sides is 0.
  void solve(const Point<Real>* right, Point<Real>* solution) const;
  void solve(Point<Real>* points) const { solve(points, points); }

  std::size_t size() const { return order_.size(); }      ///< n
  std::size_t entries() const { return values_.size(); }  ///< numbers in the factor
  std::size_t memory_bytes() const;

 private:
  // Consecutive columns that have the same rows below their own.
  struct Supernode {
    int first, columns;
    std::size_t rows, values;  // index of its first row below the columns in rows_, and in values_
    int row_count;
  };

  void keep(const cholmod_factor_struct& factor);

  std::vector<int> order_;  // n, the point of the right-hand sides for each row of the factor
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;  // by supernode: the rows of the factor below its columns
  // By supernode: its triangle row by row, with inverted diagonal; then the rows below, of `columns` numbers
  // each.
  LargeArray<Real> values_;
  mutable Points<Real> work_;  // n
};

}  // namespace bendlab
