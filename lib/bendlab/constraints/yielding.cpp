#include "bendlab/constraints/yielding.hpp"

#include <cmath>

#include "bendlab/constraints/corners.hpp"

namespace bendlab {
namespace {

// Calls store(rest values, yield) if the element with these corners has yielded.
template <class Kind, class Real, class Store>
bool yield_element(const std::array<Vector3Of<Real>, Kind::arity>& p,
                   const std::array<Real, Kind::rest_values>& rest, typename Kind::Law law, Real yield,
                   Real hardening, const Store& store) {
  if constexpr (Yields<Kind>) {
    const ConstraintValue<Real, Kind::arity> c = Kind::template value<Real>(p, rest, law);
    const Real value = std::abs(c.value);
    if (!c.defined || !(value > yield)) return false;
    const Real after = value_after_yield(value, yield, hardening);
    store(Kind::template moved_rest<Real>(p, rest, law, after / value), after);
    return true;
  }
  return false;
}

}  // namespace

bool can_yield(const ElementLists& lists) {
  bool any = false;
  for_each_kind(lists, [&](const auto& list) { any = any || list.moment.slips(); });
  return any;
}

std::size_t yield_to(ElementLists& lists, const Positions& positions) {
  std::size_t count = 0;
  for_each_kind(lists, [&]<class Kind>(ElementList<Kind>& list) {
    for (std::size_t c = 0; list.moment.slips() && c < list.size(); ++c)
      count += yield_element<Kind, double>(
          corners(positions, list.vertices[c]), list.rest[c], list.law, list.moment.yield[c],
          list.moment.hardening[c], [&](const std::array<double, Kind::rest_values>& rest, double yield) {
            list.rest[c] = rest, list.moment.yield[c] = yield;
          });
  });
  return count;
}

template <class Real>
std::size_t yield_to(ElementBatches<Real>& batches, const Point<Real>* points) {
  std::size_t count = 0;
  for_each_kind(batches, [&]<class Kind>(ElementBatch<Real, Kind>& batch) {
    if (batch.is_linear()) return;
    for_each_lane(batch.order, [&](std::size_t lane, int constraint) {
      if (constraint < 0) return;
      std::array<Vector3Of<Real>, Kind::arity> p;
      std::array<Real, Kind::rest_values> at_rest;
      for (std::size_t i = 0; i < p.size(); ++i) p[i] = point_at(points, batch.corner[i][lane]).vector();
      for (std::size_t i = 0; i < at_rest.size(); ++i) at_rest[i] = batch.rest[i][lane];
      count += yield_element<Kind, Real>(p, at_rest, batch.law, batch.yield[lane], batch.hardening[lane],
                                         [&](const std::array<Real, Kind::rest_values>& rest, Real yield) {
                                           for (std::size_t i = 0; i < rest.size(); ++i)
                                             batch.rest[i][lane] = rest[i];
                                           batch.yield[lane] = yield;
                                         });
    });
  });
  return count;
}

template std::size_t yield_to<float>(ElementBatches<float>&, const Point<float>*);
template std::size_t yield_to<double>(ElementBatches<double>&, const Point<double>*);

}  // namespace bendlab
