// Own elements: elements that a model of the program defines by a function, which evaluates many elements at
// once. Own elements need no new kind, may have any number of vertices, and may have an energy instead of a
// constraint. The kinds of kinds.hpp have kernels, which are faster.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A constraint C with the energy ½ C² / α, or an energy U that is divided by α. C and U must not change if
/// the element is translated, because single precision passes positions relative to another origin.
class ElementFunction {
 public:
  virtual ~ElementFunction() = default;
  virtual std::string_view name() const = 0;  ///< in run files
  virtual bool is_energy() const { return false; }
  /// Computes C (or U) and its gradient for the elements `which`, whose corners are `corners`, #which by
  /// arity by 3, m. Fills `values`, #which, and `gradients`, in the shape of `corners`. An element whose
  /// value is not finite counts as collapsed and does not act. The step forwards exceptions.
  virtual void evaluate(std::span<const int> which, std::span<const double> corners, std::span<double> values,
                        std::span<double> gradients) const = 0;
};

struct OwnElements {
  std::shared_ptr<const ElementFunction> function;  ///< null: there are no own elements
  std::size_t arity = 0;
  std::size_t directors = 0;     ///< the last corners of an element are directors (directors.hpp)
  std::vector<int> vertices;     ///< #C by arity
  std::vector<double> softness;  ///< #C, XPBD: α is the softness times the scene's compliance

  std::size_t size() const { return softness.size(); }
  std::span<const int> corners(std::size_t c) const { return std::span(vertices).subspan(c * arity, arity); }
};

/// C (or U) and gradients (#C by arity by 3) of all elements.
struct OwnValues {
  std::vector<double> values, gradients;
};
OwnValues evaluate(const OwnElements& list, const Positions& positions);

/// Second derivatives of C (or U) by central differences: #C symmetric matrices, 3 arity by 3 arity. Rows and
/// columns before `first` are 0.
std::vector<Eigen::MatrixXd> second_derivatives(const OwnElements& list, const Positions& positions,
                                                std::size_t first = 0);

/// Elastic energy (J) multiplied by the scene's compliance.
double elastic_energy(const OwnElements& list, const Positions& positions);

/// Own elements in the order in which the solver projects them. Vertices are permuted.
template <class Real>
struct OwnBatch {
  OwnElements list;
  BatchOrder order;
  std::vector<std::vector<int>> groups;  ///< elements that evaluate() takes at once, in order
  std::vector<double> multiplier;        ///< λ, #C; empty without XPBD
  StiffnessKind kind = StiffnessKind::k;
  double k = 1;           ///< fraction per projection
  double compliance = 0;  ///< α is this times the softness
  std::size_t count = 0;
};

/// A batch from a list, in the given order.
template <class Real>
OwnBatch<Real> make_own_batch(OwnElements list, BatchOrder order);

/// Projects every element once; an energy U is projected as the constraint √(2 U).
template <class Real>
void project(const Places<Real>& places, OwnBatch<Real>& batch, Real substep, bool backwards);

/// Adds the force -ψ' ∇C of each element to `forces`, N. The compliance has to be above 0.
template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const OwnBatch<Real>& batch);

/// Removes the fraction `k` of each element's rate of change from the velocities.
template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const OwnBatch<Real>& batch, Real k);

}  // namespace bendlab
