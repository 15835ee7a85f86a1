// Every element kind. A new one is added to both lists.
#pragma once

#include <tuple>
#include <type_traits>

#include "bendlab/constraints/arc_spring.hpp"
#include "bendlab/constraints/hinge_angle.hpp"
#include "bendlab/constraints/quadratic_bend.hpp"

#define BENDLAB_FOR_ELEMENT_KINDS(X) X(HingeAngle) X(QuadraticBend) X(ArcSpring)

namespace bendlab {

using ElementKinds = std::tuple<HingeAngle, QuadraticBend, ArcSpring>;

namespace detail {
template <class Real, class Tuple>
struct OfKinds;
template <class Real, class... Kinds>
struct OfKinds<Real, std::tuple<Kinds...>> {
  using Lists = std::tuple<ElementList<Kinds>...>;
  using Batches = std::tuple<ElementBatch<Real, Kinds>...>;

  template <class Kind>
  static constexpr std::size_t index() {
    std::size_t index = 0;
    bool found = false;
    ((found = found || std::is_same_v<Kind, Kinds>, index += !found), ...);
    return index;
  }
};
}  // namespace detail

/// A list per kind, and a batch per kind.
using ElementLists = detail::OfKinds<double, ElementKinds>::Lists;
template <class Real>
using ElementBatches = typename detail::OfKinds<Real, ElementKinds>::Batches;

/// Place of a kind in these.
template <class Kind>
inline constexpr std::size_t kind_index = detail::OfKinds<double, ElementKinds>::index<Kind>();

/// Calls action(list or batch) for each kind's.
template <class Tuple, class Action>
void for_each_kind(Tuple& elements, const Action& action) {
  std::apply([&](auto&... each) { (action(each), ...); }, elements);
}

/// Constraints of all kinds together.
inline std::size_t element_count(const ElementLists& lists) {
  std::size_t count = 0;
  for_each_kind(lists, [&](const auto& list) { count += list.size(); });
  return count;
}

}  // namespace bendlab
