#include "bendlab/effects/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

// Added to the margin, because boxes are rounded to float. Relative to the largest coordinate of a box.
constexpr double box_rounding = 4e-7;
// A box has three coordinates in four lanes. In the fourth lane every box reaches from
// -endless to endless, so all boxes overlap there.
constexpr float endless = 1e30F;
// A pair touches at rest (a seam that is not welded) if its distance is smaller. Relative to the thickness.
constexpr double touching = 1e-6;

Positions centres_of(const RestMesh& rest) {
  Positions centres(rest.triangle_count(), 3);
  for (Eigen::Index t = 0; t < centres.rows(); ++t)
    centres.row(t) =
        (rest.positions().row(rest.triangles()(t, 0)) + rest.positions().row(rest.triangles()(t, 1)) +
         rest.positions().row(rest.triangles()(t, 2))) /
        3;
  return centres;
}

// Assigns each edge to the first triangle that contains the edge.
template <class Triangles>
void give_edges(Triangles& triangles) {
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  const auto vertex = [&](int t, int corner) { return triangles[at(t)].vertices[at(corner)]; };
  for_each_edge(half_edges(static_cast<int>(triangles.size()), vertex),
                [&](std::span<const HalfEdge<int>> sides) {
                  for (const HalfEdge<int>& side : sides)
                    triangles[at(side.triangle())].owns_edge[at(side.corner())] = &side == &sides[0];
                });
}

// For each axis, the smallest and the largest component of the vectors of all vertices. The result does not
// depend on the order of the vertices.
template <class Real>
struct Range {
  Vector3 low, high;

  template <class Vector>
  Range(std::size_t count, const Vector& vector) {
    Vector3Of<Real> least = vector(0), most = least;
    for (std::size_t v = 1; v < count; ++v) {
      const Vector3Of<Real> x = vector(v);
      least = least.cwiseMin(x), most = most.cwiseMax(x);
    }
    low = least.template cast<double>(), high = most.template cast<double>();
  }
  Vector3 middle() const { return 0.5 * (low + high); }
};

}  // namespace

template <class Real>
NearPairs<Real>::NearPairs(const EffectInput& input, double thickness)
    : thickness_(thickness),
      thick_(thickness > 0.75 * input.rest.mean_edge_length()),
      tree_(centres_of(input.rest)) {
  const auto count = static_cast<std::size_t>(input.rest.vertex_count());
  rest_.resize(count);
  for (int v = 0; v < input.rest.vertex_count(); ++v) rest_[input.permuted(v)] = input.rest.position(v);

  std::vector<char> owned(count, 0);
  for (Eigen::Index t = 0; t < input.rest.triangles().rows(); ++t) {
    Triangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const int v = input.rest.triangles()(t, static_cast<Eigen::Index>(i));
      triangle.vertices[i] = static_cast<int>(input.permuted(v));
      triangle.owns_vertex[i] = !std::exchange(owned[static_cast<std::size_t>(v)], 1);
    }
    triangles_.push_back(triangle);
  }
  give_edges(triangles_);
}

// The pairs of an earlier search are still valid if every vertex is within its margin at the start and at the
// end of the substep, because then the straight path of the vertex is within the margin, too.
template <class Real>
void NearPairs<Real>::begin(const State<Real>& state, double margin) {
  if (part_of_target_ < 1 || !cover(state.previous) || !cover(state.position)) {
    find(state, 1, margin);
    return;
  }
  for (NearPair& pair : pairs_) measure_start(state, pair);
}

template <class Real>
bool NearPairs<Real>::cover(const Points<Real>& points) const {
  if (found_at_.empty()) return false;
  const Range<Real> moved(rest_.size(), [&](std::size_t v) -> Vector3Of<Real> {
    return points[v].vector() - found_at_[v].vector();
  });
  return 0.5 * (moved.high - moved.low).norm() <= margin_;  // also false for NaN
}

template <class Real>
void NearPairs<Real>::find(const State<Real>& state, double part_of_target, double margin) {
  part_of_target_ = part_of_target, margin_ = margin;
  found_at_ = state.position;
  pairs_.clear();
  set_boxes(state);
  tree_.for_overlaps(
      [&](int a, int b) { look_at(state, static_cast<std::size_t>(a), static_cast<std::size_t>(b)); });
}

// If an axis separates two elements at the start and at the end of the substep, and the elements have the
// same order along the axis, the axis separates the elements during the whole substep.
template <class Real>
bool NearPairs<Real>::Way::meets(const Way& other, float depth) const {
  const auto above = [](const Box& a, const Box& b) { return a.low - b.high; };
  const Box::Corner on_this_side = above(start, other.start).min(above(end, other.end));
  const Box::Corner on_that_side = above(other.start, start).min(above(other.end, end));
  return on_this_side.max(on_that_side).maxCoeff() <= -depth;
}

template <class Real>
void NearPairs<Real>::set_boxes(const State<Real>& state) {
  const Range<Real> moved(rest_.size(), [&](std::size_t v) -> Vector3Of<Real> {
    return state.position[v].vector() - state.previous[v].vector();
  });
  const Range<Real> positions(rest_.size(),
                              [&](std::size_t v) -> Vector3Of<Real> { return state.position[v].vector(); });
  const double largest = std::max(positions.low.cwiseAbs().maxCoeff(), positions.high.cwiseAbs().maxCoeff()) +
                         std::max(moved.low.cwiseAbs().maxCoeff(), moved.high.cwiseAbs().maxCoeff());
  const double near = 0.5 * part_of_target_ * thickness_ + margin_;
  const double reach = near + box_rounding * (largest + near);
  const auto box_about = [&](const Point<Real>& p) {
    const auto lower = [&](Real x) { return static_cast<float>(static_cast<double>(x) - reach); };
    const auto upper = [&](Real x) { return static_cast<float>(static_cast<double>(x) + reach); };
    return Box{{lower(p.x), lower(p.y), lower(p.z), -endless}, {upper(p.x), upper(p.y), upper(p.z), endless}};
  };
  vertex_ways_.resize(rest_.size());
  for (std::size_t v = 0; v < rest_.size(); ++v)
    vertex_ways_[v] = {box_about(state.previous[v]), box_about(state.position[v])};
  const Eigen::Vector3f middle = Vector3(moved.middle()).cast<float>();
  const Box::Corner shared(middle.x(), middle.y(), middle.z(), 0);
  triangle_ways_.resize(triangles_.size()), boxes_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    Way& way = triangle_ways_[t] = {};
    for (const int v : triangles_[t].vertices) way.include(vertex_ways_[static_cast<std::size_t>(v)]);
    boxes_[t] = way.end;
    boxes_[t].low -= shared, boxes_[t].high -= shared;
    boxes_[t].include(way.start);
  }
  tree_.renew(boxes_);
}

template <class Real>
typename NearPairs<Real>::Way NearPairs<Real>::edge_way(const Triangle& t, std::size_t edge) const {
  Way way = vertex_ways_[static_cast<std::size_t>(t.vertices[edge])];
  way.include(vertex_ways_[static_cast<std::size_t>(t.vertices[(edge + 1) % 3])]);
  return way;
}

// The boxes are enlarged for pairs whose target is the thickness. For a pair that is near at rest the target
// is smaller, so its boxes are too large by thickness - target.
template <class Real>
bool NearPairs<Real>::may_come_near(Pairing pairing, const std::array<int, 4>& vertices, const Way& first,
                                    const Way& second) const {
  if (!first.meets(second)) return false;
  if (!thick_) return true;  // few pairs are near at rest, so the test below rarely applies
  const auto apart = [&](std::size_t i, std::size_t j) {
    return (rest_[static_cast<std::size_t>(vertices[i])] - rest_[static_cast<std::size_t>(vertices[j])])
        .squaredNorm();
  };
  const double nearest_corners = pairing == Pairing::vertex_triangle
                                     ? std::min({apart(0, 1), apart(0, 2), apart(0, 3)})
                                     : std::min({apart(0, 2), apart(0, 3), apart(1, 2), apart(1, 3)});
  const double largest_target = std::min(thickness_, 0.5 * std::sqrt(nearest_corners));
  return first.meets(second, static_cast<float>(part_of_target_ * (thickness_ - largest_target)));
}

template <class Real>
void NearPairs<Real>::look_at(const State<Real>& state, std::size_t first, std::size_t second) {
  if (!triangle_ways_[first].meets(triangle_ways_[second])) return;
  const auto look = [&](Pairing pairing, const std::array<int, 4>& vertices, const Way& way,
                        const Way& other_way) {
    if (may_come_near(pairing, vertices, way, other_way)) add(state, pairing, vertices);
  };
  const auto has = [](const Triangle& t, int v) {
    return t.vertices[0] == v || t.vertices[1] == v || t.vertices[2] == v;
  };
  for (const auto& [own, other] : {std::pair(first, second), std::pair(second, first)}) {
    const Triangle &t = triangles_[own], &facing = triangles_[other];
    for (std::size_t i = 0; i < 3; ++i) {
      const int v = t.vertices[i];
      if (t.owns_vertex[i] && !has(facing, v))
        look(Pairing::vertex_triangle, {v, facing.vertices[0], facing.vertices[1], facing.vertices[2]},
             vertex_ways_[static_cast<std::size_t>(v)], triangle_ways_[other]);
    }
  }
  const Triangle &a = triangles_[first], &b = triangles_[second];
  for (std::size_t i = 0; i < 3; ++i) {
    if (!a.owns_edge[i]) continue;
    const int a0 = a.vertices[i], a1 = a.vertices[(i + 1) % 3];
    const Way way = edge_way(a, i);
    if (!way.meets(triangle_ways_[second])) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      const int b0 = b.vertices[j], b1 = b.vertices[(j + 1) % 3];
      if (b.owns_edge[j] && a0 != b0 && a0 != b1 && a1 != b0 && a1 != b1)
        look(Pairing::edge_edge, {a0, a1, b0, b1}, way, edge_way(b, j));
    }
  }
}

template <class Real>
void NearPairs<Real>::measure_start(const State<Real>& state, NearPair& pair) const {
  const Vector3 gap = shortest_gap(pair.pairing, corners_of(pair, state.previous)).vector;
  pair.start = gap.norm();
  pair.normal = pair.start > 0 ? Vector3(gap / pair.start) : Vector3::Zero();
}

template <class Real>
void NearPairs<Real>::add(const State<Real>& state, Pairing pairing, const std::array<int, 4>& vertices) {
  NearPair pair{vertices, pairing, 0, {}, thickness_};
  measure_start(state, pair);
  // Each of the two elements may move by the margin towards the other element.
  const double end = separation_along(pair.normal, pairing, corners_of(pair, state.position)) - 2 * margin_;
  const double least = std::min(pair.start, end);
  if (least > part_of_target_ * thickness_) return;
  Corners rest;
  for (std::size_t i = 0; i < 4; ++i) rest[i] = rest_[static_cast<std::size_t>(vertices[i])];
  const double at_rest = shortest_gap(pairing, rest).vector.norm();
  pair.target = std::min(thickness_, 0.5 * at_rest);
  if (at_rest > touching * thickness_ && least <= part_of_target_ * pair.target) pairs_.push_back(pair);
}

template class NearPairs<float>;
template class NearPairs<double>;

}  // namespace bendlab
