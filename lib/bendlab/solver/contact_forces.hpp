// Obstacles, layers of cloth and friction as forces of an implicit step.
//
// The passes of a contact say where each vertex would have to be, P(x). It is pushed as by a stiff spring,
//
//   f_n = κ (P(x) - x),   n = f_n / |f_n|,   of stiffness κ n nᵀ,   κ = a w + b m
//
// with the weight w of inertia and the mass m: vertices that carry their own weight sink in equally, and do
// not strain the cloth. Friction holds it against its slip s, the way in the plane across n that it went with
// respect to the obstacle in this substep:
//
//   f_t = -k s,   k = κ where it holds, else min(κ, μ N / |s|)
//
// That is Coulomb's law: at its limit μ N if it slides, else what a stiff spring holds, whose slip is taken
// back at the end. In the matrix of an iteration k is taken as it is at the present s, so that iterations of
// a Newton method lower what they minimise (each has the curvature of a parabola that lies above: Hunter and
// Lange 2004, §3). Friction holds if that takes no more than μ N. N is (κ + w) |P(x) - x|, because what the
// vertex sinks in is taken back at the end; of this or the last iteration, whichever is less: where a vertex
// has just sunk in it is far too large. μ is μ_s where friction holds, μ_k where it slides.
//
// Two rules make iterations converge. What was pushed is pushed until it leaves the plane of its last push: on
// a curved obstacle a move across n leaves the surface, but not the plane. And what gives way in the later half
// of the iterations holds again only where its spring alone is within the limit: else holding and sliding
// would take turns, as the force that it takes to hold leaves out the cloth beside it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "bendlab/constraints/state.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {

template <class Real>
class ContactForces {
 public:
  using Vector = Vector3Of<Real>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;

  ContactForces() = default;
  /// a, and b in N/m per kg.
  ContactForces(double per_weight, double per_mass)
      : per_weight_(static_cast<Real>(per_weight)), per_mass_(static_cast<Real>(per_mass)) {}

  /// For so many slots.
  void resize(std::size_t slots) { before_.resize(slots), contacts_.resize(slots); }
  bool in_use() const { return !contacts_.empty(); }

  /// Before the passes change positions.
  void remember(State<Real>& state) {
    before_ = state.position;
    state.contacts.clear();
  }

  /// Takes what the passes changed back, as forces. `weights`: #V.
  void push(State<Real>& state, const std::vector<Real>& weights, bool is_first_iteration) {
    std::swap(state.position, before_);  // before_ is P(x) for a moment
    for (std::size_t v = 0; v < weights.size(); ++v) {
      One& one = contacts_[v];
      if (is_first_iteration) {
        one.holds = one.holds && one.touched != 0;
        one.touched = 0, one.earlier = one.last_grip = 0, one.normal = Vector::Zero();
        one.gave_way = false;
      } else {
        one.earlier = one.carrying_force, one.last_grip = one.grip;
      }
      const Vector way = before_[v].vector() - state.position[v].vector();
      Real depth = weights[v] > 0 ? way.norm() : Real(0);
      one.at = state.position[v].vector();
      if (depth > 0) one.normal = way / depth, one.surface = one.normal.dot(before_[v].vector());
      if (depth == 0 && !is_first_iteration && one.stiffness > 0)
        depth = std::max(Real(0), one.surface - one.normal.dot(one.at));
      one.stiffness =
          depth > 0 ? per_weight_ * weights[v] + per_mass_ * static_cast<Real>(state.mass[v]) : Real(0);
      one.normal_force = one.stiffness * depth;
      one.carrying_force = one.normal_force + weights[v] * depth;
      one.grip = 0, one.slip = Vector::Zero();
      one.touched |= depth > 0;
      one.holds = one.holds && (depth > 0 || is_first_iteration);
      one.inertia = weights[v];
    }
    before_ = state.position;
  }

  /// Friction, from State::contacts. Returns how many vertices it holds.
  std::uint64_t grip(State<Real>& state, const FrictionCoefficients& friction, bool decides_late) {
    if (!in_use()) return 0;
    for (One& one : contacts_) one.pressed = 0, one.carried = Vector::Zero();
    for (const Contact<Real>& contact : state.contacts) {
      One& one = contacts_[contact.vertex];
      one.pressed += contact.depth, one.carried += contact.depth * contact.carried;
    }
    state.contacts.clear();
    std::uint64_t held = 0;
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v) {
      One& one = contacts_[v];
      if (one.pressed > 0) one.with = one.carried / one.pressed;
      if (!(one.stiffness > 0)) continue;
      one.slip = across(one, state.position[v].vector() - state.previous[v].vector() - one.with);
      const Real length = one.slip.norm();
      // What held in the last substep does so until there is a force to compare with.
      if (const Real carries = std::min(one.carrying_force, one.earlier); carries > 0) {
        const Real most = static_cast<Real>(friction.at_rest) * carries,
                   sliding = static_cast<Real>(friction.sliding) * carries;
        // What it takes to hold it: the force that acted in the last iteration, and its inertia. That leaves
        // out its neighbours: what gave way once holds only where the spring alone is within its limit.
        const bool held_before = one.holds;
        one.holds = ((one.gave_way ? one.stiffness : one.last_grip) + one.inertia) * length <= most;
        one.gave_way |= decides_late && held_before && !one.holds;
        one.grip = one.holds || !(length > 0) ? one.stiffness : std::min(one.stiffness, sliding / length);
      } else {
        one.grip = one.holds ? one.stiffness : Real(0);
      }
      held += one.grip > 0 ? 1 : 0;
    }
    return held;
  }

  /// At the end of a substep: takes back what springs of friction let slip that holds.
  void hold(State<Real>& state) const {
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
      if (const One& one = contacts_[v]; one.holds && one.stiffness > 0) {
        Point<Real>& p = state.position[v];
        p.set(p.vector() - across(one, one.slip + p.vector() - one.at));
      }
  }

  bool touched(std::size_t v) const { return contacts_[v].touched != 0; }  ///< in this substep
  bool holds(std::size_t v) const { return contacts_[v].holds; }           ///< friction, at its end
  /// Of the last push of this substep; zero: there was none.
  const Vector& normal(std::size_t v) const { return contacts_[v].normal; }
  bool pushes(std::size_t v) const { return contacts_[v].stiffness > 0; }  ///< in this iteration
  /// f_n + f_t, N, where the iteration began.
  Vector force(std::size_t v) const {
    const One& one = contacts_[v];
    return one.normal_force * one.normal - one.grip * one.slip;
  }
  /// The same to first order at another position of the vertex.
  Vector force_at(std::size_t v, const Vector& position) const {
    return force(v) - stiffness(v) * (position - contacts_[v].at);
  }
  /// κ n nᵀ + k (1 - n nᵀ), N/m.
  Matrix stiffness(std::size_t v) const {
    const One& one = contacts_[v];
    if (!(one.stiffness > 0)) return Matrix::Zero();
    return one.grip * Matrix::Identity() + (one.stiffness - one.grip) * one.normal * one.normal.transpose();
  }
  /// What is left of a vertex' other forces at a position: those along the normal are carried, and friction
  /// holds.
  Vector along(std::size_t v, const Vector& force, const Vector& position) const {
    const One& one = contacts_[v];
    if (!(one.stiffness > 0)) return force;
    return across(one, Vector(force - one.grip * (one.slip + position - one.at)));
  }
  /// Positions before the passes of the last iteration, or of the end of the substep.
  const Points<Real>& before() const { return before_; }

  std::size_t memory_bytes() const { return bytes_of(before_) + contacts_.capacity() * sizeof(One); }
  /// What the next substep needs.
  void archive(Archive& state) {
    std::vector<std::uint8_t> flags(contacts_.size());
    for (std::size_t v = 0; v < flags.size(); ++v)
      flags[v] = static_cast<std::uint8_t>(contacts_[v].touched | (contacts_[v].holds ? 2 : 0));
    state(flags);
    if (!state.reads()) return;
    for (std::size_t v = 0; v < flags.size() && v < contacts_.size(); ++v)
      contacts_[v].touched = flags[v] & 1, contacts_[v].holds = (flags[v] & 2) != 0;
  }

 private:
  struct One {
    Vector normal = Vector::Zero(), at = Vector::Zero();     // at: x, m
    Vector slip = Vector::Zero(), carried = Vector::Zero();  // s, m; Σ depth · carried
    Vector with = Vector::Zero();                            // how far the obstacle went in the substep, m
    Real surface = 0;                                        // n · P(x) of the last push, m
    Real stiffness = 0, grip = 0;                            // κ and k, N/m; κ = 0: nothing pushes
    Real normal_force = 0, carrying_force = 0, earlier = 0;  // |f_n|, N, N of the last iteration; N
    Real pressed = 0, inertia = 0;                           // Σ depth, m; w, N/m
    std::uint8_t touched = 0;
    Real last_grip = 0;  // k of the last iteration, N/m
    bool holds = false;  // friction stays below its limit
    bool gave_way = false;
  };
  static Vector across(const One& one, const Vector& v) { return v - one.normal.dot(v) * one.normal; }

  Real per_weight_ = 0, per_mass_ = 0;
  Points<Real> before_;
  std::vector<One> contacts_;
};

}  // namespace bendlab
