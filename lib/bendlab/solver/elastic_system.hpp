// The elastic energy of a scene's constraints as a function of the free vertices' positions, with gradient
// and Hessian. If the bending model has directors (directors.hpp), these are unknowns like vertices: all
// arrays have #P points. XPBD approaches the minimum of this energy if its iterations converge. A static
// equilibrium minimises the sum of this energy and the energy of the loads.
//
//   E = Σ ψ(C),   ∇E = Σ ψ'(C) ∇C,   ∇²E = Σ ψ''(C) ∇C ∇Cᵀ + ψ'(C) ∇²C,   ψ = C² / 2α
//
// The last terms are those of the user's own elements (own_elements.hpp). If such an element states an energy
// U, ψ is U / α; if its multiplier is 0, negative eigenvalues are removed from its Hessian.
//
// C and ∇C come from the scalar code (oracle.hpp), which has every kind of constraint. ∇²C is the central
// difference of ∇C. The difference is exact to about ten digits, and affects only how fast Newton's method
// converges. The multiplier of a term is ψ'(C), or an estimate of ψ'(C). A kind that is OneSided has its own
// ψ. The force of a straight ArcSpring would jump, but Newton's method needs a tangent. So this force falls
// to 0 over the share `ramp` of the element's length.
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "bendlab/constraints/yielding.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class ElasticSystem {
 public:
  static constexpr double ramp = 1e-4;  ///< as a share of a one-sided element's length

  /// Throws std::invalid_argument if strain or bending constraints have no compliance above 0.
  explicit ElasticSystem(const SimulationInput& input);

  /// Multiplies the stated compliance of the strain constraints by `factor` from now on.
  void soften_strain(double factor) { strain_softness_ = factor; }
  /// Multiplies the stated stiffnesses from now on.
  void scale_stiffness(const StiffnessFactors& factors) {
    strain_stiffness_.compliance = stated_strain_ / factors.strain;
    bending_compliance_ = stated_bending_ / factors.bending;
  }

  /// Lets elements yield (yielding.hpp). Returns the number of elements that yielded.
  std::size_t yield(const Positions& positions) { return yield_to(elements_, positions); }
  /// Writes or reads what yielding changes.
  void archive_yields(Archive& state) {
    for_each_kind(elements_, [&](auto& list) { state(list.rest, list.moment.yield); });
  }

  int unknowns() const { return 3 * free_count_; }
  std::size_t term_count() const;
  std::size_t memory_bytes() const;  ///< its lists of constraints, and the Hessian
  /// #P: the index of each point among the free points, or -1. Unknowns 3 i to 3 i + 2 are x, y, z of the
  /// free point i.
  const std::vector<int>& free_index() const { return free_index_; }

  double energy(const Positions& positions) const;             ///< J; positions #P by 3, m
  Eigen::VectorXd gradient(const Positions& positions) const;  ///< unknowns, N
  Points<double> forces(
      const Positions& positions) const;  ///< #P, -∇E, 0 at pinned points and along held axes, N
  /// ψ'(C) of each term; 0 for a collapsed element.
  Eigen::VectorXd multipliers(const Positions& positions) const;

  /// The lower triangle of ∇²E, N/m, with `multipliers` in place of ψ'(C) as the factors of ∇²C. The
  /// reference is valid until the next call.
  const Eigen::SparseMatrix<double>& hessian(const Positions& positions, const Eigen::VectorXd& multipliers);

  /// Multipliers with which the Hessian has no negative eigenvalue: multipliers of stretched lengths are
  /// unchanged, and all other multipliers are 0.
  Eigen::VectorXd convex(Eigen::VectorXd multipliers) const;

  /// The multipliers after a move by `step` (unknowns, m) to first order: ψ'(C) + ψ''(C) ∇C·step.
  Eigen::VectorXd predicted_multipliers(const Positions& positions, const Eigen::VectorXd& step) const;
  /// The largest error, over all triangles, of the first-order estimate of the change of strain by `step`.
  double strain_beyond_first_order(const Positions& positions, const Eigen::VectorXd& step) const;
  Positions moved(const Positions& positions, const Eigen::VectorXd& step) const;
  /// Sets the entries of held coordinates (SimulationInput::held) to 0.
  void drop_held(Eigen::VectorXd& of_unknowns) const;

  /// Sums over the constraints that contain a vertex: the energy, J; the force on the vertex, N; and the
  /// vertex's own block of the Hessian, without the terms with ∇²C, N/m.
  struct AtVertex {
    double energy = 0;
    Vector3 force;
    Eigen::Matrix3d stiffness;
  };
  AtVertex at_vertex(const Positions& positions, int vertex);

 private:
  struct Visit;  // a function of an energy term
  void for_terms(const Visit& visit) const;
  /// Calls visit() for the terms of one constraint. `next` is the index of the constraint's first term, and
  /// increases by the number of the terms.
  void strain_terms(std::size_t t, Eigen::Index& next, const Visit& visit) const;
  void distance_term(std::size_t c, Eigen::Index& next, const Visit& visit) const;
  template <class Kind>
  void element_terms(const ElementList<Kind>& list, std::size_t c, Eigen::Index& next,
                     const Visit& visit) const;
  void find_constraints_at_vertices();
  /// Calls visit(term, element, ψ with its derivatives, gradient of C or U) for every own element.
  template <class Visitor>
  void own_terms(const Positions& positions, const Visitor& visit) const;
  void add_own_hessian(const Positions& positions, const Eigen::VectorXd& multipliers);
  template <class Value, std::size_t N>
  double change_of(const Value& c, const std::array<int, N>& vertices, const Eigen::VectorXd& step) const;
  void find_pattern();
  void hold_unread_coordinates();
  void uncouple_held();
  void add_blocks(std::span<const int> vertices, const double* matrix);

  StrainConstraints strain_;
  StrainStiffness strain_stiffness_;
  DistanceConstraints distance_;
  ElementLists elements_;
  OwnElements own_;
  double bending_compliance_, strain_softness_ = 1;
  double stated_strain_, stated_bending_;  // compliances
  std::vector<int> free_index_;
  std::vector<char> is_held_;  // of each unknown; empty: none is held
  int free_count_ = 0;
  std::size_t first_director_ = 0;  // among the points
  int read_coordinates_ = 1;        // of a director
  Eigen::Index energy_terms_ = 0;
  // For each free vertex: the free vertices of its terms whose index is not smaller than its own index.
  std::vector<std::vector<int>> blocks_;
  Eigen::SparseMatrix<double> hessian_;
  // #V: the constraints that contain each vertex. The first call of at_vertex() fills the lists. `list` is 0
  // for strain, 1 for distance, then 2 + kind_index.
  struct Listed {
    std::size_t list, index;
  };
  std::vector<std::vector<Listed>> constraints_at_;
};

}  // namespace bendlab
