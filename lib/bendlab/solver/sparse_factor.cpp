#include "bendlab/solver/sparse_factor.hpp"

#include <Eigen/CholmodSupport>
#include <stdexcept>

#include "bendlab/constraints/quad.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/one_blas_thread.hpp"

namespace bendlab {
namespace {

using detail::load_point, detail::store_point;

// CHOLMOD's own arrays, which Eigen hides.
struct Supernodal : Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> {
  const cholmod_factor& factor() const { return *m_cholmodFactor; }
};

}  // namespace

template <class Real>
SparseFactor<Real>::SparseFactor(const Eigen::SparseMatrix<double>& lower) {
  if (lower.rows() == 0) return;
  one_blas_thread();
  Supernodal solver;
  solver.cholmod().print = 0;
  solver.cholmod().nmethods = 1;
  solver.cholmod().method[0].ordering = CHOLMOD_AMD;
  solver.compute(lower);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(
        "the matrix of inertia and stiffness is not positive definite after rounding: the stiffness of "
        "bending, the stiffness of the membrane and the mass differ by too many powers of ten. State a lower "
        "stiffness");
  keep(solver.factor());
}

template <class Real>
void SparseFactor<Real>::keep(const cholmod_factor_struct& factor) {
  const auto* const super = static_cast<const int*>(factor.super);
  const auto* const row_starts = static_cast<const int*>(factor.pi);
  const auto* const value_starts = static_cast<const int*>(factor.px);
  const auto* const rows = static_cast<const int*>(factor.s);
  const auto* const values = static_cast<const double*>(factor.x);
  const auto* const order = static_cast<const int*>(factor.Perm);
  order_.assign(order, order + factor.n);
  work_.resize(factor.n);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const int columns = super[s + 1] - super[s], height = row_starts[s + 1] - row_starts[s];
    const double* const block = values + value_starts[s];  // column by column, `height` numbers each
    const auto at = [&](int row, int column) { return block[column * height + row]; };
    supernodes_.push_back({super[s], columns, rows_.size(), values_.size(), height - columns});
    for (int row = 0; row < columns; ++row) {
      for (int column = 0; column < row; ++column) values_.push_back(static_cast<Real>(at(row, column)));
      values_.push_back(static_cast<Real>(1 / at(row, row)));
    }
    for (int row = columns; row < height; ++row) {
      rows_.push_back(rows[row_starts[s] + row]);
      for (int column = 0; column < columns; ++column) values_.push_back(static_cast<Real>(at(row, column)));
    }
  }
}

template <class Real>
void SparseFactor<Real>::renumber(const std::vector<int>& points) {
  for (int& row : order_) row = points[static_cast<std::size_t>(row)];
}

template <class Real>
void SparseFactor<Real>::solve(const Point<Real>* right, Point<Real>* solution) const {
  using Quad = typename detail::QuadType<Real>::type;
  Point<Real>* const x = work_.data();
  for (std::size_t i = 0; i < order_.size(); ++i) x[i] = right[order_[i]];
  for (const Supernode& node : supernodes_) {
    const Real* value = values_.data() + node.values;
    Point<Real>* const own = x + node.first;
    for (int row = 0; row < node.columns; ++row) {
      Quad sum = load_point(own[row]);
      for (int column = 0; column < row; ++column) sum -= *value++ * load_point(own[column]);
      store_point<Real>(own[row], *value++ * sum);
    }
    const int* const rows = rows_.data() + node.rows;
    int row = 0;
    // Four rows at a time, because all four use one load of a column's point, and their sums run in parallel.
    for (; row + 4 <= node.row_count; row += 4, value += 4 * node.columns) {
      Quad sums[4] = {load_point(x[rows[row]]), load_point(x[rows[row + 1]]), load_point(x[rows[row + 2]]),
                      load_point(x[rows[row + 3]])};
      for (int column = 0; column < node.columns; ++column) {
        const Quad solved = load_point(own[column]);
        for (int r = 0; r < 4; ++r) sums[r] -= value[r * node.columns + column] * solved;
      }
      for (int r = 0; r < 4; ++r) store_point<Real>(x[rows[row + r]], sums[r]);
    }
    for (; row < node.row_count; ++row, value += node.columns) {
      Quad sum = load_point(x[rows[row]]);
      for (int column = 0; column < node.columns; ++column) sum -= value[column] * load_point(own[column]);
      store_point<Real>(x[rows[row]], sum);
    }
  }
  for (std::size_t s = supernodes_.size(); s-- > 0;) {
    const Supernode& node = supernodes_[s];
    const Real* const triangle = values_.data() + node.values;
    const Real* const below = triangle + node.columns * (node.columns + 1) / 2;
    const int* const rows = rows_.data() + node.rows;
    Point<Real>* const own = x + node.first;
    int column = 0;
    for (; column + 4 <= node.columns; column += 4) {
      Quad sums[4] = {load_point(own[column]), load_point(own[column + 1]), load_point(own[column + 2]),
                      load_point(own[column + 3])};
      const Real* value = below + column;
      for (int row = 0; row < node.row_count; ++row, value += node.columns) {
        const Quad solved = load_point(x[rows[row]]);
        for (int c = 0; c < 4; ++c) sums[c] -= value[c] * solved;
      }
      for (int c = 0; c < 4; ++c) store_point<Real>(own[column + c], sums[c]);
    }
    for (; column < node.columns; ++column) {
      Quad sum = load_point(own[column]);
      const Real* value = below + column;
      for (int row = 0; row < node.row_count; ++row, value += node.columns)
        sum -= *value * load_point(x[rows[row]]);
      store_point<Real>(own[column], sum);
    }
    for (int row = node.columns; row-- > 0;) {
      const Real* const value = triangle + row * (row + 1) / 2;
      const Quad solved = value[row] * load_point(own[row]);
      store_point<Real>(own[row], solved);
      for (int c = 0; c < row; ++c) store_point<Real>(own[c], load_point(own[c]) - value[c] * solved);
    }
  }
  for (std::size_t i = 0; i < order_.size(); ++i) solution[order_[i]] = x[i];
}

template <class Real>
std::size_t SparseFactor<Real>::memory_bytes() const {
  return bytes_of(order_) + bytes_of(supernodes_) + bytes_of(rows_) + bytes_of(values_) + bytes_of(work_);
}

template class SparseFactor<float>;
template class SparseFactor<double>;

}  // namespace bendlab
