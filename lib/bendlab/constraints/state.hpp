// The data of a step: the cloth's state, the ordered constraints, and the passes that act on both.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/own_elements.hpp"
#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/quad.hpp"
#include "bendlab/settings/archive.hpp"

namespace bendlab {

/// A vertex that an obstacle pushed out in this iteration.
template <class Real>
struct Contact {
  std::size_t vertex;       ///< permuted: its index in State's arrays
  Vector3Of<Real> normal;   ///< unit, out of the obstacle
  Real depth;               ///< m, how far the vertex was pushed along the normal
  Vector3Of<Real> carried;  ///< m, how far the surface moves at the vertex in this substep
};

/// Adds a number or a vector of numbers to `sum`. Returns the rounding error (Knuth 1969, theorem 4.2.2 B).
template <class Number>
BENDLAB_INLINE Number sum_with_remainder(Number& sum, Number change) {
  const Number before = sum;
  sum = before + change;
  const Number done = sum - before;
  return (before - (sum - done)) + (change - done);
}

/// Positions and velocities of a cloth. Coordinates are relative to `origin`, so that they are more accurate
/// in single precision. The arrays of points have #V vertices in the order of the permutation, then the
/// directors of the bending model (directors.hpp), whose coordinates are relative to 0, then the dummy points
/// for padded lanes (batches.hpp).
template <class Real>
struct State {
  int vertex_count = 0;
  int point_count = 0;  ///< #P, vertices and directors
  Points<Real> position;  ///< w holds the inverse mass, 1/kg (0: pinned)
  Points<Real> previous;  ///< positions at the start of the substep
  Points<Real> velocity;  ///< m/s
  /// The rounding errors of positions (between substeps) and velocities: position + position_remainder is the
  /// exact position, and velocity + velocity_remainder the exact velocity. Only for pbd in single precision.
  Points<Real> position_remainder, velocity_remainder;
  std::vector<double> mass;  ///< #P, kg, pinned points too
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /// v += change. velocity_remainder stores the digits of a small change that v cannot store.
  void accelerate(std::size_t vertex, const Vector3Of<Real>& change) {
    using Quad = typename detail::QuadType<Real>::type;
    const Quad by = {change.x(), change.y(), change.z(), 0};
    Quad v = detail::load_point(velocity[vertex]);
    if (!velocity_remainder.empty()) {
      Point<Real>& remainder = velocity_remainder[vertex];
      detail::store_point<Real>(remainder, sum_with_remainder<Quad>(v, by + detail::load_point(remainder)));
    } else {
      v = v + by;
    }
    detail::store_point<Real>(velocity[vertex], v);
  }

  /// The contacts that obstacles found in this iteration; empty if no listed effect uses contacts.
  std::vector<Contact<Real>> contacts;
};

/// The scene's constraints, ordered: one batch per kind.
template <class Real>
struct Constraints {
  StrainBatch<Real> strain;
  DistanceBatch<Real> distance;
  ElementBatches<Real> elements;
  OwnBatch<Real> own;

  /// Calls action(batch) for every batch that has kernels.
  template <class Action>
  void for_each(const Action& action) {
    action(strain);
    action(distance);
    for_each_kind(elements, action);
  }
  template <class Action>
  void for_each(const Action& action) const {
    action(strain);
    action(distance);
    for_each_kind(elements, action);
  }
};

template <class Real>
struct PassContext {
  State<Real>& state;
  const Constraints<Real>& constraints;
  Real substep;             ///< h, s
  double time = 0;          ///< s, at the start of the substep
  std::uint64_t acted = 0;  ///< a pass adds the number of its changes (vertices, pairs …)
};

/// When in a substep a pass of an effect runs. Constraints are projected between `predicted` and `velocity`,
/// in turn with the passes of `project`.
enum class Stage {
  force,      ///< before prediction: v += h a
  damp,       ///< before prediction, on the velocities after `force`
  predicted,  ///< on the predicted positions, once: moves pins, finds parts that will be near
  project,    ///< on positions, after strain and bending in each iteration
  contact,    ///< on positions, after `project`, with the contacts found there
  velocity,   ///< after the velocities were updated from the projected positions
};

struct FrictionCoefficients {
  double at_rest, sliding;  ///< μ_s, μ_k
};

template <class Real>
struct Pass {
  std::string name;
  Stage stage = Stage::force;
  std::function<void(PassContext<Real>&)> run;
  /// For a pass that keeps data from one substep to the next: writes or reads these data. If an effect has
  /// several passes, only one pass needs this function.
  std::function<void(Archive&)> archive;
  /// For a pass that only slows vertices, m v' = -drag v: the drag in kg/s, #V, permuted. An implicit step
  /// solves its equations with this drag and does not run the pass.
  std::vector<double> drag;
  /// For a pass of Coulomb friction on obstacles: an implicit step solves its equations with these
  /// coefficients and does not run the pass.
  std::optional<FrictionCoefficients> friction;
};

}  // namespace bendlab
