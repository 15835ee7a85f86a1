// Obstacles that consist of all points within a radius of a convex core. The core of a ball is a point, the
// core of a capsule is a segment, and the core of a round table top is a flat disc. The distance to the core
// is convex along every line, so few steps are enough for the searches below:
//
// * A vertex within radius + thickness of the core is pushed straight away from the core.
// * A fast vertex moves farther than the radius in a substep, so it could be pushed out on the wrong side. It
//   is moved outside the tangent plane at the point where its path enters the obstacle.
// * An edge may cut through the obstacle although its ends are outside. Kelley's cutting planes find the
//   point of the edge that is nearest to the core. If all vertices are at least R = radius + thickness from
//   the core, an edge of length l is at least √(R² - l²/4) from the core, and a triangle with sides of at
//   most l is at least √(R² - l²/3) from the core. If l² <= 3 t (2 radius + t) for the thickness t, these
//   distances are at least the radius, and edges and triangles are not tested.
// * A ball, or an end of a capsule, may come through a triangle between the triangle's edges. So the tips of
//   the core are tested against triangles.
//
// Limit: edges and triangles are tested only at the end of a substep. If an edge or triangle moves by more
// than radius + thickness in a substep, the core may pass between vertices: choose h < (radius + thickness) /
// speed.
#pragma once

#include <algorithm>
#include <optional>

#include "bendlab/effects/obstacle.hpp"

namespace bendlab::obstacle {

/// An edge or a triangle is pushed only if its depth is more than this fraction of the thickness.
inline constexpr double tolerance = 1e-3;

// Core<Real> has nearest(x), the point of the core that is nearest to x; away(), a unit vector that points
// out of the core at all its points; tips, the extremal points if their number is finite; and
// moved<To>(shift).

template <class Real, template <class> class Core>
class RoundObstacle {
 public:
  using Vector = Vector3Of<Real>;

  RoundObstacle(const Body& body, const EffectInput& input, Core<double> core, double radius,
                SteadyMotion motion)
      : core_(std::move(core)),
        motion_(std::move(motion)),
        radius_(static_cast<Real>(radius)),
        reach_(static_cast<Real>(radius + body.thickness)),
        slack_(static_cast<Real>(tolerance * body.thickness)),
        contacts_used_(input.contacts_used) {
    const double longest = longest_edge(input.rest), t = body.thickness;
    if (longest * longest <= 3 * t * (2 * radius + t)) return;
    near_ = static_cast<Real>(t + longest / std::sqrt(3.0));
    clearance_.resize(static_cast<std::size_t>(input.rest.vertex_count()));
    for (const auto& e : input.rest.edges().rowwise())
      edges_.push_back({input.permuted(e(0)), input.permuted(e(1))});
    if (core_.tips.empty()) return;
    for (const auto& t3 : input.rest.triangles().rowwise())
      triangles_.push_back({input.permuted(t3(0)), input.permuted(t3(1)), input.permuted(t3(2))});
  }

  void operator()(PassContext<Real>& context) {
    const Step<Real> step(motion_, context);
    const auto core = core_.template moved<Real>(step.shift());
    if (!edges_.empty()) {
      if (!any_near(context.state, step, core)) return;
      for (const auto& edge : edges_)
        if (all_near(edge)) push_edge(context, step, core, edge);
      for (const auto& triangle : triangles_)
        if (all_near(triangle))
          for (const Vector& tip : core.tips) push_triangle(context, step, tip, triangle);
    }
    for (std::size_t v = 0; v < static_cast<std::size_t>(context.state.vertex_count); ++v)
      push_vertex(context, step, core, v);
  }

 private:
  // Computes the distance from each vertex to the surface, for the tests of edges and triangles. Returns
  // whether any vertex is near or fast.
  bool any_near(const State<Real>& state, const Step<Real>& step, const Core<Real>& core) {
    bool any = false;
    for (std::size_t v = 0; v < clearance_.size(); ++v) {
      const Vector p = state.position[v].vector();
      clearance_[v] = (p - core.nearest(p)).norm() - radius_;
      const Real way = (p - state.previous[v].vector() - step.advance()).squaredNorm();
      any |= clearance_[v] < near_ || clearance_[v] * clearance_[v] < way;
    }
    return any;
  }

  template <std::size_t corners>
  bool all_near(const std::array<std::size_t, corners>& vertices) const {
    return std::ranges::all_of(vertices, [&](std::size_t v) { return clearance_[v] < 2 * near_; }) &&
           std::ranges::any_of(vertices, [&](std::size_t v) { return clearance_[v] < near_; });
  }

  void push_vertex(PassContext<Real>& context, const Step<Real>& step, const Core<Real>& core,
                   std::size_t v) const {
    const Point<Real>& point = context.state.position[v];
    if (!(point.w > 0)) return;
    const Vector p = point.vector(), from = context.state.previous[v].vector() + step.advance();
    const Real way = (p - from).squaredNorm();
    Vector offset = p - core.nearest(p);
    // The path can enter only if |offset| < √way + reach. The test uses (a + b)² <= 2 (a² + b²).
    if (way > radius_ * radius_ && offset.squaredNorm() < 2 * (way + reach_ * reach_)) {
      push_fast(context, step, core, v, from);
      const Vector at = point.vector();
      offset = at - core.nearest(at);
    }
    const Real squared = offset.squaredNorm();
    if (!(squared < reach_ * reach_)) return;
    const Real distance = std::sqrt(squared);
    push(context, step, v, distance > 0 ? Vector(offset / distance) : core.away(), reach_ - distance,
         contacts_used_);
  }

  // Finds the point where a path from outside enters, by Newton's method for the distance to the core. The
  // distance is convex along the path and never below its tangents, so no step passes the surface. If the
  // distance grows at a step, the path does not enter the obstacle.
  void push_fast(PassContext<Real>& context, const Step<Real>& step, const Core<Real>& core, std::size_t v,
                 const Vector& from) const {
    constexpr int most_steps = 32;  // quadratic; on a path that only touches, a step quarters the height
    const Vector to = context.state.position[v].vector(), way = to - from;
    Real s = 0;
    for (int i = 0; i < most_steps && s <= 1; ++i) {
      const Vector at = from + s * way, offset = at - core.nearest(at);
      const Real distance = offset.norm(), height = distance - reach_, slope = offset.dot(way) / distance;
      if (distance <= radius_ || slope >= 0) return;  // the path starts inside or goes away
      if (height <= slack_) {
        const Vector normal = offset / distance;
        if (const Real depth = -height - (to - at).dot(normal); depth > 0)
          push(context, step, v, normal, depth, contacts_used_);
        return;
      }
      s -= height / slope;
    }
  }

  void push_edge(PassContext<Real>& context, const Step<Real>& step, const Core<Real>& core,
                 const std::array<std::size_t, 2>& edge) const {
    const Vector a = context.state.position[edge[0]].vector(),
                 along = context.state.position[edge[1]].vector() - a;
    struct Tangent {
      Real s, height, slope;
    };
    Vector normal;
    const auto tangent_at = [&](Real s) -> Tangent {
      const Vector x = a + s * along, offset = x - core.nearest(x);
      const Real distance = offset.norm();
      normal = distance > 0 ? Vector(offset / distance) : Vector(Vector::Zero());
      return {s, distance, normal.dot(along)};
    };
    Tangent low = tangent_at(0), high = tangent_at(1);
    if (low.slope >= 0 || high.slope <= 0) return;  // the lowest point is an end
    constexpr int most_cuts = 12;
    for (int i = 0; i < most_cuts; ++i) {
      const Real s =
          (high.height - low.height + low.slope * low.s - high.slope * high.s) / (low.slope - high.slope);
      const Real bound = low.height + low.slope * (s - low.s);
      if (bound >= reach_ - slack_) return;
      if (!(s > low.s && s < high.s)) break;
      const Tangent middle = tangent_at(s);
      if (middle.height - bound < slack_ || i + 1 == most_cuts) {
        if (middle.height < reach_ && middle.height > 0)
          push_together<Real, 2>(context, step, edge, {1 - s, s}, normal, reach_ - middle.height,
                                 contacts_used_);
        return;
      }
      (middle.slope < 0 ? low : high) = middle;
    }
  }

  // Pushes the triangle to the side of the tip on which the triangle was before.
  void push_triangle(PassContext<Real>& context, const Step<Real>& step, const Vector& tip,
                     const std::array<std::size_t, 3>& triangle) const {
    const auto corners_in = [&](const Points<Real>& points) {
      return std::array{points[triangle[0]].vector(), points[triangle[1]].vector(),
                        points[triangle[2]].vector()};
    };
    const auto [a, b, c] = corners_in(context.state.position);
    const Vector u = b - a, v = c - a, cross = u.cross(v), to_tip = tip - a;
    const Real squared = cross.squaredNorm();
    if (!(squared > 0)) return;
    const Real of_b = to_tip.cross(v).dot(cross) / squared, of_c = u.cross(to_tip).dot(cross) / squared;
    const Real of_a = 1 - of_b - of_c;
    if (!(of_a > 0 && of_b > 0 && of_c > 0)) return;
    const auto [a0, b0, c0] = corners_in(context.state.previous);
    const Vector before = of_a * a0 + of_b * b0 + of_c * c0 + step.advance() - tip;
    Vector normal = cross / std::sqrt(squared);
    if (before.dot(normal) < 0) normal = -normal;
    if (const Real depth = reach_ + normal.dot(to_tip); depth > 0)
      push_together<Real, 3>(context, step, triangle, {of_a, of_b, of_c}, normal, depth, contacts_used_);
  }

  Core<double> core_;  // in the world, at time 0
  SteadyMotion motion_;
  Real radius_, reach_, slack_, near_ = 0;
  bool contacts_used_;
  std::vector<Real> clearance_;  // #V, m; empty if only vertices are tested
  std::vector<std::array<std::size_t, 2>> edges_;
  std::vector<std::array<std::size_t, 3>> triangles_;
};

}  // namespace bendlab::obstacle
