// The pairs of moves and gradients of a quasi-Newton method, and the direction that they give (L-BFGS,
// Nocedal 1980) on a constant metric A.
//
// The two loops of L-BFGS over pairs (s, y) read every vector twice and change the direction with each. Here
// the metric is applied to the gradient alone, p = A⁻¹ g. Since z = A⁻¹ y is a difference of two p, the
// direction is a sum of known vectors,
//
//   d = p - Σ α_i z_i + Σ (α_i - β_i) s_i,
//
// and α and β follow from the dots of s_i and z_i with g and with newer y, which one pass through memory
// finds.
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
  /// The next gradient belongs to no pair with the last one.
  void forget_last() { last_x_.clear(); }

  /// Where the cloth is, and how the energy changes there.
  struct Place {
    const Points<Real>& x;
    const Points<Real>& gradient;  ///< g
    const Points<Real>& applied;   ///< p = A⁻¹ g
    /// Corrections to add to the last g and p if the function that is minimised changed since. Null if it
    /// did not.
    const Points<Real>* gradient_before = nullptr;
    const Points<Real>* applied_before = nullptr;
  };
  /// How the energy changed along the move s from the last place to this one.
  struct Along {
    double before = 0;  ///< s·g there, J; below 0 if the move began downhill
    double after = 0;   ///< s·g here
  };

  /// Keeps the pair of the last place and this one, if there was one and if the energy's curvature along the
  /// move is at least a tenth of that of inertia, s·W s with a weight for each point in N/m. Less is negative
  /// curvature of the elastic energy, or rounding.
  std::optional<Along> add(const Place& place, const std::vector<Real>& weights);

  /// Writes the direction to go against at the last place; `direction` may be `applied` itself.
  void direct(const Points<Real>& applied, Points<Real>& direction) const;

  std::size_t memory_bytes() const;
  void archive(Archive& state);

 private:
  struct Pair {
    Points<Real> move, applied;  // s and z
    double curvature = 0;        // s·y
  };
  std::size_t newest(std::size_t i) const { return (next_ + pair_.size() - 1 - i) % pair_.size(); }
  // Of the pair at `older` with a newer one.
  double& moves(std::size_t older, std::size_t newer) { return move_change_[older * pair_.size() + newer]; }
  double& metrics(std::size_t older, std::size_t newer) {
    return applied_change_[older * pair_.size() + newer];
  }

  std::size_t count_, pairs_ = 0, next_ = 0;          // points; pairs that are kept; where the next one goes
  std::vector<Pair> pair_;                            // most + 1: the next one is being made
  std::vector<double> move_change_, applied_change_;  // s_i·y_j and z_i·y_j of each pair i and a newer j
  std::vector<double> move_gradient_, applied_gradient_;  // s_i·g and z_i·g of the last place
  Points<Real> last_x_, last_gradient_, last_applied_;    // empty: there is no last place
};

}  // namespace bendlab
