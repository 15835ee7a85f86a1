#include <array>
#include <type_traits>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/strain_terms.hpp"

namespace bendlab {
namespace {

// Gives the lanes without a direction that of their rest shape, and a gradient of 0 to those that have none there either.
template <class Real, StrainForm form, class TermOf, class Gradient>
BENDLAB_INLINE Term<Real, Gradient> opened(Term<Real, Gradient> term, const TermOf& of,
                                           const Corners<Real>& t, const StrainBatch<Real>& batch,
                                           std::size_t lane) {
  Corners<Real> at_rest{};
  if (batch.rest_points != nullptr)
    at_rest = {gather(batch.rest_points, &batch.a[lane]), gather(batch.rest_points, &batch.b[lane]),
               gather(batch.rest_points, &batch.c[lane])};
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

// What the projections of a triangle's four terms share. `multipliers` are XPBD's, of these lanes.
template <class Real>
struct TriangleLanes {
  const StrainBatch<Real>& batch;
  std::size_t lane;
  RestInverse<Real> q;
  Pack<Real> alpha, stretch_alpha;  // XPBD: α̃
  std::array<Pack<Real>, 4> multipliers{};
  PackMask<Real> defined = Pack<Real>{} == Pack<Real>{};  // of all terms so far
  Corners<Real> moved{};  // by all terms so far; where places are split

  BENDLAB_INLINE TriangleLanes(const StrainBatch<Real>& strain, std::size_t first_lane)
      : batch(strain), lane(first_lane), q(strain, first_lane) {}

  // One projection of one term: PBD with the fraction k, or XPBD. `careful`: collapsed lanes take the gradient of their rest
  // shape, and no corner moves too far; else `defined` says whether there are any that have collapsed.
  template <StrainForm form, bool compliant, bool careful, bool split, class TermOf>
  BENDLAB_INLINE void apply(Corners<Real>& t, const TermOf& of, Real k, const Pack<Real>& a,
                            std::size_t which) {
    auto term = of.template term<form>(t);
    if constexpr (careful)
      term = opened<Real, form>(term, of, t, batch, lane);
    else
      defined = defined & term.defined;
    const PerTriangle<Real> squares = term.gradient.squares();
    const Pack<Real> zero{}, one = broadcast<Real>(1), weighted = squares.weighted_sum(t);
    const Pack<Real> sum = compliant ? term.scale * term.scale * weighted + a : weighted;
    const auto acts = term.defined & (weighted > least_lever<Real> * t.largest_w() * squares.sum());
    const Pack<Real> divisor = acts ? sum : one;
    Pack<Real> change, step{};  // along `gradient`; of the multiplier
    if constexpr (compliant) {
      step = acts ? (-term.ratio * term.scale - a * multipliers[which]) / divisor : zero;
      change = term.scale * step;
    } else {
      change = acts ? -k * term.ratio / divisor : zero;
    }
    if constexpr (careful) {
      constexpr int most_sizes =
          TermOf::overshoots && form == StrainForm::normalised ? largest_published_move : largest_move;
      const Pack<Real> way = change * change * squares.farthest(t),
                       most = Real(most_sizes * most_sizes) * t.size_squared(rest_size_squared());
      const auto too_far = way > most;
      const Pack<Real> share = too_far ? square_root(most / (too_far ? way : one)) : one;
      change = change * share, step = step * share;
    }
    if constexpr (compliant) multipliers[which] = multipliers[which] + step;
    term.gradient.add(t, change, t);
    if constexpr (split) term.gradient.add(moved, change, t);
  }

  // Of a triangle with two sides of that length at a right angle; of others no longer than they are.
  BENDLAB_INLINE Pack<Real> rest_size_squared() const {
    return 2 / (q.q00 * q.q00 + q.q01 * q.q01 + q.q10 * q.q10 + q.q11 * q.q11);
  }

  // Whether a corner moved farther than the triangle is long at rest: then each term has to look.
  BENDLAB_INLINE bool far(const PackVector<Real>& a, const PackVector<Real>& b,
                          const PackVector<Real>& c) const {
    const Pack<Real> farthest = larger<Real>(larger<Real>(dot(a, a), dot(b, b)), dot(c, c));
    return any(~(farthest <= rest_size_squared()));
  }

  template <StrainForm form, bool compliant, bool careful, bool split>
  BENDLAB_INLINE void project(Corners<Real>& t) {
    const Pack<Real> determinant = absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    Stretch<Real> warp{q.q00, q.q10}, weft{q.q01, q.q11};
    if constexpr (careful)
      warp.was_collapsed = warp.has_collapsed(t), weft.was_collapsed = weft.has_collapsed(t);
    if (batch.warp != 0) apply<form, compliant, careful, split>(t, warp, batch.warp, stretch_alpha, 0);
    if (batch.weft != 0) apply<form, compliant, careful, split>(t, weft, batch.weft, stretch_alpha, 1);
    if (batch.shear != 0) apply<form, compliant, careful, split>(t, Shear<Real>{q}, batch.shear, alpha, 2);
    if (batch.area != 0) apply<form, compliant, careful, split>(t, Area<Real>{determinant}, batch.area, alpha, 3);
  }
};

// False where the triangles have to be projected carefully; nothing is changed then.
template <class Real, StrainForm form, bool compliant, bool careful, bool split>
BENDLAB_INLINE bool project_pack(const Places<Real>& places, StrainBatch<Real>& batch, std::size_t lane,
                                 Real twice_compliance_over_h2) {
  const std::size_t count = batch.order.constraint_of_lane.size();
  const auto corners = gather_corners<Real, split, 3>(places, {&batch.a[lane], &batch.b[lane], &batch.c[lane]});
  Corners<Real> t{corners[0], corners[1], corners[2]};
  TriangleLanes<Real> triangles(batch, lane);
  if constexpr (compliant) {  // α̃ = compliance / (A0 h²), A0 = 1 / (2 |det Q⁻¹|); four times that on S_ii - 1
    const RestInverse<Real>& q = triangles.q;
    triangles.alpha = twice_compliance_over_h2 * absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    triangles.stretch_alpha = form == StrainForm::green ? 4 * triangles.alpha : triangles.alpha;
    for (std::size_t m = 0; m < 4; ++m) triangles.multipliers[m] = load(&batch.multiplier[m * count + lane]);
  }
  triangles.template project<form, compliant, careful, split>(t);
  if constexpr (!careful) {
    const Corners<Real>& moved = triangles.moved;
    const bool far = split ? triangles.far(moved.a.position, moved.b.position, moved.c.position)
                           : triangles.far(t.a.position - corners[0].position, t.b.position - corners[1].position,
                                           t.c.position - corners[2].position);
    if (far || any(~triangles.defined)) [[unlikely]]
      return false;
  }
  if constexpr (compliant)
    for (std::size_t m = 0; m < 4; ++m) store(&batch.multiplier[m * count + lane], triangles.multipliers[m]);
  if constexpr (split) {
    scatter_added(places.moved, &batch.a[lane], triangles.moved.a.position);
    scatter_added(places.moved, &batch.b[lane], triangles.moved.b.position);
    scatter_added(places.moved, &batch.c[lane], triangles.moved.c.position);
  } else {
    scatter(places.moved, &batch.a[lane], t.a);
    scatter(places.moved, &batch.b[lane], t.b);
    scatter(places.moved, &batch.c[lane], t.c);
  }
  return true;
}

// Apart, so that what is rare takes no registers from what is not.
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
  for (std::size_t lane = batch.order.runs[first]; lane < batch.order.runs[last]; lane += width)
    if (!project_pack<Real, form, compliant, false, split>(places, batch, lane, twice_compliance_over_h2))
        [[unlikely]]
      project_carefully<Real, form, compliant, split>(places, batch, lane, twice_compliance_over_h2);
}

// Velocities after one term is damped: Δv = -k Ċ / Σ w|∇C|² w ∇C.
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

}  // namespace

// Backwards or not: the triangles of a run share no vertex, so their order does not matter.
template <class Real>
void project(const PlacesOf<Real>& places, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
             Real substep, bool) {
  const auto of_form = [&]<StrainForm form>(std::integral_constant<StrainForm, form>) {
    with_split(places, [&]<bool split>(std::bool_constant<split>) {
      batch.kind == StiffnessKind::compliance
          ? project_lanes<Real, form, true, split>(places, batch, first, last, substep)
          : project_lanes<Real, form, false, split>(places, batch, first, last, substep);
    });
  };
  switch (batch.form) {
    case StrainForm::normalised:
      return of_form(std::integral_constant<StrainForm, StrainForm::normalised>{});
    case StrainForm::green:
      return of_form(std::integral_constant<StrainForm, StrainForm::green>{});
    case StrainForm::angle:
      return of_form(std::integral_constant<StrainForm, StrainForm::angle>{});
  }
}

template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const StrainBatch<Real>& batch, Real k) {
  for (std::size_t lane = 0; lane < batch.a.size(); lane += static_cast<std::size_t>(lanes<Real>)) {
    const Corners<Real> t{gather(points, &batch.a[lane]), gather(points, &batch.b[lane]),
                          gather(points, &batch.c[lane])};
    Corners<Real> velocity{gather(velocities, &batch.a[lane]), gather(velocities, &batch.b[lane]),
                           gather(velocities, &batch.c[lane])};
    const RestInverse<Real> q(batch, lane);
    if (batch.warp != 0) damp_term(t, velocity, stretch<Real, StrainForm::normalised>(t, q.q00, q.q10), k);
    if (batch.weft != 0) damp_term(t, velocity, stretch<Real, StrainForm::normalised>(t, q.q01, q.q11), k);
    if (batch.shear != 0) damp_term(t, velocity, shear<Real, StrainForm::normalised>(t, q), k);
    scatter(velocities, &batch.a[lane], velocity.a);
    scatter(velocities, &batch.b[lane], velocity.b);
    scatter(velocities, &batch.c[lane], velocity.c);
  }
}

template void project(const Places<float>&, StrainBatch<float>&, std::size_t, std::size_t, float, bool);
template void project(const Places<double>&, StrainBatch<double>&, std::size_t, std::size_t, double, bool);
template void damp(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);

}  // namespace bendlab
