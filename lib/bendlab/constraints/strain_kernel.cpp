// A lane (an entry of a vector register) holds one triangle, with the multipliers λ of its four terms.
//
//     c         lane        0      1      2    …     lanes<Real> of a group at a time
//    / \        a, b, c     v      v      v          Corners: packs of x, y, z and of w = 1/m
//   /   \       Q⁻¹         q      q      q          RestInverse: q00, q01, q10, q11, 1/m
//  a-----b      λ           λ      λ      λ          multipliers[4]: warp, weft, shear, area (XPBD)
//
// The four terms (strain_terms.hpp) are projected one after another, while the triangle stays in registers. A
// careful projection opens collapsed triangles and bounds the moves of corners. A careful projection is slow,
// so only the packs that need it are projected carefully. The oracle (scalar code): stretch_constraint(),
// shear_constraint() and area_constraint() in oracle.hpp.
#include <array>
#include <type_traits>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/strain_terms.hpp"

namespace bendlab {
namespace {

// In lanes whose gradient has no direction, uses the gradient of the triangle's rest shape. If the rest shape
// has no direction either, the gradient is 0.
template <class Real, StrainForm form, bool split, class TermOf, class Gradient>
BENDLAB_INLINE Term<Real, Gradient> opened(Term<Real, Gradient> term, const TermOf& of,
                                           const Corners<Real, split>& t, const StrainBatch<Real>& batch,
                                           std::size_t lane) {
  Corners<Real> at_rest{};
  if (batch.rest_points != nullptr)
    at_rest.a = gather(batch.rest_points, &batch.a[lane]),
    at_rest.b = gather(batch.rest_points, &batch.b[lane]),
    at_rest.c = gather(batch.rest_points, &batch.c[lane]);
  constexpr StrainForm form_at_rest = TermOf::opens_normalised ? StrainForm::normalised : form;
  const Term<Real, Gradient> rest = of.template term<form_at_rest>(at_rest);
  const Opening<Real> opening = of.template opening<form>(t, at_rest);
  const PackMask<Real> lanes = TermOf::opens_normalised ? opening.lanes : ~term.defined & opening.lanes;
  const PackMask<Real> opens = lanes & rest.defined;
  term.gradient = select(opens, rest.gradient, select(term.defined, term.gradient, Gradient{}));
  term.ratio = opens ? opening.value / rest.scale : term.ratio;
  term.scale = opens ? rest.scale : term.scale;
  term.defined = term.defined | opens;
  return term;
}

// The data that the projections of a triangle's four terms share.
template <class Real>
struct TriangleLanes {
  const StrainBatch<Real>& batch;
  std::size_t lane;
  RestInverse<Real> q;
  Pack<Real> alpha;                                       // XPBD: α̃ of a term with the softness 1
  std::array<Pack<Real>, 4> multipliers{};                // XPBD: λ
  PackMask<Real> defined = Pack<Real>{} == Pack<Real>{};  // whether all terms so far are defined
  // If Σ w|∇C|² / Σ|∇C|² is smaller, the gradient is only a rounding error (see least_lever).
  Pack<Real> least_weight;
  Pack<Real> way{};  // over all terms so far: no corner moved farther than √(way · largest w)
  // Like `way`, but each term is divided by the square of the number of sizes by which it may move a corner.
  Pack<Real> allowed_way{};

  BENDLAB_INLINE TriangleLanes(const StrainBatch<Real>& strain, std::size_t first_lane)
      : batch(strain), lane(first_lane), q(strain, first_lane) {}

  // One projection of one term: PBD with the fraction k, or XPBD with a = α̃. If the projection is not
  // `careful`, `defined`, `way` and `allowed_way` record whether a careful projection is needed.
  template <StrainForm form, bool compliant, bool careful, bool split, class TermOf>
  BENDLAB_INLINE void apply(Corners<Real, split>& t, const TermOf& of, Real k, const Pack<Real>& a,
                            std::size_t which) {
    auto term = of.template term<form>(t);
    if constexpr (careful)
      term = opened<Real, form>(term, of, t, batch, lane);
    else
      defined = defined & term.defined;
    const PerTriangle<Real> squares = term.gradient.squares();
    const Pack<Real> zero{}, one = broadcast<Real>(1), weighted = squares.weighted_sum(t);
    const Pack<Real> sum = compliant ? term.scale * term.scale * weighted + a : weighted;
    const auto acts = term.defined & (weighted > least_weight * squares.sum());
    const Pack<Real> divisor = acts ? sum : one;
    Pack<Real> change, step{};  // the move along `gradient`; Δλ
    if constexpr (compliant) {
      step = acts ? (-term.ratio * term.scale - a * multipliers[which]) / divisor : zero;
      change = term.scale * step;
    } else {
      change = acts ? -k * term.ratio / divisor : zero;
    }
    constexpr int most_sizes =
        TermOf::overshoots && form == StrainForm::normalised ? largest_published_move : largest_move;
    if constexpr (careful) {
      const Pack<Real> farthest = change * squares.farthest(t) * change,
                       most = Real(most_sizes * most_sizes) * t.size_squared(rest_size_squared());
      const auto too_far = farthest > most;
      const Pack<Real> share = too_far ? square_root(most / (too_far ? farthest : one)) : one;
      change = change * share, step = step * share;
    } else {
      // Multiplied in this order, because change * change may be subnormal, which is slow.
      const Pack<Real> squared = change * weighted * change;
      way = larger<Real>(way, squared);
      allowed_way = larger<Real>(allowed_way, squared * (Real(1) / Real(most_sizes * most_sizes)));
    }
    if constexpr (compliant) multipliers[which] = multipliers[which] + step;
    term.gradient.add(t, change, t);
  }

  // The square of the size at rest. Exact for two equal sides at a right angle, otherwise too small.
  BENDLAB_INLINE Pack<Real> rest_size_squared() const { return 2 / squared_inverses(); }
  BENDLAB_INLINE Pack<Real> squared_inverses() const {
    return q.q00 * q.q00 + q.q01 * q.q01 + q.q10 * q.q10 + q.q11 * q.q11;
  }

  // Whether a term was not defined, or may have moved a corner farther than is allowed.
  template <bool split>
  BENDLAB_INLINE bool needs_care(const Corners<Real, split>& t) const {
    return any(~defined | (allowed_way * t.largest_w() * squared_inverses() > broadcast<Real>(2)));
  }

  // Whether a corner may have moved farther than its triangle's size at rest. If a term had collapsed before
  // such a move, the projection is also repeated carefully.
  template <bool split>
  BENDLAB_INLINE bool moved_far(const Corners<Real, split>& t) const {
    return any(way * t.largest_w() * squared_inverses() > broadcast<Real>(2));
  }
  template <bool split>
  BENDLAB_INLINE bool any_collapsed(const Corners<Real, split>& t) const {
    return any(Stretch<Real>{q.q00, q.q10}.has_collapsed(t) | Stretch<Real>{q.q01, q.q11}.has_collapsed(t));
  }

  template <StrainForm form>
  BENDLAB_INLINE Pack<Real> stretch_alpha(std::size_t axis) const {
    return static_cast<Real>(stretch_softness(form)) * batch.term_softness[axis] * alpha;
  }

  template <StrainForm form, bool compliant, bool careful, bool split>
  BENDLAB_INLINE void project(Corners<Real, split>& t) {
    const Pack<Real> determinant = absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    least_weight = least_lever<Real> * t.largest_w();
    Stretch<Real> warp{q.q00, q.q10}, weft{q.q01, q.q11};
    if constexpr (careful)
      warp.was_collapsed = warp.has_collapsed(t), weft.was_collapsed = weft.has_collapsed(t);
    if (batch.warp != 0) apply<form, compliant, careful>(t, warp, batch.warp, stretch_alpha<form>(0), 0);
    if (batch.weft != 0) apply<form, compliant, careful>(t, weft, batch.weft, stretch_alpha<form>(1), 1);
    if (batch.shear != 0)
      apply<form, compliant, careful>(
          t, Shear<Real>{q}, batch.shear,
          static_cast<Real>(shear_softness(form)) * batch.term_softness[2] * alpha, 2);
    if (batch.area != 0)
      apply<form, compliant, careful>(t, Area<Real>{q, determinant}, batch.area,
                                      area_softness(form, batch.area) * alpha, 3);
  }
};

template <class Real, bool split>
BENDLAB_INLINE Corners<Real, split> gather_triangles(const Places<Real>& places,
                                                     const StrainBatch<Real>& batch, std::size_t lane) {
  const int *const a = &batch.a[lane], *const b = &batch.b[lane], *const c = &batch.c[lane];
  Corners<Real, split> t;
  if constexpr (split) {
    const detail::BaseRows<Real> base = detail::base_rows(places, a, detail::moved_rows(places, a), t.a);
    const PackPoints<Real> first = base.relative_base(places, b), second = base.relative_base(places, c);
    t.first_base = first.position, t.second_base = second.position;
    t.b.position = gather(places.moved, b).position, t.b.w = first.w;
    t.c.position = gather(places.moved, c).position, t.c.w = second.w;
  } else {
    t.a = gather(places.moved, a), t.b = gather(places.moved, b), t.c = gather(places.moved, c);
  }
  return t;
}

// Projects a pack of triangles. Returns false and changes nothing if a careful projection is needed.
template <class Real, StrainForm form, bool compliant, bool careful, bool split>
BENDLAB_INLINE bool project_pack(const Places<Real>& places, StrainBatch<Real>& batch, std::size_t lane,
                                 Real twice_compliance_over_h2) {
  const std::size_t count = batch.a.size();
  Corners<Real, split> t = gather_triangles<Real, split>(places, batch, lane);
  TriangleLanes<Real> triangles(batch, lane);
  // α̃ = compliance / (A0 h²) with A0 = 1 / (2 |det Q⁻¹|), and four times as large for S_ii - 1 = 2 E_ii.
  if constexpr (compliant) {
    const RestInverse<Real>& q = triangles.q;
    triangles.alpha = twice_compliance_over_h2 * absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    if (!batch.softness.empty()) triangles.alpha = triangles.alpha * load(&batch.softness[lane]);
    for (std::size_t m = 0; m < 4; ++m) triangles.multipliers[m] = load(&batch.multiplier[m * count + lane]);
  }
  triangles.template project<form, compliant, careful>(t);
  if constexpr (!careful)
    if (triangles.needs_care(t) ||
        (triangles.moved_far(t) &&
         triangles.any_collapsed(gather_triangles<Real, split>(places, batch, lane)))) [[unlikely]]
      return false;
  if constexpr (compliant)
    for (std::size_t m = 0; m < 4; ++m) store(&batch.multiplier[m * count + lane], triangles.multipliers[m]);
  if constexpr (split) t.a.w = t.b.w = t.c.w = Pack<Real>{};  // the base has the inverse masses
  scatter(places.moved, &batch.a[lane], t.a);
  scatter(places.moved, &batch.b[lane], t.b);
  scatter(places.moved, &batch.c[lane], t.c);
  return true;
}

// A separate function, so that this rare case takes no registers from project_pack().
template <class Real, StrainForm form, bool compliant, bool split>
[[gnu::noinline]] void project_carefully(const Places<Real>& places, StrainBatch<Real>& batch,
                                         std::size_t lane, Real twice_compliance_over_h2) {
  project_pack<Real, form, compliant, true, split>(places, batch, lane, twice_compliance_over_h2);
}

template <class Real, StrainForm form, bool compliant, bool split>
void project_lanes(const Places<Real>& places, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
                   Real substep) {
  const Real twice_compliance_over_h2 = compliant ? 2 * batch.compliance / (substep * substep) : Real(0);
  constexpr auto width = static_cast<std::size_t>(lanes<Real>);
  for (std::size_t lane = batch.order.stacks[first]; lane < batch.order.stacks[last]; lane += width)
    if (!project_pack<Real, form, compliant, false, split>(places, batch, lane, twice_compliance_over_h2))
        [[unlikely]]
      project_carefully<Real, form, compliant, split>(places, batch, lane, twice_compliance_over_h2);
}

// Damps one term: Δv = -k Ċ / Σ w|∇C|² w ∇C.
template <class Real, class Gradient>
BENDLAB_INLINE void damp_term(const Corners<Real>& t, Corners<Real>& velocity, Term<Real, Gradient> term,
                              Real k) {
  if (any(~term.defined)) [[unlikely]]
    term.gradient = select(term.defined, term.gradient, Gradient{});
  const PerTriangle<Real> squares = term.gradient.squares();
  const Pack<Real> zero{}, one = broadcast<Real>(1), sum = squares.weighted_sum(t);
  const auto acts = term.defined & (sum > least_lever<Real> * t.largest_w() * squares.sum());
  term.gradient.add(velocity, acts ? -k * term.gradient.rate(velocity) / (acts ? sum : one) : zero, t);
}

// Inverse masses of 1, with which add() adds forces, because forces do not depend on masses.
template <class Real>
struct UnitMasses {
  struct {
    Pack<Real> w = broadcast<Real>(1);
  } a, b, c;
};

// Adds -ψ'(C) ∇C of one term.
template <class Real, class Gradient>
BENDLAB_INLINE void add_force(Corners<Real>& force, Term<Real, Gradient> term, const Pack<Real>& alpha) {
  if (any(~term.defined)) [[unlikely]]
    term.gradient = select(term.defined, term.gradient, Gradient{});
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  const auto acts = term.defined & (alpha > zero);
  const Pack<Real> multiplier = acts ? -term.ratio * term.scale * term.scale / (acts ? alpha : one) : zero;
  term.gradient.add(force, multiplier, UnitMasses<Real>{});
}

template <class Real, StrainForm form>
void add_forces_of_lanes(const Point<Real>* points, Point<Real>* forces, const StrainBatch<Real>& batch,
                         std::size_t first, std::size_t last) {
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>)) {
    const Corners<Real> t{gather(points, &batch.a[lane]), gather(points, &batch.b[lane]),
                          gather(points, &batch.c[lane])};
    Corners<Real> force{gather(forces, &batch.a[lane]), gather(forces, &batch.b[lane]),
                        gather(forces, &batch.c[lane])};
    const RestInverse<Real> q(batch, lane);
    const Pack<Real> determinant = absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10),
                     softness = batch.softness.empty() ? broadcast<Real>(1) : load(&batch.softness[lane]),
                     alpha = 2 * batch.compliance * softness * determinant;  // compliance / rest area
    constexpr Real stretch_scale = stretch_softness(form), shear_scale = shear_softness(form);
    const std::array<Real, 3>& softer = batch.term_softness;
    if (batch.warp != 0)
      add_force(force, stretch<Real, form, false>(t, q.q00, q.q10), stretch_scale * softer[0] * alpha);
    if (batch.weft != 0)
      add_force(force, stretch<Real, form, false>(t, q.q01, q.q11), stretch_scale * softer[1] * alpha);
    if (batch.shear != 0) add_force(force, shear<Real, form, false>(t, q), shear_scale * softer[2] * alpha);
    if (batch.area != 0)
      add_force(force, Area<Real>{q, determinant}.template term<form>(t),
                area_softness(form, batch.area) * alpha);
    scatter(forces, &batch.a[lane], force.a);
    scatter(forces, &batch.b[lane], force.b);
    scatter(forces, &batch.c[lane], force.c);
  }
}

// Calls action(std::integral_constant<StrainForm, form>) for the batch's form.
template <class Action>
void with_form(StrainForm chosen, const Action& action) {
  switch (chosen) {
    case StrainForm::normalised:
      return action(std::integral_constant<StrainForm, StrainForm::normalised>{});
    case StrainForm::green:
      return action(std::integral_constant<StrainForm, StrainForm::green>{});
    case StrainForm::angle:
      return action(std::integral_constant<StrainForm, StrainForm::angle>{});
    case StrainForm::stvk:
      return action(std::integral_constant<StrainForm, StrainForm::stvk>{});
  }
}

}  // namespace

// Ignores `backwards`: no two triangles of a stack share a vertex, so their order does not matter.
template <class Real>
void project(const PlacesOf<Real>& places, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
             Real substep, bool) {
  with_form(batch.form, [&]<StrainForm form>(std::integral_constant<StrainForm, form>) {
    with_split(places, [&]<bool split>(std::bool_constant<split>) {
      batch.kind == StiffnessKind::compliance
          ? project_lanes<Real, form, true, split>(places, batch, first, last, substep)
          : project_lanes<Real, form, false, split>(places, batch, first, last, substep);
    });
  });
}

template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const StrainBatch<Real>& batch,
                std::size_t first, std::size_t last) {
  with_form(batch.form, [&]<StrainForm form>(std::integral_constant<StrainForm, form>) {
    add_forces_of_lanes<Real, form>(points, forces, batch, batch.order.stacks[first],
                                    batch.order.stacks[last]);
  });
}

template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const StrainBatch<Real>& batch, Real k) {
  for (std::size_t lane = 0; lane < batch.a.size(); lane += static_cast<std::size_t>(lanes<Real>)) {
    const Corners<Real> t{gather(points, &batch.a[lane]), gather(points, &batch.b[lane]),
                          gather(points, &batch.c[lane])};
    Corners<Real> velocity{gather(velocities, &batch.a[lane]), gather(velocities, &batch.b[lane]),
                           gather(velocities, &batch.c[lane])};
    const RestInverse<Real> q(batch, lane);
    if (batch.warp != 0)
      damp_term(t, velocity, stretch<Real, StrainForm::normalised, false>(t, q.q00, q.q10), k);
    if (batch.weft != 0)
      damp_term(t, velocity, stretch<Real, StrainForm::normalised, false>(t, q.q01, q.q11), k);
    if (batch.shear != 0) damp_term(t, velocity, shear<Real, StrainForm::normalised, false>(t, q), k);
    scatter(velocities, &batch.a[lane], velocity.a);
    scatter(velocities, &batch.b[lane], velocity.b);
    scatter(velocities, &batch.c[lane], velocity.c);
  }
}

template void add_forces(const Point<float>*, Point<float>*, const StrainBatch<float>&, std::size_t,
                         std::size_t);
template void add_forces(const Point<double>*, Point<double>*, const StrainBatch<double>&, std::size_t,
                         std::size_t);
template void project(const Places<float>&, StrainBatch<float>&, std::size_t, std::size_t, float, bool);
template void project(const Places<double>&, StrainBatch<double>&, std::size_t, std::size_t, double, bool);
template void damp(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);

}  // namespace bendlab
