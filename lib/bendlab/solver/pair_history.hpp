// The pairs (s, y) of a quasi-Newton method, where s is a move and y the change of the gradient along it, and
// the search direction that they give: L-BFGS (Nocedal 1980) with a constant matrix A, the metric, as first
// estimate of the Hessian.
//
// The usual two loops of L-BFGS read every vector twice, and change the direction with every vector. Here A⁻¹
// is applied to the gradient alone: p = A⁻¹ g. Since z = A⁻¹ y is a difference of two such p, the direction
// is a sum of known vectors,
//
//   d = p - Σ α_i z_i + Σ (α_i - β_i) s_i,
//
// and α and β follow from dot products: of s_i and z_i with g, and of s_i and z_i with every newer y. One
// pass through memory finds all of them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bendlab/constraints/point.hpp"
#include "bendlab/parameters/archive.hpp"

namespace bendlab {

template <class Real>
class PairHistory {
 public:
  /// Keeps the last `most` pairs of vectors of `count` points.
  PairHistory(std::size_t count, std::size_t most);

  void clear() { pairs_ = 0; }
  /// The next place will form no pair with the last place.
  void forget_last() { last_x_.clear(); }

  /// Positions of the cloth, and the gradient of the energy there.
  struct Place {
    const Points<Real>& x;
    const Points<Real>& gradient;  ///< g
    const Points<Real>& applied;   ///< p = A⁻¹ g
    /// Corrections to add to the g and p of the last place if the minimised function has changed since then.
    /// Null if it has not.
    const Points<Real>* gradient_before = nullptr;
    const Points<Real>* applied_before = nullptr;
  };
  /// The slopes of the energy along the move s from the last place to this place.
  struct Along {
    double before = 0;  ///< s·g at the last place, J; below 0 if the move began downhill
    double after = 0;   ///< s·g at this place, J
  };

  /// Keeps the pair of the last place and this place, if there is a last place and if the curvature of the
  /// energy along the move is more than a tenth of the curvature of inertia, s·W s. W is `weights`, one for
  /// each point, in N/m. A smaller curvature comes from negative curvature of the elastic energy, or from
  /// rounding.
  std::optional<Along> add(const Place& place, const std::vector<Real>& weights);

  /// Writes the search direction d at the last place; the next move is -d. `direction` may be `applied`
  /// itself.
  void direct(const Points<Real>& applied, Points<Real>& direction) const;

  std::size_t memory_bytes() const;
  void archive(Archive& state);

 private:
  struct Pair {
    Points<Real> move, applied;  // s and z
    double curvature = 0;        // s·y
  };
  std::size_t newest(std::size_t i) const { return (next_ + pair_.size() - 1 - i) % pair_.size(); }
  // s·y and z·y, with s and z of the pair `older` and y of the pair `newer`.
  double& moves(std::size_t older, std::size_t newer) { return move_change_[older * pair_.size() + newer]; }
  double& metrics(std::size_t older, std::size_t newer) {
    return applied_change_[older * pair_.size() + newer];
  }

  std::size_t count_, pairs_ = 0, next_ = 0;              // points; pairs kept; index of the next pair
  std::vector<Pair> pair_;                                // most + 1, with the pair that is being made
  std::vector<double> move_change_, applied_change_;      // s_i·y_j and z_i·y_j for a pair i and a newer j
  std::vector<double> move_gradient_, applied_gradient_;  // s_i·g and z_i·g of the last place
  Points<Real> last_x_, last_gradient_, last_applied_;    // empty: there is no last place
};

}  // namespace bendlab
