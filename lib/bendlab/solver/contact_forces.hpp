// Obstacles, layers of cloth and friction as forces of an implicit step.
//
// The passes of a contact say where each vertex would have to be, P(x). P(x) - x is the push of obstacles,
// d n, and that of other layers, l. Both act as stiff springs,
//
//   f = κ (d n + l),   of stiffness κ n nᵀ + κ l lᵀ / l²,   κ = a w + b m
//
// with the weight w of inertia and the mass m: vertices that carry their own weight sink in equally, and do
// not strain the cloth, and layers push each other with the same force, as their passes keep momentum. Pushes
// that are not in State::contacts and do not keep it are of obstacles, too, without friction.
// Friction holds a vertex against its slip s, the way in the plane across n that it went with respect to the
// obstacle in this substep:
//
//   f_t = -k s,   k = κ where it holds, else min(κ, μ N / |s|)
//
// That is Coulomb's law: at its limit μ N if it slides, else what a stiff spring holds, whose slip is taken
// back at the end. In the matrix of an iteration k is taken as it is at the present s, so that iterations of
// a Newton method lower what they minimise (each has the curvature of a parabola that lies above: Hunter and
// Lange 2004, §3). Friction holds if that takes no more than μ N. N is (κ + w) d, because what the vertex
// sinks in is taken back at the end; of this or the last iteration, whichever is less: where a vertex has
// just sunk in it is far too large. μ is μ_s where friction holds, μ_k where it slides.
//
// Two rules make iterations converge. What an obstacle pushed it pushes until the vertex leaves the plane of
// the last push: on a curved obstacle a move across n leaves the surface, but not the plane. And what gives
// way in the later half of the iterations holds again only where its spring alone is within the limit: else
// holding and sliding would take turns, as the force that it takes to hold leaves out the cloth beside it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
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

  /// Takes what the passes changed back, as forces. `weights`: #V. Obstacles have filled State::contacts.
  void push(State<Real>& state, const std::vector<Real>& weights, bool is_first_iteration) {
    std::swap(state.position, before_);  // before_ is P(x) for a moment
    for (One& one : contacts_) one.pushed = one.carried = Vector::Zero();
    for (const Contact<Real>& contact : state.contacts) {
      One& one = contacts_[contact.vertex];
      one.pushed += contact.depth * contact.normal, one.carried += contact.depth * contact.carried;
    }
    state.contacts.clear();
    Vector momentum = Vector::Zero();  // times the substep
    Real moved = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) {
      One& one = contacts_[v];
      if (is_first_iteration) one.start();
      if (!(weights[v] > 0)) continue;
      one.find_layers(state.position[v].vector(), before_[v].vector());
      const auto mass = static_cast<Real>(state.mass[v]);
      momentum += mass * one.layers, moved += mass * one.layers.norm();
    }
    constexpr Real rounded = Real(1e-3);
    const bool among_layers = momentum.norm() <= rounded * moved;
    for (std::size_t v = 0; v < weights.size(); ++v)
      if (weights[v] > 0)
        contacts_[v].push(state.position[v].vector(), weights[v],
                          per_weight_ * weights[v] + per_mass_ * static_cast<Real>(state.mass[v]),
                          is_first_iteration, among_layers);
    before_ = state.position;
  }

  /// Friction on what obstacles push. Returns on how many vertices it acts.
  std::uint64_t grip(const State<Real>& state, const FrictionCoefficients& friction, bool decides_late) {
    if (!in_use()) return 0;
    std::uint64_t gripped = 0;
    decided_ = true;
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v) {
      One& one = contacts_[v];
      if (!(one.depth > 0) || !one.by_obstacle) continue;
      const Vector last_slip = one.slip;
      one.slip = one.across(state.position[v].vector() - state.previous[v].vector() - one.with);
      const Real length = one.slip.norm();
      const bool held_before = one.holds;
      // What held in the last substep does so until there is a force to compare with.
      if (const Real carries = std::min(one.carried_force, one.earlier); carries > 0) {
        const Real most = static_cast<Real>(friction.at_rest) * carries,
                   sliding = static_cast<Real>(friction.sliding) * carries;
        one.limit = sliding;
        // What it takes to hold it: the force that acted in the last iteration, and its inertia. That leaves
        // out its neighbours: what gave way once holds only where the spring alone is within its limit.
        // What holds gives way only if it was beyond its limit before, too: else those that hold and those
        // that slide may change places for ever, as each takes a part of the others' load.
        const bool within = ((one.gave_way ? one.stiffness : one.last_grip) + one.inertia) * length <= most;
        one.holds = within || (held_before && !one.was_beyond);
        one.was_beyond = held_before && !within;
        one.gave_way |= decides_late && held_before && !one.holds;
        one.grip = one.holds || !(length > 0) ? one.stiffness : std::min(one.stiffness, sliding / length);
        // While it slides farther with every iteration, only its direction is held against.
        if (!decides_late && !one.holds && one.grip < one.stiffness &&
            one.slip.dot(last_slip) > last_slip.squaredNorm())
          one.slides_along = one.slip / length;
      } else {
        one.grip = one.holds ? one.stiffness : Real(0);
      }
      gripped += one.grip > 0 ? 1 : 0;
      decided_ = decided_ && one.holds == held_before && !one.was_beyond;
    }
    return gripped;
  }

  /// At the end of a substep: takes back what springs of friction let slip that holds.
  void hold(State<Real>& state) const {
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
      if (const One& one = contacts_[v]; one.holds && one.depth > 0) {
        Point<Real>& p = state.position[v];
        p.set(p.vector() - one.across(one.slip + p.vector() - one.at));
      }
  }

  /// Whether the last iteration changed nothing about which vertices friction holds.
  bool decided() const { return decided_; }
  bool touched(std::size_t v) const { return contacts_[v].touched; }  ///< in this substep
  /// The velocity of what was pushed in this substep: `own`, that of the substep, along the push of an
  /// obstacle, and all of it where friction holds; else `kept`.
  Vector velocity(std::size_t v, const Vector& own, const Vector& kept) const {
    const One& one = contacts_[v];
    if (one.holds) return own;
    return kept + one.normal.dot(own - kept) * one.normal;
  }
  bool pushes(std::size_t v) const {  ///< in this iteration
    return contacts_[v].depth > 0 || contacts_[v].layers.squaredNorm() > 0;
  }
  /// f + f_t, N, where the iteration began.
  Vector force(std::size_t v) const {
    const One& one = contacts_[v];
    return obstacle_force(v) + one.stiffness * one.layers;
  }
  Vector obstacle_force(std::size_t v) const {
    const One& one = contacts_[v];
    return one.stiffness * one.depth * one.normal - one.grip * one.slip;
  }
  /// The same to first order at another position of the vertex.
  Vector force_at(std::size_t v, const Vector& position) const {
    return force(v) - stiffness(v) * (position - contacts_[v].at);
  }
  Vector obstacle_force_at(std::size_t v, const Vector& position) const {
    return obstacle_force(v) - obstacle_stiffness(v) * (position - contacts_[v].at);
  }
  /// N/m.
  Matrix stiffness(std::size_t v) const {
    const One& one = contacts_[v];
    Matrix whole = obstacle_stiffness(v);
    if (const Real l = one.layers.squaredNorm(); l > 0)
      whole += one.stiffness / l * one.layers * one.layers.transpose();
    return whole;
  }
  /// κ n nᵀ + k (1 - n nᵀ), N/m.
  Matrix obstacle_stiffness(std::size_t v) const {
    const One& one = contacts_[v];
    if (!(one.depth > 0)) return Matrix::Zero();
    return one.grip * (Matrix::Identity() - one.slides_along * one.slides_along.transpose()) +
           (one.stiffness - one.grip) * one.normal * one.normal.transpose();
  }
  /// What is left of a vertex' other forces at a position: those along pushes are carried, and friction
  /// holds.
  Vector along(std::size_t v, const Vector& force, const Vector& position) const {
    const One& one = contacts_[v];
    Vector left = force;
    if (one.depth > 0) {
      const Vector slip = one.slip + one.across(position - one.at);
      const Real length = slip.norm(),
                 grip = one.holds || !(length > 0) ? one.grip : std::min(one.grip, one.limit / length);
      left = one.across(force - grip * slip);
    }
    if (const Real l = one.layers.squaredNorm(); l > 0) left -= one.layers.dot(left) / l * one.layers;
    return left;
  }
  /// Positions before the passes of the last iteration, or of the end of the substep.
  const Points<Real>& before() const { return before_; }

  std::size_t memory_bytes() const { return bytes_of(before_) + contacts_.capacity() * sizeof(One); }
  /// What the next substep needs.
  void archive(Archive& state) {
    std::vector<std::uint8_t> flags(contacts_.size());
    for (std::size_t v = 0; v < flags.size(); ++v)
      flags[v] = static_cast<std::uint8_t>((contacts_[v].touched ? 1 : 0) | (contacts_[v].holds ? 2 : 0));
    state(flags);
    if (!state.reads()) return;
    for (std::size_t v = 0; v < flags.size() && v < contacts_.size(); ++v)
      contacts_[v].touched = (flags[v] & 1) != 0, contacts_[v].holds = (flags[v] & 2) != 0;
  }

 private:
  struct One {
    Vector normal = Vector::Zero(), at = Vector::Zero();       // at: x, m
    Vector layers = Vector::Zero(), slip = Vector::Zero();     // l and s, m
    Vector pushed = Vector::Zero(), carried = Vector::Zero();  // Σ depth · normal, m; Σ depth · carried, m²
    Vector slides_along = Vector::Zero();         // unit; zero: it does not slide farther and farther
    Vector with = Vector::Zero();                 // how far the obstacle went in the substep, m
    Real depth = 0, surface = 0;                  // d; n · P(x) of the last push, m
    Real stiffness = 0, grip = 0, last_grip = 0;  // κ, k, and k of the last iteration, N/m
    Real carried_force = 0, earlier = 0;          // N, and that of the last iteration
    Real limit = 0;                               // μ_k N, where it slides, N
    Real inertia = 0;                             // w, N/m
    bool by_obstacle = false;
    bool touched = false;  // in this substep
    bool holds = false;    // friction stays below its limit
    bool was_beyond = false;
    bool gave_way = false;  // it did not, in the later half

    void start() {
      holds = holds && touched;
      touched = gave_way = was_beyond = by_obstacle = false;
      depth = grip = carried_force = 0;
      normal = slip = Vector::Zero();
    }
    void find_layers(const Vector& x, const Vector& aim) {
      constexpr Real rounding = 8 * std::numeric_limits<Real>::epsilon();  // of a coordinate and a difference
      layers = aim - x - pushed;
      const Real pressed = pushed.norm();
      if (pressed > 0 && !(layers.norm() > rounding * (aim.norm() + pressed))) layers = Vector::Zero();
    }
    void push(const Vector& x, Real weight, Real kappa, bool is_first, bool among_layers) {
      earlier = carried_force, last_grip = grip, grip = 0;
      at = x, inertia = weight, stiffness = kappa, slides_along = Vector::Zero(), limit = 0;
      const Real pressed = pushed.norm(), length = layers.norm();
      if (pressed > 0) {
        normal = pushed / pressed, surface = normal.dot(x) + pressed, with = carried / pressed;
        depth = pressed, by_obstacle = true;
      } else if (length > 0 && !among_layers) {
        normal = layers / length, depth = length, layers = Vector::Zero(), by_obstacle = false;
      } else {
        depth = by_obstacle && depth > 0 ? std::max(Real(0), surface - normal.dot(x)) : Real(0);
      }
      carried_force = (kappa + weight) * depth;
      touched = touched || depth > 0 || length > 0;
      holds = holds && (depth > 0 || is_first);
    }
    Vector across(const Vector& v) const { return v - normal.dot(v) * normal; }
  };

  Real per_weight_ = 0, per_mass_ = 0;
  Points<Real> before_;
  std::vector<One> contacts_;
  bool decided_ = true;
};

}  // namespace bendlab
