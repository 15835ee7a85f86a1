#include "bendlab/constraints/batches.hpp"

#include "bendlab/constraints/kinds.hpp"

#include <limits>
#include <tuple>

namespace bendlab {
namespace {

// For every lane offset_of() the constraint's corner `corner`, or the lane's own dummy.
template <class Vertices>
LargeArray<int> corner_offsets(const Vertices& vertices, const BatchOrder& order, int corner,
                               int vertex_count) {
  static_assert(std::tuple_size_v<typename Vertices::value_type> <= dummy_corners, "padded lanes have no dummy points for so many vertices");
  LargeArray<int> offsets(order.constraint_of_lane.size());
  for (std::size_t lane = 0; lane < offsets.size(); ++lane) {
    const int constraint = order.constraint_of_lane[lane];
    offsets[lane] = offset_of(
        constraint >= 0 ? vertices[static_cast<std::size_t>(constraint)][static_cast<std::size_t>(corner)]
                        : vertex_count + corner * max_lanes + static_cast<int>(lane) % max_lanes);
  }
  return offsets;
}

// Rest values of all lanes; a padded lane gets `padding`.
template <class Real, class Get>
LargeArray<Real> lane_values(const BatchOrder& order, Real padding, Get get) {
  LargeArray<Real> values(order.constraint_of_lane.size(), padding);
  for (std::size_t lane = 0; lane < values.size(); ++lane)
    if (order.constraint_of_lane[lane] >= 0)
      values[lane] = static_cast<Real>(get(static_cast<std::size_t>(order.constraint_of_lane[lane])));
  return values;
}

}  // namespace

template <class Real>
DistanceBatch<Real> make_distance_batch(const DistanceConstraints& list, BatchOrder order, int vertex_count) {
  DistanceBatch<Real> batch;
  batch.count = list.size();
  // A star that is shorter than its stack ends in padded lanes: its centre is that of its first spring.
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  for (std::size_t stack = 0; stack < order.stack_count(); ++stack)
    for (std::size_t lane = 0; lane < width; ++lane) {
      const int first = order.constraint_of_lane[order.stacks[stack] + lane];
      batch.a.push_back(offset_of(first >= 0 ? list.vertices.first(static_cast<std::size_t>(first))
                                             : vertex_count + static_cast<int>(lane)));
    }
  batch.b = corner_offsets(list.vertices, order, 1, vertex_count);
  batch.rest_length = lane_values<Real>(order, std::numeric_limits<Real>::max(),
                                        [&](std::size_t c) { return list.rest(c); });
  if (!list.softness.empty())
    batch.softness = lane_values<Real>(order, Real(1), [&](std::size_t c) { return list.softness[c]; });
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
    batch.rest[i] = lane_values<Real>(order, Real(1), [&](std::size_t c) { return list.rest[c][i]; });
  batch.softness = lane_values<Real>(order, Real(1), [&](std::size_t c) { return list.softness[c]; });
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
