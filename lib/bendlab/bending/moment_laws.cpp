#include "bendlab/bending/moment_laws.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "bendlab/bending/bend_spans.hpp"
#include "bendlab/bending/triangle_lookup.hpp"
#include "bendlab/bending/unit_bend.hpp"

namespace bendlab {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// |C| over the curvature of the sheet, m: for softening, and for yielding.
struct BendLengths {
  double softening, yield;
};

// For an element whose C is proportional to the angle of a hinge. `per_angle` is C over the angle.
BendLengths lengths_of_hinge(const std::array<int, 4>& vertices, const BendingInput& input,
                             double per_angle) {
  constexpr int directions = 36;
  std::array<Vector3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = input.rest.position(vertices[i]);
  const QuadraticForm form = fold(unfolded(p));
  const double seen = hinge_span(vertices, input.pins).seen;
  double first = 0, second = 0, third = 0;  // means of |θ|, θ² and |θ|³ at κ = 1
  for (int k = 0; k < directions; ++k) {
    const double at = std::numbers::pi * k / directions;
    const double angle = seen * value_in(form, {std::cos(at), std::sin(at)});
    first += std::abs(angle) / directions, second += angle * angle / directions;
    third += std::pow(std::abs(angle), 3) / directions;
  }
  if (!(second > 0)) return {0, 0};
  return {per_angle * third / second, per_angle * second / first};
}

template <class Kind>
BendLengths lengths_of(const ElementList<Kind>& list, std::size_t c, const BendingInput& input) {
  if constexpr (std::is_same_v<Kind, HingeAngle>) {
    return lengths_of_hinge(list.vertices[c], input, HingeAngle::slope_at_rest(list.rest[c], list.law));
  } else if constexpr (std::is_same_v<Kind, QuadraticBend>) {
    return lengths_of_hinge(list.vertices[c], input, QuadraticBend::slope_at_rest(list.rest[c]));
  } else if constexpr (std::is_same_v<Kind, LaplacianBend>) {
    const double area = std::pow(list.rest[c][LaplacianBend::arity + 1], 2);  // |Kx| is the curvature times A
    return {area, area};
  } else if constexpr (std::is_same_v<Kind, FoldBend> || std::is_same_v<Kind, MidEdgeBend>) {
    const double length = list.rest[c][12] / std::numbers::sqrt2;  // √A; C is √A κ
    return {length, length};
  } else {
    return {0, 0};
  }
}

template <class Kind>
void require_yielding(const ElementList<Kind>& list) {
  bool able = Yields<Kind>;
  if constexpr (std::is_same_v<Kind, HingeAngle>) able = list.law == HingeAngle::Law::angle;
  if (!able)
    throw std::invalid_argument(
        "hysteresis and plasticity need elements whose fold has a sign and a rest angle, which this model "
        "does not have: choose mid_edge, mid_edge_average, corotational_face, dihedral, or discrete_shells "
        "with \"measure\": \"theta\"");
}

// Appends a copy of every element, whose stiffness is the friction moment over the curvature of slip.
template <class Kind>
void add_friction(ElementList<Kind>& list, const BendingInput& input, const MomentTarget& target) {
  const Hysteresis& friction = *target.hysteresis;
  const OverElements rigidity(input.rest, target.rigidity_factor), moment(input.rest, target.friction_factor);
  const std::size_t count = list.size();
  for (std::size_t c = 0; c < count; ++c) {
    const BendLengths lengths = lengths_of(list, c, input);
    list.vertices.push_back(list.vertices[c]);
    list.rest.push_back(list.rest[c]);
    list.softness.push_back(list.softness[c] * target.rigidity * rigidity(list, c) * friction.slip /
                            (friction.moment * moment(list, c)));
    list.moment.yield.push_back(lengths.yield > 0 ? lengths.yield * friction.slip : never);
    list.moment.hardening.push_back(0);
    if (!list.moment.length.empty()) list.moment.length.push_back(0);
  }
}

template <class Kind>
void set_moments_of(ElementList<Kind>& list, const BendingInput& input, const MomentTarget& target) {
  if (list.size() == 0) return;
  MomentLaws& moment = list.moment;
  if (target.softening.is_given()) {
    if constexpr (std::is_same_v<Kind, QuadraticBend>)
      if (list.law == QuadraticBend::Law::energy)
        throw std::invalid_argument("softening needs the \"constraint\" norm of isometric");
    moment.softening = target.softening;
    for (std::size_t c = 0; c < list.size(); ++c)
      moment.length.push_back(lengths_of(list, c, input).softening);
  }
  if (!target.hysteresis && !target.plasticity) return;
  require_yielding(list);
  moment.yield.assign(list.size(), never), moment.hardening.assign(list.size(), 0);
  const OverElements yield_factor(input.rest, target.yield_factor);
  if (target.plasticity)
    for (std::size_t c = 0; c < list.size(); ++c) {
      const double length = lengths_of(list, c, input).yield;
      if (length > 0) moment.yield[c] = length * target.plasticity->yield * yield_factor(list, c);
      moment.hardening[c] = target.plasticity->hardening;
    }
  if (target.hysteresis) add_friction(list, input, target);
}

}  // namespace

void set_moments(BendingConstraints& constraints, const BendingInput& input, const MomentTarget& target) {
  if (!target.softening.is_given() && !target.hysteresis && !target.plasticity) return;
  bool pushes = false;
  for_each_kind(constraints.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    pushes = pushes || (OneSided<Kind> && list.size() > 0);
  });
  if (pushes || constraints.distance.size() > 0 || constraints.own.size() > 0)
    throw std::invalid_argument(
        "softening, hysteresis and plasticity are not known for this model, because they need the curvature "
        "of "
        "hinges or of triangles that bend: choose mid_edge, or a model of hinges");
  for_each_kind(constraints.elements, [&](auto& list) { set_moments_of(list, input, target); });
}

}  // namespace bendlab
