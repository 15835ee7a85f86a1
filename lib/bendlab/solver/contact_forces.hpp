// The forces of obstacles, of other layers of the cloth, and of friction in an implicit step.
//
// The contact passes move each vertex from x to an allowed position, P(x). Obstacles push the vertex by the
// depth d along their normal n, and other layers push it by l: P(x) - x = d n + l. Pushes act as stiff
// springs,
//
//   f = κ (d n + l),   with stiffness κ n nᵀ + κ l lᵀ / l²,   κ = a w + b m
//
// with the weight w of inertia (implicit_step.hpp), the mass m, and constants a and b. So vertices that carry
// only their own weight sink in by the same depth, and the cloth is not strained. Layers push each other with
// equal and opposite forces, because the passes of layers keep momentum. A push that does not keep momentum
// and is not in State::contacts counts as the push of an obstacle without friction.
// Friction acts against the slip s of a vertex: the move of the vertex relative to the obstacle in this
// substep, in the plane perpendicular to n,
//
//   f_t = -k s,   k = κ where friction holds the vertex,   k = min(κ, μ N / |s|) where the vertex slides
//
// This is Coulomb's law: the friction on a sliding vertex is at its limit, μ N. The friction that holds a
// vertex is a stiff spring, and the small slip of this vertex is removed at the end of the substep. The
// matrix of an iteration has the k of the present s. So an iteration of a Newton method lowers the minimised
// function, because the parabola with this k lies above the function (Hunter and Lange 2004, §3). Friction
// holds a vertex if a force of at most μ N is enough. N is (κ + w) d, because the depth d is removed at the
// end of the substep. If the last iteration had a smaller N, the smaller N is used, because N is far too
// large where a vertex has just sunk in. μ is μ_s for held vertices, μ_k for sliding vertices.
//
// Two rules make iterations converge. First, the plane of an obstacle's last push continues to push a vertex
// until the vertex has left the plane. (On a curved obstacle, a move perpendicular to n leaves the surface,
// but not the plane.) Second, if a vertex starts to slide in the later half of the iterations, friction holds
// the vertex again only if the force of the spring alone is within the limit. Otherwise the vertex could be
// held and slide in turns, because the estimate of the holding force ignores the neighbours of the vertex.
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
  /// `per_weight`: a (1). `per_mass`: b (N/m per kg).
  ContactForces(double per_weight, double per_mass)
      : per_weight_(static_cast<Real>(per_weight)), per_mass_(static_cast<Real>(per_mass)) {}

  /// `slots`: the number of points in State::position.
  void resize(std::size_t slots) { before_.resize(slots), contacts_.resize(slots); }
  bool in_use() const { return !contacts_.empty(); }

  /// Call this before the contact passes change positions.
  void remember(State<Real>& state) {
    before_ = state.position;
    state.contacts.clear();
  }

  /// Call this after the contact passes: restores the positions, and turns the changes of positions into
  /// forces. `weights`: w, #V. State::contacts lists the pushes of obstacles.
  void push(State<Real>& state, const std::vector<Real>& weights, bool is_first_iteration) {
    std::swap(state.position, before_);  // until the end of push(), before_ is P(x)
    for (VertexContact& vertex : contacts_) vertex.pushed = vertex.carried = Vector::Zero();
    for (const Contact<Real>& contact : state.contacts) {
      VertexContact& vertex = contacts_[contact.vertex];
      vertex.pushed += contact.depth * contact.normal, vertex.carried += contact.depth * contact.carried;
    }
    state.contacts.clear();
    Vector momentum = Vector::Zero();  // Σ m l, the momentum of layers times the substep
    Real moved = 0;
    for (std::size_t v = 0; v < weights.size(); ++v) {
      VertexContact& vertex = contacts_[v];
      if (is_first_iteration) vertex.start();
      if (!(weights[v] > 0)) continue;
      vertex.find_layers(state.position[v].vector(), before_[v].vector());
      const auto mass = static_cast<Real>(state.mass[v]);
      momentum += mass * vertex.layers, moved += mass * vertex.layers.norm();
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

  /// Finds the friction of vertices that obstacles push. Returns the number of vertices with friction.
  std::uint64_t grip(const State<Real>& state, const FrictionCoefficients& friction, bool decides_late) {
    if (!in_use()) return 0;
    std::uint64_t gripped = 0;
    decided_ = true;
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v) {
      VertexContact& vertex = contacts_[v];
      if (!(vertex.depth > 0) || !vertex.by_obstacle) continue;
      const Vector last_slip = vertex.slip;
      vertex.slip = vertex.across(state.position[v].vector() - state.previous[v].vector() - vertex.with);
      const Real length = vertex.slip.norm();
      const bool held_before = vertex.holds;
      // Until N is known, friction holds the vertices that it held in the last substep.
      if (const Real carries = std::min(vertex.carried_force, vertex.earlier); carries > 0) {
        const Real most = static_cast<Real>(friction.at_rest) * carries,
                   sliding = static_cast<Real>(friction.sliding) * carries;
        vertex.limit = sliding;
        // The force that holds a vertex is estimated: the friction of the last iteration plus inertia,
        // without the neighbours. So a vertex that has started to slide is held again only if the force of
        // the spring alone is within the limit. A held vertex starts to slide only if its force was beyond
        // the limit in the last iteration, too. Otherwise held and sliding vertices may swap for ever,
        // because a held vertex takes load off its sliding neighbours.
        const bool within =
            ((vertex.gave_way ? vertex.stiffness : vertex.last_grip) + vertex.inertia) * length <= most;
        vertex.holds = within || (held_before && !vertex.was_beyond);
        vertex.was_beyond = held_before && !within;
        vertex.gave_way |= decides_late && held_before && !vertex.holds;
        vertex.grip =
            vertex.holds || !(length > 0) ? vertex.stiffness : std::min(vertex.stiffness, sliding / length);
        // If the vertex slides ever farther, the matrix has no stiffness along the slip.
        if (!decides_late && !vertex.holds && vertex.grip < vertex.stiffness &&
            vertex.slip.dot(last_slip) > last_slip.squaredNorm())
          vertex.slides_along = vertex.slip / length;
      } else {
        vertex.grip = vertex.holds ? vertex.stiffness : Real(0);
      }
      gripped += vertex.grip > 0 ? 1 : 0;
      decided_ = decided_ && vertex.holds == held_before && !vertex.was_beyond;
    }
    return gripped;
  }

  /// Removes the slip of the vertices that friction holds. Call this at the end of a substep.
  void hold(State<Real>& state) const {
    for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
      if (const VertexContact& vertex = contacts_[v]; vertex.holds && vertex.depth > 0) {
        Point<Real>& p = state.position[v];
        p.set(p.vector() - vertex.across(vertex.slip + p.vector() - vertex.at));
      }
  }

  /// Whether the last iteration held the same vertices as the iteration before it.
  bool decided() const { return decided_; }
  bool touched(std::size_t v) const { return contacts_[v].touched; }  ///< in this substep
  /// The velocity of a vertex that was pushed in this substep. `own` is the velocity of this substep alone.
  /// Where friction holds, returns `own`; elsewhere `own` along the push of an obstacle and `kept` across.
  Vector velocity(std::size_t v, const Vector& own, const Vector& kept) const {
    const VertexContact& vertex = contacts_[v];
    if (vertex.holds) return own;
    return kept + vertex.normal.dot(own - kept) * vertex.normal;
  }
  bool pushes(std::size_t v) const {  ///< in this iteration
    return contacts_[v].depth > 0 || contacts_[v].layers.squaredNorm() > 0;
  }
  /// f + f_t at the position where the iteration began, N.
  Vector force(std::size_t v) const {
    const VertexContact& vertex = contacts_[v];
    return obstacle_force(v) + vertex.stiffness * vertex.layers;
  }
  Vector obstacle_force(std::size_t v) const {
    const VertexContact& vertex = contacts_[v];
    return vertex.stiffness * vertex.depth * vertex.normal - vertex.grip * vertex.slip;
  }
  /// f + f_t at another position of the vertex, to first order, N.
  Vector force_at(std::size_t v, const Vector& position) const {
    return force(v) - stiffness(v) * (position - contacts_[v].at);
  }
  Vector obstacle_force_at(std::size_t v, const Vector& position) const {
    return obstacle_force(v) - obstacle_stiffness(v) * (position - contacts_[v].at);
  }
  /// N/m.
  Matrix stiffness(std::size_t v) const {
    const VertexContact& vertex = contacts_[v];
    Matrix whole = obstacle_stiffness(v);
    if (const Real l = vertex.layers.squaredNorm(); l > 0)
      whole += vertex.stiffness / l * vertex.layers * vertex.layers.transpose();
    return whole;
  }
  /// κ n nᵀ + k (1 - n nᵀ), N/m.
  Matrix obstacle_stiffness(std::size_t v) const {
    const VertexContact& vertex = contacts_[v];
    if (!(vertex.depth > 0)) return Matrix::Zero();
    return vertex.grip * (Matrix::Identity() - vertex.slides_along * vertex.slides_along.transpose()) +
           (vertex.stiffness - vertex.grip) * vertex.normal * vertex.normal.transpose();
  }
  /// `force` is the sum of the other forces on a vertex. Returns the part of this sum that contacts do not
  /// balance if the vertex is at `position`. Pushes balance the part along them, friction a part across.
  Vector along(std::size_t v, const Vector& force, const Vector& position) const {
    const VertexContact& vertex = contacts_[v];
    Vector left = force;
    if (vertex.depth > 0) {
      const Vector slip = vertex.slip + vertex.across(position - vertex.at);
      const Real length = slip.norm(), grip = vertex.holds || !(length > 0)
                                                  ? vertex.grip
                                                  : std::min(vertex.grip, vertex.limit / length);
      left = vertex.across(force - grip * slip);
    }
    if (const Real l = vertex.layers.squaredNorm(); l > 0)
      left -= vertex.layers.dot(left) / l * vertex.layers;
    return left;
  }
  /// Positions before the contact passes ran for the last time.
  const Points<Real>& before() const { return before_; }

  std::size_t memory_bytes() const {
    return bytes_of(before_) + contacts_.capacity() * sizeof(VertexContact);
  }
  /// Writes or reads the data that the next substep needs.
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
  struct VertexContact {
    Vector normal = Vector::Zero(), at = Vector::Zero();       // at: x where the iteration began, m
    Vector layers = Vector::Zero(), slip = Vector::Zero();     // l and s, m
    Vector pushed = Vector::Zero(), carried = Vector::Zero();  // Σ depth · normal, m; Σ depth · carried, m²
    Vector slides_along = Vector::Zero();         // unit; zero: the slip does not grow with every iteration
    Vector with = Vector::Zero();                 // how far the obstacle went in the substep, m
    Real depth = 0, surface = 0;                  // d; n · P(x) of the last push, m
    Real stiffness = 0, grip = 0, last_grip = 0;  // κ, k, and k of the last iteration, N/m
    Real carried_force = 0, earlier = 0;          // the force N of this and of the last iteration
    Real limit = 0;                               // μ_k N, in newtons
    Real inertia = 0;                             // w, N/m
    bool by_obstacle = false;
    bool touched = false;     // in this substep
    bool holds = false;       // friction stays below its limit
    bool was_beyond = false;  // held in the last iteration, but beyond the limit
    bool gave_way = false;    // friction gave way in the later half of the iterations

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
  std::vector<VertexContact> contacts_;
  bool decided_ = true;
};

}  // namespace bendlab
