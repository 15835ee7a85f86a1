// All element kinds. A new kind needs an entry in the list here, and its resistance to bending in
// calibration.cpp.
#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>

#include "bendlab/constraints/arc_spring.hpp"
#include "bendlab/constraints/face_bend.hpp"
#include "bendlab/constraints/hinge_angle.hpp"
#include "bendlab/constraints/quadratic_bend.hpp"

#define BENDLAB_FOR_ELEMENT_KINDS(X) \
  X(HingeAngle) X(QuadraticBend) X(ArcSpring) X(FoldBend) X(MidEdgeBend) X(LaplacianBend)

namespace bendlab {

namespace detail {
template <class, class... Kinds>
struct AfterFirst {
  using Tuple = std::tuple<Kinds...>;
};
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
#define BENDLAB_THEN_KIND(Kind) , Kind
using ListedKinds = AfterFirst<void BENDLAB_FOR_ELEMENT_KINDS(BENDLAB_THEN_KIND)>::Tuple;
#undef BENDLAB_THEN_KIND
}  // namespace detail

/// All element kinds, in the order of the list.
using ElementKinds = detail::ListedKinds;

/// One list per kind, and one batch per kind.
using ElementLists = detail::OfKinds<double, ElementKinds>::Lists;
template <class Real>
using ElementBatches = typename detail::OfKinds<Real, ElementKinds>::Batches;

/// Index of a kind in ElementLists and ElementBatches.
template <class Kind>
inline constexpr std::size_t kind_index = detail::OfKinds<double, ElementKinds>::index<Kind>();

/// Index of the kind that has this Kind::name. Throws std::invalid_argument with a list of the known names.
std::size_t index_of_kind(std::string_view name);

/// Calls action(list) or action(batch) for every kind of a tuple.
template <class Tuple, class Action>
void for_each_kind(Tuple& elements, const Action& action) {
  std::apply([&](auto&... lists) { (action(lists), ...); }, elements);
}

/// Number of constraints of all kinds together.
inline std::size_t element_count(const ElementLists& lists) {
  std::size_t count = 0;
  for_each_kind(lists, [&](const auto& list) { count += list.size(); });
  return count;
}

}  // namespace bendlab
