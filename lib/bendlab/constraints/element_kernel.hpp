// What the kernels of all element kinds share. The source of a kind specialises PackKernel and instantiates
// the kernels with BENDLAB_ELEMENT_KERNELS; no other source includes this header.
//
// What lies in a lane: one constraint of the batch, with all its corners and rest values.
//
//   lane          0        1        2     …      lanes<Real> of a group at a time
//   corner 0      v        v        v            p[0]: packs of x, y, z and of w = 1/m
//   corner 1      v        v        v            p[1], …; offsets in batch.corner[i]
//   rest          r        r        r            rest[0], …; in batch.rest[i]
//   α, λ          α        α        α            XPBD: from batch.softness, batch.multiplier
//
// The scalar code beside it: Kind::value() and project_by_oracle() in oracle.hpp.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/pack.hpp"

namespace bendlab {

/// ConstraintValue for the lanes of a pack.
template <class Real, std::size_t N>
struct PackConstraint {
  Pack<Real> value;
  std::array<PackVector<Real>, N> gradient;
  PackMask<Real> defined;
};

/// The laws of a kind, as a type.
template <auto... laws>
struct LawList {};

/// What a kind gives its kernels; `law` is a std::integral_constant<Kind::Law, …>:
///
/// * `Laws`: its LawList;
/// * `evaluate<Real>(points, rest, law)` → PackConstraint<Real, Kind::arity>: the lanes' Kind::value();
/// * `rest_size_squared(rest)`, m²: of a length that is no longer than the constraint's size at rest;
/// * `exceeds_rest_size(squared, rest)`: the lanes in which a squared length is larger than that;
/// * if it is OneSided, `change(value, rest, law, w, alpha, multiplier)`: the lanes' Kind::change();
/// * if it opens along its rest shape, `when_collapsed(points, rest, law)`: in collapsed lanes the value to
///   correct, elsewhere 0 (see ConstraintValue).
template <class Kind>
struct PackKernel;

namespace detail {

template <std::size_t N>
BENDLAB_INLINE std::array<const int*, N> offsets_at(const std::array<LargeArray<int>, N>& corner,
                                                    std::size_t lane) {
  std::array<const int*, N> offsets;
  for (std::size_t i = 0; i < N; ++i) offsets[i] = &corner[i][lane];
  return offsets;
}

template <class Real, std::size_t N>
BENDLAB_INLINE std::array<PackPoints<Real>, N> gather_points(const Point<Real>* points,
                                                             const std::array<LargeArray<int>, N>& corner,
                                                             std::size_t lane) {
  std::array<PackPoints<Real>, N> packs;
  for (std::size_t i = 0; i < N; ++i) packs[i] = gather(points, &corner[i][lane]);
  return packs;
}

template <class Real, std::size_t N>
BENDLAB_INLINE void scatter_corners(Point<Real>* points, const std::array<LargeArray<int>, N>& corner,
                                    std::size_t lane, const std::array<PackPoints<Real>, N>& packs) {
  for (std::size_t i = 0; i < N; ++i) scatter(points, &corner[i][lane], packs[i]);
}

template <class Real, std::size_t N>
BENDLAB_INLINE std::array<Pack<Real>, N> load_rest(const std::array<LargeArray<Real>, N>& rest,
                                                   std::size_t lane) {
  std::array<Pack<Real>, N> packs;
  for (std::size_t i = 0; i < N; ++i) packs[i] = load(&rest[i][lane]);
  return packs;
}

template <class Real>
BENDLAB_INLINE Pack<Real> larger(const Pack<Real>& x, const Pack<Real>& y) {
  return x > y ? x : y;
}

// Sums over ∇C that a projection needs.
template <class Real>
struct Leverage {
  Pack<Real> weighted{};  // Σ w|∇C|²
  Pack<Real> largest_w{};
  PackMask<Real> is_more_than_rounding;  // the gradient of the corners that can move (see least_lever)

  template <std::size_t N>
  BENDLAB_INLINE Leverage(const std::array<PackPoints<Real>, N>& p,
                          const std::array<PackVector<Real>, N>& gradient) {
    Pack<Real> whole{};
    for (std::size_t i = 0; i < N; ++i) {
      const Pack<Real> squared = dot(gradient[i], gradient[i]);
      weighted = weighted + p[i].w * squared, whole = whole + squared;
      largest_w = larger<Real>(largest_w, p[i].w);
    }
    is_more_than_rounding = weighted > least_lever<Real> * largest_w * whole;
  }
};

// Shortens a change of the multiplier that would move a corner farther than largest_move sizes.
template <class Kind, class Real>
BENDLAB_INLINE Pack<Real> within_reach(const Pack<Real>& change,
                                       const std::array<PackVector<Real>, Kind::arity>& gradient,
                                       const std::array<PackPoints<Real>, Kind::arity>& p,
                                       const std::array<Pack<Real>, Kind::rest_values>& rest) {
  Pack<Real> size = PackKernel<Kind>::template rest_size_squared<Real>(rest), farthest{};
  for (std::size_t i = 0; i < Kind::arity; ++i) {
    farthest = larger<Real>(farthest, p[i].w * p[i].w * dot(gradient[i], gradient[i]));
    for (std::size_t j = i + 1; j < Kind::arity; ++j) {
      const PackVector<Real> d = p[j].position - p[i].position;
      size = larger<Real>(size, dot(d, d));
    }
  }
  const Pack<Real> one = broadcast<Real>(1), way = change * farthest * change,
                   most = Real(largest_move * largest_move) * size;
  const auto too_far = way > most;
  return too_far ? change * square_root(most / (too_far ? way : one)) : change;
}

// Gives lanes without a direction the gradient of their rest shape, or a gradient of 0 if that has none
// either.
template <class Kind, class Real, class Law>
BENDLAB_INLINE PackConstraint<Real, Kind::arity> opened(PackConstraint<Real, Kind::arity> c,
                                                        const std::array<PackPoints<Real>, Kind::arity>& p,
                                                        const std::array<Pack<Real>, Kind::rest_values>& rest,
                                                        Law law, const ElementBatch<Real, Kind>& batch,
                                                        std::size_t lane) {
  std::array<PackVector<Real>, Kind::arity> gradient{};
  PackMask<Real> opens{};
  if constexpr (requires { PackKernel<Kind>::template when_collapsed<Real>(p, rest, law); }) {
    if (batch.rest_points != nullptr) {
      const auto at_rest = PackKernel<Kind>::template evaluate<Real>(
          gather_points<Real>(batch.rest_points, batch.corner, lane), rest, law);
      const Pack<Real> value = PackKernel<Kind>::template when_collapsed<Real>(p, rest, law);
      opens = ~c.defined & at_rest.defined & (value != Pack<Real>{});
      c.value = opens ? value : c.value;
      for (std::size_t i = 0; i < Kind::arity; ++i)
        gradient[i] = select(opens, at_rest.gradient[i], gradient[i]);
    }
  }
  for (std::size_t i = 0; i < Kind::arity; ++i) c.gradient[i] = select(c.defined, c.gradient[i], gradient[i]);
  c.defined = c.defined | opens;
  return c;
}

// Projects a pack of constraints. Returns false and changes nothing if they have to be projected carefully:
// one has collapsed, or a corner would move farther than its constraint's size at rest.
template <class Real, class Kind, typename Kind::Law law, bool compliant, bool careful, bool split>
BENDLAB_INLINE bool project_pack(const Places<Real>& places, ElementBatch<Real, Kind>& batch,
                                 std::size_t lane, Real compliance_over_h2) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  const auto offsets = offsets_at(batch.corner, lane);
  std::array<PackPoints<Real>, Kind::arity> p;
  [[maybe_unused]] std::array<MovedRows<Real>, Kind::arity> moved;
  if constexpr (split) {
    for (std::size_t i = 0; i < Kind::arity; ++i) moved[i] = moved_rows(places, offsets[i]);
    const BaseRows<Real> base = base_rows(places, offsets[0], moved[0], p[0]);
    for (std::size_t i = 1; i < Kind::arity; ++i) p[i] = base.relative(places, offsets[i], moved[i]);
  } else {
    for (std::size_t i = 0; i < Kind::arity; ++i) p[i] = gather(places.moved, offsets[i]);
  }
  const auto rest = load_rest(batch.rest, lane);
  constexpr std::integral_constant<typename Kind::Law, law> this_law;
  PackConstraint<Real, Kind::arity> c = PackKernel<Kind>::template evaluate<Real>(p, rest, this_law);
  if constexpr (careful) c = opened<Kind>(c, p, rest, this_law, batch, lane);
  const Leverage<Real> leverage(p, c.gradient);
  PackMask<Real> acts = c.defined & leverage.is_more_than_rounding;
  Pack<Real> sum = leverage.weighted, alpha{}, multiplier{};
  if constexpr (compliant) {
    alpha = compliance_over_h2 * load(&batch.softness[lane]);
    if constexpr (!OneSided<Kind>) sum = sum + alpha;
  }
  if constexpr (OneSided<Kind> && !compliant) acts = acts & (c.value < zero);
  const Pack<Real> divisor = acts ? sum : one;
  Pack<Real> change;
  if constexpr (compliant) {
    multiplier = load(&batch.multiplier[lane]);
    if constexpr (OneSided<Kind>)
      change =
          acts ? PackKernel<Kind>::template change<Real>(c.value, rest, this_law, divisor, alpha, multiplier)
               : zero;
    else
      change = acts ? (-c.value - alpha * multiplier) / divisor : zero;
  } else {
    change = acts ? -batch.k * c.value / divisor : zero;
  }
  if constexpr (careful) {
    change = within_reach<Kind>(change, c.gradient, p, rest);
  } else {
    // No corner moves farther than √way: w²|∇C|² is at most the largest w times Σ w|∇C|².
    const Pack<Real> way = change * leverage.weighted * change * leverage.largest_w;
    if (any(~c.defined | PackKernel<Kind>::template exceeds_rest_size<Real>(way, rest))) [[unlikely]]
      return false;
  }
  if constexpr (compliant) store(&batch.multiplier[lane], multiplier + change);
  for (std::size_t i = 0; i < Kind::arity; ++i) {
    const PackVector<Real> move = scaled<Real>(change * p[i].w, c.gradient[i]);
    if constexpr (split) {
      scatter_moved(places, offsets[i], moved[i], move);
    } else {
      p[i].position = p[i].position + move;
      scatter(places.moved, offsets[i], p[i]);
    }
  }
  return true;
}

// A function of its own, so that the rare case takes no registers from the usual one.
template <class Real, class Kind, typename Kind::Law law, bool compliant, bool split>
[[gnu::noinline]] void project_carefully(const Places<Real>& places, ElementBatch<Real, Kind>& batch,
                                         std::size_t lane, Real compliance_over_h2) {
  project_pack<Real, Kind, law, compliant, true, split>(places, batch, lane, compliance_over_h2);
}

template <class Real, class Kind, typename Kind::Law law, bool compliant, bool split>
void project_lanes(const Places<Real>& places, ElementBatch<Real, Kind>& batch, std::size_t first,
                   std::size_t last, Real compliance_over_h2) {
  for (std::size_t lane = batch.order.stacks[first]; lane < batch.order.stacks[last];
       lane += static_cast<std::size_t>(lanes<Real>))
    if (!project_pack<Real, Kind, law, compliant, false, split>(places, batch, lane, compliance_over_h2))
        [[unlikely]]
      project_carefully<Real, Kind, law, compliant, split>(places, batch, lane, compliance_over_h2);
}

template <class Real, class Kind, typename Kind::Law law>
void damp_lanes(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch,
                Real k) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  for (std::size_t lane = 0; lane < batch.order.lane_count(); lane += static_cast<std::size_t>(lanes<Real>)) {
    const auto p = gather_points<Real>(points, batch.corner, lane);
    auto v = gather_points<Real>(velocities, batch.corner, lane);
    PackConstraint<Real, Kind::arity> c = PackKernel<Kind>::template evaluate<Real>(
        p, load_rest(batch.rest, lane), std::integral_constant<typename Kind::Law, law>{});
    if (any(~c.defined)) [[unlikely]]
      for (PackVector<Real>& gradient : c.gradient)
        gradient = select(c.defined, gradient, PackVector<Real>{});
    Pack<Real> rate{};
    for (std::size_t i = 0; i < Kind::arity; ++i) rate = rate + dot(c.gradient[i], v[i].position);
    const Leverage<Real> leverage(p, c.gradient);
    PackMask<Real> acts = c.defined & leverage.is_more_than_rounding;
    if constexpr (OneSided<Kind>) acts = acts & (c.value < zero);
    const Pack<Real> change = acts ? -k * rate / (acts ? leverage.weighted : one) : zero;
    for (std::size_t i = 0; i < Kind::arity; ++i)
      v[i].position = v[i].position + scaled<Real>(change * p[i].w, c.gradient[i]);
    scatter_corners(velocities, batch.corner, lane, v);
  }
}

template <class Real, class Kind, typename Kind::Law law>
void add_forces_of_lanes(const Point<Real>* points, Point<Real>* forces,
                         const ElementBatch<Real, Kind>& batch, std::size_t first, std::size_t last) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>)) {
    const auto p = gather_points<Real>(points, batch.corner, lane);
    auto force = gather_points<Real>(forces, batch.corner, lane);
    const PackConstraint<Real, Kind::arity> c = PackKernel<Kind>::template evaluate<Real>(
        p, load_rest(batch.rest, lane), std::integral_constant<typename Kind::Law, law>{});
    const Pack<Real> alpha = batch.compliance * load(&batch.softness[lane]);
    const auto acts = c.defined & (alpha > zero);
    const Pack<Real> multiplier = acts ? c.value / (acts ? alpha : one) : zero;
    for (std::size_t i = 0; i < Kind::arity; ++i)
      force[i].position =
          force[i].position - select(acts, scaled<Real>(multiplier, c.gradient[i]), PackVector<Real>{});
    scatter_corners(forces, batch.corner, lane, force);
  }
}

// Calls action(std::integral_constant<Law, law>) for the batch's law.
template <class Law, auto... laws, class Action>
void with_law(Law chosen, LawList<laws...>, const Action& action) {
  ((chosen == laws ? action(std::integral_constant<Law, laws>{}) : void()), ...);
}

}  // namespace detail

// No two constraints of a stack share a vertex, so the order within it does not matter.
template <class Real, class Kind>
void project(const PlacesOf<Real>& places, ElementBatch<Real, Kind>& batch, std::size_t first,
             std::size_t last, Real substep, bool) {
  const Real compliance = batch.compliance / (substep * substep);
  detail::with_law(batch.law, typename PackKernel<Kind>::Laws{}, [&](auto law) {
    with_split(places, [&]<bool split>(std::bool_constant<split>) {
      batch.kind == StiffnessKind::compliance
          ? detail::project_lanes<Real, Kind, law.value, true, split>(places, batch, first, last, compliance)
          : detail::project_lanes<Real, Kind, law.value, false, split>(places, batch, first, last,
                                                                       compliance);
    });
  });
}

template <class Real, class Kind>
void damp(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch, Real k) {
  detail::with_law(batch.law, typename PackKernel<Kind>::Laws{}, [&](auto law) {
    detail::damp_lanes<Real, Kind, law.value>(points, velocities, batch, k);
  });
}

template <class Real, class Kind>
void add_forces(const Point<Real>* points, Point<Real>* forces, const ElementBatch<Real, Kind>& batch,
                std::size_t first, std::size_t last) {
  if constexpr (OneSided<Kind>) {
    if (first < last) throw std::logic_error("add_forces: the force of a one-sided kind jumps");
  } else {
    detail::with_law(batch.law, typename PackKernel<Kind>::Laws{}, [&](auto law) {
      detail::add_forces_of_lanes<Real, Kind, law.value>(points, forces, batch, batch.order.stacks[first],
                                                         batch.order.stacks[last]);
    });
  }
}

#define BENDLAB_ELEMENT_KERNELS(Kind)                                                                      \
  template void project(const Places<float>&, ElementBatch<float, Kind>&, std::size_t, std::size_t, float, \
                        bool);                                                                             \
  template void project(const Places<double>&, ElementBatch<double, Kind>&, std::size_t, std::size_t,      \
                        double, bool);                                                                     \
  template void add_forces(const Point<float>*, Point<float>*, const ElementBatch<float, Kind>&,           \
                           std::size_t, std::size_t);                                                      \
  template void add_forces(const Point<double>*, Point<double>*, const ElementBatch<double, Kind>&,        \
                           std::size_t, std::size_t);                                                      \
  template void damp(const Point<float>*, Point<float>*, const ElementBatch<float, Kind>&, float);         \
  template void damp(const Point<double>*, Point<double>*, const ElementBatch<double, Kind>&, double)

}  // namespace bendlab
