// The elastic energy of a scene's constraints as a function of its free vertices, with gradient and Hessian:
// what XPBD approaches when it converges, and what a static equilibrium minimises together with its loads.
//
//   E = Σ ψ(C),   ∇E = Σ ψ'(C) ∇C,   ∇²E = Σ ψ''(C) ∇C ∇Cᵀ + ψ'(C) ∇²C,   ψ = C² / 2α
//
// C and ∇C are the oracle's (oracle.hpp), so every kind of constraint has its equilibrium; ∇²C is the
// central difference of ∇C, which is exact to about ten digits and decides only how fast Newton's method
// converges. A term's multiplier is its ψ'(C), or an estimate of it. A kind that is OneSided has its own ψ.
// Where its force jumps (ArcSpring straight), it falls to 0 over `ramp` of its length instead: Newton's
// method needs a tangent.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class ElasticSystem {
 public:
  static constexpr double ramp = 1e-4;  ///< 1, of a one-sided element's length

  /// Throws std::invalid_argument unless strain and bending (where there are any) have a compliance above 0.
  explicit ElasticSystem(const SimulationInput& input);

  /// The strain constraints' compliance times this, from now on.
  void soften_strain(double factor) { strain_softness_ = factor; }

  int unknowns() const { return 3 * free_count_; }
  std::size_t term_count() const;
  std::size_t memory_bytes() const;  ///< its lists of constraints, and the Hessian
  /// Of each vertex, its number among the free ones, or -1. Unknowns 3 i to 3 i + 2 are the free vertex i's
  /// x, y, z.
  const std::vector<int>& free_index() const { return free_index_; }

  double energy(const Positions& positions) const;             ///< J; positions #V by 3, m
  Eigen::VectorXd gradient(const Positions& positions) const;  ///< unknowns, N
  Eigen::VectorXd multipliers(
      const Positions& positions) const;  ///< ψ'(C) of each term, 0 where it is collapsed

  /// With these for ψ'(C) in the second part. Lower triangle, N/m; valid until the next call.
  const Eigen::SparseMatrix<double>& hessian(const Positions& positions, const Eigen::VectorXd& multipliers);

  /// Multipliers with which the Hessian has no negative eigenvalue: those of lengths where they pull, 0
  /// elsewhere.
  Eigen::VectorXd convex(Eigen::VectorXd multipliers) const;

  /// A move by `step` (unknowns, m) to first order: ψ'(C) + ψ''(C) ∇C·step of each term.
  Eigen::VectorXd predicted_multipliers(const Positions& positions, const Eigen::VectorXd& step) const;
  /// The largest part of a triangle's strain after that move that is not of first order in it.
  double strain_beyond_first_order(const Positions& positions, const Eigen::VectorXd& step) const;
  Positions moved(const Positions& positions, const Eigen::VectorXd& step) const;

 private:
  template <class Visit>
  void for_terms(const Visit& visit) const;
  template <class Value, std::size_t N>
  double change_of(const Value& c, const std::array<int, N>& vertices, const Eigen::VectorXd& step) const;
  void find_pattern();
  void add_block(int row, int column, const Eigen::Matrix3d& block);

  StrainConstraints strain_;
  StrainStiffness strain_stiffness_;
  DistanceConstraints distance_;
  ElementLists elements_;
  double bending_compliance_, strain_softness_ = 1;
  std::vector<int> free_index_;
  int free_count_ = 0;
  Eigen::Index energy_terms_ = 0;
  std::vector<std::vector<int>>
      blocks_;  // of each free vertex, the free vertices ≥ it that it shares a term with
  Eigen::SparseMatrix<double> hessian_;
};

}  // namespace bendlab
