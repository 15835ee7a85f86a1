#include "bendlab/constraints/batches.hpp"

#include "bendlab/constraints/kinds.hpp"

#include <algorithm>
#include <limits>

namespace bendlab {
namespace {

// For every lane, the offset of the vertex at corner `corner`. vertex_of(c) returns this vertex for the
// constraint c. Every padded lane has its own dummy point.
template <class VertexOf>
LargeArray<int> offsets_of(const BatchOrder& order, int corner, int vertex_count, VertexOf vertex_of) {
  LargeArray<int> offsets(order.lane_count());
  for_each_lane(order, [&](std::size_t lane, int constraint) {
    offsets[lane] =
        offset_of(constraint >= 0 ? vertex_of(static_cast<std::size_t>(constraint))
                                  : vertex_count + corner * max_lanes + static_cast<int>(lane) % max_lanes);
  });
  return offsets;
}

template <std::size_t arity>
LargeArray<int> corner_offsets(const std::vector<std::array<int, arity>>& vertices, const BatchOrder& order,
                               int corner, int vertex_count) {
  static_assert(arity <= dummy_corners,
                "a constraint has more vertices than a padded lane has dummy points: raise dummy_corners");
  return offsets_of(order, corner, vertex_count,
                    [&](std::size_t c) { return vertices[c][static_cast<std::size_t>(corner)]; });
}

// For every star, the offset of its centre. Every padded lane has its own dummy point.
LargeArray<int> centre_offsets(const PairList& pairs, const BatchOrder& order, int vertex_count) {
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  LargeArray<int> offsets(order.stack_count() * width);
  for (std::size_t star = 0; star < offsets.size(); ++star) {
    const std::size_t stack = star / width, lane = star % width;
    const int first = order.constraint(stack, order.stacks[stack] + lane);
    offsets[star] = offset_of(first >= 0 ? pairs.first(static_cast<std::size_t>(first))
                                         : vertex_count + static_cast<int>(lane));
  }
  return offsets;
}

// Rest values of all lanes; `padding` is the rest value of padded lanes.
template <class Real, class Get>
LargeArray<Real> lane_values(const BatchOrder& order, Real padding, Get get) {
  LargeArray<Real> values(order.lane_count(), padding);
  for_each_lane(order, [&](std::size_t lane, int constraint) {
    if (constraint >= 0) values[lane] = static_cast<Real>(get(static_cast<std::size_t>(constraint)));
  });
  return values;
}

template <class Real, class Kind>
constexpr Real padding_of() {
  if constexpr (requires { Kind::padding; })
    return Real(Kind::padding);
  else
    return 1;
}

// The softness, limited to the range of Real, so that the conversion to Real gives neither 0 nor infinity.
template <class Real>
double nearest_number(double softness) {
  if (!(softness > 0)) return softness;
  return std::clamp(softness, static_cast<double>(std::numeric_limits<Real>::min()),
                    static_cast<double>(std::numeric_limits<Real>::max()));
}

}  // namespace

template <class Real>
DistanceBatch<Real> make_distance_batch(const DistanceConstraints& list, BatchOrder order, int vertex_count) {
  DistanceBatch<Real> batch;
  batch.count = list.size();
  batch.a = centre_offsets(list.vertices, order, vertex_count);
  batch.b = offsets_of(order, 1, vertex_count, [&](std::size_t c) { return list.vertices.second(c); });
  batch.rest_length =
      lane_values<Real>(order, std::numeric_limits<Real>::max(), [&](std::size_t c) { return list.rest(c); });
  if (!list.softness.empty())
    batch.softness = lane_values<Real>(order, Real(1),
                                       [&](std::size_t c) { return nearest_number<Real>(list.softness[c]); });
  batch.order = std::move(order);
  return batch;
}

template <class Real>
StrainBatch<Real> make_strain_batch(const StrainConstraints& list, BatchOrder order, int vertex_count) {
  StrainBatch<Real> batch;
  batch.count = list.size();
  batch.a = corner_offsets(list.vertices, order, 0, vertex_count);
  batch.b = corner_offsets(list.vertices, order, 1, vertex_count);
  batch.c = corner_offsets(list.vertices, order, 2, vertex_count);
  const auto entry = [&](std::size_t e, Real padding) {
    return lane_values<Real>(order, padding, [&](std::size_t c) { return list.inverse_rest[c][e]; });
  };
  if (!list.softness.empty())
    batch.softness = lane_values<Real>(order, Real(1), [&](std::size_t c) { return list.softness[c]; });
  batch.q00 = entry(0, 1), batch.q01 = entry(1, 0), batch.q10 = entry(2, 0), batch.q11 = entry(3, 1);
  batch.order = std::move(order);
  return batch;
}

template <class Real, class Kind>
ElementBatch<Real, Kind> make_element_batch(const ElementList<Kind>& list, BatchOrder order,
                                            int vertex_count) {
  ElementBatch<Real, Kind> batch;
  batch.count = list.size();
  batch.law = list.law;
  for (std::size_t i = 0; i < Kind::arity; ++i)
    batch.corner[i] = corner_offsets(list.vertices, order, static_cast<int>(i), vertex_count);
  for (std::size_t i = 0; i < Kind::rest_values; ++i)
    batch.rest[i] =
        lane_values<Real>(order, padding_of<Real, Kind>(), [&](std::size_t c) { return list.rest[c][i]; });
  batch.softness = lane_values<Real>(order, Real(1),
                                     [&](std::size_t c) { return nearest_number<Real>(list.softness[c]); });
  if (const MomentLaws& moment = list.moment; !moment.empty()) {
    batch.softening = moment.softening;
    batch.length = lane_values<Real>(
        order, Real(0), [&](std::size_t c) { return moment.length.empty() ? 0 : moment.length[c]; });
    const Real never = std::numeric_limits<Real>::infinity();
    batch.yield = lane_values<Real>(order, never, [&](std::size_t c) {
      return moment.yield.empty() ? static_cast<double>(never) : moment.yield[c];
    });
    batch.hardening = lane_values<Real>(
        order, Real(0), [&](std::size_t c) { return moment.yield.empty() ? 0 : moment.hardening[c]; });
  }
  batch.order = std::move(order);
  return batch;
}

template DistanceBatch<float> make_distance_batch(const DistanceConstraints&, BatchOrder, int);
template DistanceBatch<double> make_distance_batch(const DistanceConstraints&, BatchOrder, int);
template StrainBatch<float> make_strain_batch(const StrainConstraints&, BatchOrder, int);
template StrainBatch<double> make_strain_batch(const StrainConstraints&, BatchOrder, int);
#define BENDLAB_MAKE_BATCH(Kind)                                                                    \
  template ElementBatch<float, Kind> make_element_batch(const ElementList<Kind>&, BatchOrder, int); \
  template ElementBatch<double, Kind> make_element_batch(const ElementList<Kind>&, BatchOrder, int);
BENDLAB_FOR_ELEMENT_KINDS(BENDLAB_MAKE_BATCH)

}  // namespace bendlab
