// The pairs (s, y) of L-BFGS (Nocedal 1980), and the search direction that follows from the pairs. s is a
// move, and y is the change of the gradient along s. A constant matrix A, the metric, is the first estimate
// of the Hessian.
//
// The usual two loops of L-BFGS read every vector twice, and change the direction with every vector. Here A⁻¹
// is applied to the gradient alone: p = A⁻¹ g. Since z = A⁻¹ y is the difference of two vectors p, the
// direction is a sum of known vectors,
//
//   d = p - Σ α_i z_i + Σ (α_i - β_i) s_i,
//
// and α and β follow from the dot products of s_i and z_i with g, and with every newer y. One pass through
// memory computes all these dot products.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bendlab/constraints/point.hpp"
#include "bendlab/settings/archive.hpp"

namespace bendlab {

template <class Real>
class PairHistory {
 public:
  /// Stores the last `most` pairs of vectors of `count` points.
  PairHistory(std::size_t count, std::size_t most);

  void clear() { pairs_ = 0; }
  /// Forgets the last place, so that the next place does not form a pair with the last place.
  void forget_last() { last_x_.clear(); }

  /// A place: positions of the cloth, and the gradient of the energy at these positions.
  struct Place {
    const Points<Real>& x;
    const Points<Real>& gradient;  ///< g
    const Points<Real>& applied;   ///< p = A⁻¹ g
    /// Corrections to g and p of the last place, if the minimised function has changed since the last place;
    /// null if the function has not changed.
    const Points<Real>* gradient_before = nullptr;
    const Points<Real>* applied_before = nullptr;
  };
  /// The slopes of the energy along the move s from the last place to this place.
  struct Along {
    double before = 0;  ///< s·g at the last place, J; below 0 if the move began downhill
    double after = 0;   ///< s·g at this place, J
  };

  /// Adds a place. Stores the pair of the last place and this place if the curvature of the energy along the
  /// move is more than a tenth of the curvature of inertia, s·W s. W is `weights`, one for each point, in
  /// N/m. If the curvature is smaller, the elastic energy has negative curvature, or rounding is the cause.
  /// Returns nothing if there is no last place.
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
