// The kernels of all element kinds. A kernel loads a pack of constraints, computes their corrections, and
// stores the results. The source of a kind specialises PackKernel and instantiates the kernels with
// BENDLAB_ELEMENT_KERNELS. Only sources of kinds include this header.
//
//   load    WholeCorners, SplitCorners   positions and inverse masses of the corners (see Places)
//   solve   PackKernel                   C and ∇C, by a law of the kind
//           PbdStiffness, XpbdStiffness  Δλ, by the stiffness of the batch
//   store   the corners, XpbdStiffness   x += w ∇C Δλ, λ += Δλ
//
// A lane (an entry of a vector register) holds one constraint of the batch, with its corners and rest values.
//
//   lane          0        1        2     …      lanes<Real> of a group at a time
//   corner 0      v        v        v            p[0]: packs of x, y, z and of w = 1/m
//   corner 1      v        v        v            p[1], …; offsets in batch.corner[i]
//   rest          r        r        r            rest[0], …; in batch.rest[i]
//   α, λ          α        α        α            XPBD: from batch.softness, batch.multiplier
//
// The oracle (scalar code): Kind::value() and project_by_oracle() in oracle.hpp.
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

/// A kind with one of its laws, for the lanes of a pack. A specialisation inherits from ElasticKernel and has
///
/// * `evaluate(p, rest)` → PackConstraint: Kind::value() of the lanes;
/// * `rest_size_squared(rest)`, m²: the square of the constraint's size at rest, or less. (The size is the
///   largest distance of two corners. Hinges use the rest length of their edge.)
/// * `exceeds_rest_size(squared, rest)`: the lanes in which `squared` is larger than rest_size_squared().
template <class Real, class Kind, typename Kind::Law law>
struct PackKernel;

/// The defaults that a PackKernel inherits: the energy is ½ C² / α for every C, and collapsed constraints do
/// not open. A PackKernel redefines the functions in which its kind differs.
template <class Scalar, class OfKind>
struct ElasticKernel {
  using Real = Scalar;
  using Kind = OfKind;
  using Batch = ElementBatch<Real, Kind>;
  using Constraint = PackConstraint<Real, Kind::arity>;
  using Corners = std::array<PackPoints<Real>, Kind::arity>;
  using Rest = std::array<Pack<Real>, Kind::rest_values>;

  /// The lanes in which k and damping act on the value C.
  BENDLAB_INLINE static PackMask<Real> resists(const Pack<Real>&) { return Pack<Real>{} == Pack<Real>{}; }

  /// Δλ of a projection with w = Σ w|∇C|². A OneSided kind uses Kind::change() instead.
  BENDLAB_INLINE static Pack<Real> change(const Pack<Real>& value, const Rest&, const Pack<Real>& w,
                                          const Pack<Real>& alpha, const Pack<Real>& multiplier) {
    return (-value - alpha * multiplier) / (w + alpha);
  }

  /// The value to correct (ConstraintValue) in lanes whose constraint has collapsed, and 0 in all other
  /// lanes.
  BENDLAB_INLINE static Pack<Real> when_collapsed(const Corners&, const Rest&) { return Pack<Real>{}; }
};

namespace detail {

template <std::size_t N>
BENDLAB_INLINE std::array<const int*, N> offsets_at(const std::array<LargeArray<int>, N>& corner,
                                                    std::size_t lane) {
  std::array<const int*, N> offsets;
  for (std::size_t i = 0; i < N; ++i) offsets[i] = &corner[i][lane];
  return offsets;
}

template <class Real, std::size_t N>
BENDLAB_INLINE std::array<PackPoints<Real>, N> gather(const Point<Real>* points,
                                                      const std::array<const int*, N>& offsets) {
  std::array<PackPoints<Real>, N> packs;
  for (std::size_t i = 0; i < N; ++i) packs[i] = bendlab::gather(points, offsets[i]);
  return packs;
}

template <class Real, std::size_t N>
BENDLAB_INLINE void scatter(Point<Real>* points, const std::array<const int*, N>& offsets,
                            const std::array<PackPoints<Real>, N>& packs) {
  for (std::size_t i = 0; i < N; ++i) bendlab::scatter(points, offsets[i], packs[i]);
}

template <class Real, std::size_t N>
BENDLAB_INLINE std::array<Pack<Real>, N> load(const std::array<LargeArray<Real>, N>& rest, std::size_t lane) {
  std::array<Pack<Real>, N> packs;
  for (std::size_t i = 0; i < N; ++i) packs[i] = bendlab::load(&rest[i][lane]);
  return packs;
}

// The corners of a pack of constraints if places are not split (point.hpp).
template <class Real, std::size_t N>
struct WholeCorners {
  Point<Real>* points;
  std::array<const int*, N> offsets;
  std::array<PackPoints<Real>, N> p;

  BENDLAB_INLINE WholeCorners(const Places<Real>& places, const std::array<const int*, N>& at)
      : points(places.moved), offsets(at), p(gather(places.moved, at)) {}

  BENDLAB_INLINE void move(std::size_t i, const PackVector<Real>& way) const {
    bendlab::scatter<Real>(points, offsets[i], {p[i].position + way, p[i].w});
  }
};

// The corners of a pack of constraints if places are split, relative to the base of the first corner. The
// last corners are directors, which are relative to nothing.
template <class Real, std::size_t N, std::size_t directors>
struct SplitCorners {
  const Places<Real>& places;
  std::array<const int*, N> offsets;
  std::array<PackPoints<Real>, N> p;
  std::array<MovedRows<Real>, N> moved;

  BENDLAB_INLINE SplitCorners(const Places<Real>& split, const std::array<const int*, N>& at)
      : places(split), offsets(at) {
    for (std::size_t i = 0; i < N; ++i) moved[i] = moved_rows(places, offsets[i]);
    const BaseRows<Real> base = base_rows(places, offsets[0], moved[0], p[0]);
    for (std::size_t i = 1; i < N - directors; ++i) p[i] = base.relative(places, offsets[i], moved[i]);
    for (std::size_t i = N - directors; i < N; ++i) p[i] = whole_points(places, offsets[i], moved[i]);
  }

  BENDLAB_INLINE void move(std::size_t i, const PackVector<Real>& way) {
    scatter_moved(places, offsets[i], moved[i], way);
  }
};

// Sums over ∇C that a projection needs.
template <class Real>
struct Leverage {
  Pack<Real> weighted{};  // Σ w|∇C|²
  Pack<Real> largest_w{};
  PackMask<Real> is_more_than_rounding;  // whether the free corners have a usable gradient (see least_lever)

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

// ψ' α / C of the lanes (moment_law.hpp). A separate function, because most scenes never call it.
template <class Batch, class Real>
[[gnu::noinline]] Pack<Real> secants(const Batch& batch, std::size_t lane, const Pack<Real>& value) {
  Pack<Real> all = broadcast<Real>(1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(lanes<Real>); ++i)
    all[i] =
        static_cast<Real>(resistance(batch.softening, std::abs(static_cast<double>(value[i])),
                                     batch.length[lane + i], batch.yield[lane + i], batch.hardening[lane + i])
                              .secant);
  return all;
}

// PBD: a projection removes the fraction k of C.
template <class Real>
struct PbdStiffness {
  Real k;

  template <class Kernel>
  BENDLAB_INLINE Pack<Real> change(const typename Kernel::Constraint& c, const Leverage<Real>& leverage,
                                   const typename Kernel::Rest&, const typename Kernel::Batch&,
                                   std::size_t) const {
    const Pack<Real> zero{}, one = broadcast<Real>(1);
    const PackMask<Real> acts = c.defined & leverage.is_more_than_rounding & Kernel::resists(c.value);
    return acts ? -k * c.value / (acts ? leverage.weighted : one) : zero;
  }

  template <class Batch>
  BENDLAB_INLINE void store_multiplier(Batch&, std::size_t, const Pack<Real>&) const {}
};

// XPBD: α̃ is compliance_over_h2 times the constraint's softness.
template <class Real>
struct XpbdStiffness {
  Real compliance_over_h2;

  template <class Kernel>
  BENDLAB_INLINE Pack<Real> change(const typename Kernel::Constraint& c, const Leverage<Real>& leverage,
                                   const typename Kernel::Rest& rest, const typename Kernel::Batch& batch,
                                   std::size_t lane) const {
    const Pack<Real> zero{}, one = broadcast<Real>(1);
    const Pack<Real> multiplier = bendlab::load(&batch.multiplier[lane]);
    Pack<Real> alpha = compliance_over_h2 * bendlab::load(&batch.softness[lane]);
    if (!batch.is_linear()) [[unlikely]]
      alpha = alpha / secants<typename Kernel::Batch, Real>(batch, lane, c.value);
    const PackMask<Real> acts = c.defined & leverage.is_more_than_rounding;
    const Pack<Real> w = acts ? leverage.weighted : one;
    return acts ? Kernel::change(c.value, rest, w, alpha, multiplier) : zero;
  }

  template <class Batch>
  BENDLAB_INLINE void store_multiplier(Batch& batch, std::size_t lane, const Pack<Real>& change) const {
    store(&batch.multiplier[lane], bendlab::load(&batch.multiplier[lane]) + change);
  }
};

// Projects a pack of constraints. Returns false and changes nothing if project_carefully() has to project the
// pack, because a constraint has collapsed or a corner would move farther than its constraint's size at rest.
template <class Kernel, class Corners, class Stiffness, class Real>
BENDLAB_INLINE bool project_pack(const Places<Real>& places, typename Kernel::Batch& batch, std::size_t lane,
                                 const Stiffness& stiffness) {
  // Load.
  Corners corners(places, offsets_at(batch.corner, lane));
  const auto rest = load(batch.rest, lane);
  // Solve: C and ∇C, then Δλ.
  const auto c = Kernel::evaluate(corners.p, rest);
  const Leverage<Real> leverage(corners.p, c.gradient);
  const Pack<Real> change = stiffness.template change<Kernel>(c, leverage, rest, batch, lane);
  // No corner moves farther than √way, because w²|∇C|² is at most the largest w times Σ w|∇C|².
  const Pack<Real> way = change * leverage.weighted * change * leverage.largest_w;
  if (any(~c.defined | Kernel::exceeds_rest_size(way, rest))) [[unlikely]]
    return false;
  // Store.
  stiffness.store_multiplier(batch, lane, change);
  for (std::size_t i = 0; i < c.gradient.size(); ++i)
    corners.move(i, scaled<Real>(change * corners.p[i].w, c.gradient[i]));
  return true;
}

// In lanes whose gradient has no direction, uses the gradient of the constraint's rest shape. If the rest
// shape has no direction either, the gradient is 0.
template <class Kernel>
BENDLAB_INLINE void open(typename Kernel::Constraint& c, const typename Kernel::Corners& p,
                         const typename Kernel::Rest& rest, const typename Kernel::Batch& batch,
                         std::size_t lane) {
  using Real = typename Kernel::Real;
  decltype(c.gradient) gradient{};
  PackMask<Real> opens{};
  if (batch.rest_points != nullptr) {
    const auto at_rest = Kernel::evaluate(gather(batch.rest_points, offsets_at(batch.corner, lane)), rest);
    const Pack<Real> value = Kernel::when_collapsed(p, rest);
    opens = ~c.defined & at_rest.defined & (value != Pack<Real>{});
    c.value = opens ? value : c.value;
    for (std::size_t i = 0; i < gradient.size(); ++i)
      gradient[i] = select(opens, at_rest.gradient[i], gradient[i]);
  }
  for (std::size_t i = 0; i < gradient.size(); ++i)
    c.gradient[i] = select(c.defined, c.gradient[i], gradient[i]);
  c.defined = c.defined | opens;
}

// Returns `change`, a change of the multiplier, or a smaller change if `change` would move a corner farther
// than largest_move sizes of the constraint.
template <class Kernel, std::size_t directors>
BENDLAB_INLINE auto within_reach(const Pack<typename Kernel::Real>& change,
                                 const typename Kernel::Constraint& c, const typename Kernel::Corners& p,
                                 const typename Kernel::Rest& rest) {
  using Real = typename Kernel::Real;
  Pack<Real> size = Kernel::rest_size_squared(rest), farthest{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    farthest = larger<Real>(farthest, p[i].w * p[i].w * dot(c.gradient[i], c.gradient[i]));
    for (std::size_t j = i + 1; j < p.size() - directors; ++j) {
      const PackVector<Real> d = p[j].position - p[i].position;
      size = larger<Real>(size, dot(d, d));
    }
  }
  const Pack<Real> one = broadcast<Real>(1), way = change * farthest * change,
                   most = Real(largest_move * largest_move) * size;
  const auto too_far = way > most;
  return too_far ? change * square_root(most / (too_far ? way : one)) : change;
}

// Projects a pack of constraints, opens collapsed constraints and bounds the moves. A separate function, so
// that this rare case takes no registers from project_pack().
template <class Kernel, class Corners, class Stiffness, class Real>
[[gnu::noinline]] void project_carefully(const Places<Real>& places, typename Kernel::Batch& batch,
                                         std::size_t lane, const Stiffness& stiffness) {
  Corners corners(places, offsets_at(batch.corner, lane));
  const auto rest = load(batch.rest, lane);
  auto c = Kernel::evaluate(corners.p, rest);
  open<Kernel>(c, corners.p, rest, batch, lane);
  const Leverage<Real> leverage(corners.p, c.gradient);
  constexpr std::size_t directors = directors_of<typename Kernel::Kind>;
  const Pack<Real> change = within_reach<Kernel, directors>(
      stiffness.template change<Kernel>(c, leverage, rest, batch, lane), c, corners.p, rest);
  stiffness.store_multiplier(batch, lane, change);
  for (std::size_t i = 0; i < c.gradient.size(); ++i)
    corners.move(i, scaled<Real>(change * corners.p[i].w, c.gradient[i]));
}

template <class Kernel, class Corners, class Stiffness, class Real>
void project_lanes(const Places<Real>& places, typename Kernel::Batch& batch, std::size_t first,
                   std::size_t last, const Stiffness& stiffness) {
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>))
    if (!project_pack<Kernel, Corners>(places, batch, lane, stiffness)) [[unlikely]]
      project_carefully<Kernel, Corners>(places, batch, lane, stiffness);
}

template <class Kernel, class Real>
void damp_lanes(const Point<Real>* points, Point<Real>* velocities, const typename Kernel::Batch& batch,
                Real k) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  for (std::size_t lane = 0; lane < batch.order.lane_count(); lane += static_cast<std::size_t>(lanes<Real>)) {
    const auto offsets = offsets_at(batch.corner, lane);
    const auto p = gather(points, offsets);
    auto v = gather(velocities, offsets);
    auto c = Kernel::evaluate(p, load(batch.rest, lane));
    if (any(~c.defined)) [[unlikely]]
      for (PackVector<Real>& gradient : c.gradient)
        gradient = select(c.defined, gradient, PackVector<Real>{});
    Pack<Real> rate{};  // Ċ
    for (std::size_t i = 0; i < v.size(); ++i) rate = rate + dot(c.gradient[i], v[i].position);
    const Leverage<Real> leverage(p, c.gradient);
    const PackMask<Real> acts = c.defined & leverage.is_more_than_rounding & Kernel::resists(c.value);
    const Pack<Real> change = acts ? -k * rate / (acts ? leverage.weighted : one) : zero;
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i].position = v[i].position + scaled<Real>(change * p[i].w, c.gradient[i]);
    scatter(velocities, offsets, v);
  }
}

template <class Kernel, class Real>
void add_forces_of_lanes(const Point<Real>* points, Point<Real>* forces, const typename Kernel::Batch& batch,
                         std::size_t first, std::size_t last) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>)) {
    const auto offsets = offsets_at(batch.corner, lane);
    auto force = gather(forces, offsets);
    const auto c = Kernel::evaluate(gather(points, offsets), load(batch.rest, lane));
    Pack<Real> alpha = batch.compliance * bendlab::load(&batch.softness[lane]);
    if (!batch.is_linear()) [[unlikely]]
      alpha = alpha / secants<typename Kernel::Batch, Real>(batch, lane, c.value);
    const auto acts = c.defined & (alpha > zero);
    const Pack<Real> multiplier = acts ? c.value / (acts ? alpha : one) : zero;
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i].position =
          force[i].position - select(acts, scaled<Real>(multiplier, c.gradient[i]), PackVector<Real>{});
    scatter(forces, offsets, force);
  }
}

// Calls action(PackKernel<Real, Kind, law>{}) for the batch's law.
template <class Real, class Kind, class Action>
void with_kernel(const ElementBatch<Real, Kind>& batch, const Action& action) {
  using Law = typename Kind::Law;
  [&]<std::size_t... law>(std::index_sequence<law...>) {
    ((batch.law == Law{law} ? action(PackKernel<Real, Kind, Law{law}>{}) : void()), ...);
  }
  (std::make_index_sequence<Kind::law_names.size()>{});
}

}  // namespace detail

// Ignores `backwards`: no two constraints of a stack share a vertex, so their order does not matter.
template <class Real, class Kind>
void project(const PlacesOf<Real>& places, ElementBatch<Real, Kind>& batch, std::size_t first,
             std::size_t last, Real substep, bool) {
  const std::size_t begin = batch.order.stacks[first], end = batch.order.stacks[last];
  detail::with_kernel(batch, [&]<class Kernel>(Kernel) {
    with_split(places, [&]<bool split>(std::bool_constant<split>) {
      using Corners = std::conditional_t<split, detail::SplitCorners<Real, Kind::arity, directors_of<Kind>>,
                                         detail::WholeCorners<Real, Kind::arity>>;
      if (batch.kind == StiffnessKind::compliance)
        detail::project_lanes<Kernel, Corners>(
            places, batch, begin, end, detail::XpbdStiffness<Real>{batch.compliance / (substep * substep)});
      else
        detail::project_lanes<Kernel, Corners>(places, batch, begin, end,
                                               detail::PbdStiffness<Real>{batch.k});
    });
  });
}

template <class Real, class Kind>
void damp(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch, Real k) {
  detail::with_kernel(
      batch, [&]<class Kernel>(Kernel) { detail::damp_lanes<Kernel>(points, velocities, batch, k); });
}

template <class Real, class Kind>
void add_forces(const Point<Real>* points, Point<Real>* forces, const ElementBatch<Real, Kind>& batch,
                std::size_t first, std::size_t last) {
  if constexpr (OneSided<Kind>) {
    if (first < last)
      throw std::logic_error("add_forces() does not support one-sided kinds, because their force jumps");
  } else {
    detail::with_kernel(batch, [&]<class Kernel>(Kernel) {
      detail::add_forces_of_lanes<Kernel>(points, forces, batch, batch.order.stacks[first],
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
