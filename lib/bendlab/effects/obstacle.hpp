// Code for all obstacles: their common settings, their motion, and how an obstacle pushes vertices out.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bendlab/effects/effects.hpp"

namespace bendlab::obstacle {

/// The fields of Body's settings; spin_fields has the settings that SpinningBody adds.
template <class Obstacle>
inline constexpr std::array body_fields = {
    field<&Obstacle::thickness, Obstacle>({.name = "thickness",
                                           .unit = "m",
                                           .meaning = "distance that the cloth keeps from the surface",
                                           .minimum = 0,
                                           .above = true}),
    field<&Obstacle::velocity, Obstacle>(
        {.name = "velocity",
         .unit = "m/s",
         .meaning = "velocity of the obstacle; the other settings state the obstacle's position at time 0"}),
};
template <class Obstacle>
inline constexpr std::array spin_fields = {
    field<&Obstacle::spin, Obstacle>({.name = "spin",
                                      .unit = "rad/s",
                                      .meaning = "angular velocity about the axis, counter-clockwise seen "
                                                 "from the tip of the axis; moves the cloth by friction"}),
};

/// A setting as a unit vector. Throws std::invalid_argument for the zero vector.
inline Vector3 direction_of(const Vector3& setting, const std::string& name) {
  if (!(setting.norm() > 0))
    throw std::invalid_argument(name + " is the zero vector, which has no direction; choose another vector");
  return setting.normalized();
}

/// The longest edge for which obstacles are tested, m. Obstacles may miss the middle of a longer edge.
inline double longest_edge(const RestMesh& rest) {
  constexpr double largest_stretch = 1.5;
  double longest = 0;
  for (const auto& e : rest.edges().rowwise())
    longest = std::max(longest, (rest.position(e(0)) - rest.position(e(1))).norm());
  return largest_stretch * longest;
}

/// An obstacle's motion over one substep, in the state's coordinates.
template <class Real>
class Step {
 public:
  using Vector = Vector3Of<Real>;

  Step(const SteadyMotion& motion, const PassContext<Real>& context) {
    const double h = static_cast<double>(context.substep), turn = h * motion.spin;
    shift_ = (context.time + h) * motion.velocity - context.state.origin;
    advance_ = (h * motion.velocity).template cast<Real>();
    pivot_ = (motion.pivot + shift_ - h * motion.velocity).template cast<Real>();
    axis_ = motion.axis.template cast<Real>();
    sine_ = static_cast<Real>(std::sin(turn)), versine_ = static_cast<Real>(1 - std::cos(turn));
  }

  /// Translation of the obstacle, without spin, from its position in the world at time 0 to its position at
  /// the end of the substep in the state's coordinates.
  const Vector3& shift() const { return shift_; }
  /// How far the velocity moves the obstacle in the substep.
  const Vector& advance() const { return advance_; }

  /// How far the obstacle carries a point from `start` in the substep: by the rotation R(ωh) about the pivot
  /// and by the velocity.
  Vector carried(const Vector& start) const {
    const Vector turned = axis_.cross(Vector(start - pivot_));
    return advance_ + sine_ * turned + versine_ * axis_.cross(turned);
  }

 private:
  Vector3 shift_;
  Vector advance_, pivot_, axis_;  // the pivot at the start of the substep
  Real sine_, versine_;
};

/// Moves a vertex by `depth` along the unit `normal`, and records the contact if `contacts_used`.
template <class Real>
void push(PassContext<Real>& context, const Step<Real>& step, std::size_t vertex,
          const Vector3Of<Real>& normal, Real depth, bool contacts_used) {
  Point<Real>& p = context.state.position[vertex];
  p.set(p.vector() + depth * normal);
  ++context.acted;
  if (contacts_used)
    context.state.contacts.push_back(
        {vertex, normal, depth, step.carried(context.state.previous[vertex].vector())});
}

/// Moves the point Σ weight·vertex of the cloth by `depth` along `normal`. Each free vertex moves in
/// proportion to weight and inverse mass, as by a force at the point. Near a pinned corner the free corners
/// have almost no weight, so least_lever and largest_move bound the moves.
template <class Real, std::size_t corners>
void push_together(PassContext<Real>& context, const Step<Real>& step,
                   const std::array<std::size_t, corners>& vertices, const std::array<Real, corners>& weights,
                   const Vector3Of<Real>& normal, Real depth, bool contacts_used) {
  const Points<Real>& points = context.state.position;
  Real yielding = 0, whole = 0, largest_w = 0, largest_part = 0, size = 0;
  for (std::size_t i = 0; i < corners; ++i) {
    const Real w = points[vertices[i]].w;
    yielding += weights[i] * weights[i] * w, whole += weights[i] * weights[i];
    largest_w = std::max(largest_w, w), largest_part = std::max(largest_part, std::abs(weights[i]) * w);
    for (std::size_t j = 0; j < i; ++j)
      size = std::max(size, (points[vertices[i]].vector() - points[vertices[j]].vector()).norm());
  }
  if (!(yielding > least_lever<Real> * largest_w * whole)) return;
  const Real farthest = largest_part / yielding * depth, most = largest_move * std::max(size, depth);
  const Real done = farthest > most ? depth * most / farthest : depth;
  for (std::size_t i = 0; i < corners; ++i)
    if (const Real part = weights[i] * points[vertices[i]].w / yielding; part > 0)
      push(context, step, vertices[i], normal, part * done, contacts_used);
}

}  // namespace bendlab::obstacle
