// The pairs of moves and gradients of a quasi-Newton method, and the direction that they give (L-BFGS:
// Nocedal 1980, in two loops).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bendlab/constraints/large_array.hpp"
#include "bendlab/parameters/archive.hpp"

namespace bendlab {

template <class Real>
class PairHistory {
 public:
  /// Keeps the last `most` pairs of vectors of `size` numbers.
  PairHistory(std::size_t size, std::size_t most) : size_(size), pairs_(most) {}

  void clear() { count_ = 0; }
  /// The next gradient belongs to no pair with the last one.
  void forget_last() { last_x_.clear(), last_gradient_.clear(); }
  std::size_t count() const { return count_; }

  /// Keeps s = x - last x and y = gradient - last gradient, if that is not the first call since
  /// forget_last(), and if s·y is at least a tenth of s·W s: what inertia alone resists. Less is negative
  /// curvature of the elastic energy, or rounding. Vectors of `size` numbers, a weight for four of them.
  void add(const Real* x, const Real* gradient, const Real* weights);

  /// Turns a gradient into a direction: loops over the pairs, with `apply_metric(vector)` between them.
  template <class ApplyMetric>
  void direct(Real* vector, const ApplyMetric& apply_metric) {
    std::vector<double> alpha(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const Pair& pair = newest(i);
      alpha[i] = dot(pair.move.data(), vector) / pair.curvature;
      add_scaled(vector, static_cast<Real>(-alpha[i]), pair.change.data());
    }
    apply_metric(vector);
    for (std::size_t i = count_; i-- > 0;) {
      const Pair& pair = newest(i);
      const double beta = dot(pair.change.data(), vector) / pair.curvature;
      add_scaled(vector, static_cast<Real>(alpha[i] - beta), pair.move.data());
    }
  }

  std::size_t memory_bytes() const;
  void archive(Archive& state);

 private:
  struct Pair {
    LargeArray<Real> move, change;
    double curvature = 0;  // s·y
  };
  Pair& newest(std::size_t i) { return pairs_[(next_ + pairs_.size() - 1 - i) % pairs_.size()]; }

  double dot(const Real* a, const Real* b) const;
  void add_scaled(Real* to, Real scale, const Real* from) const;

  std::size_t size_, count_ = 0, next_ = 0;
  std::vector<Pair> pairs_;
  LargeArray<Real> last_x_, last_gradient_;
};

}  // namespace bendlab
