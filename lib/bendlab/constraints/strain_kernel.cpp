#include <array>
#include <type_traits>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/pack_math.hpp"

namespace bendlab {
namespace {

//        c                 e1 = p_b - p_a, e2 = p_c - p_a
//       / \                f1 = q00 e1 + q10 e2 (warp),  f2 = q01 e1 + q11 e2 (weft)
//      /   \               ∇_b = coefficient of e1, ∇_c = coefficient of e2, ∇_a = -∇_b - ∇_c
//     a-----b
template <class Real>
struct Corners {
  PackPoints<Real> a, b, c;

  PackVector<Real> first_edge() const { return b.position - a.position; }
  PackVector<Real> second_edge() const { return c.position - a.position; }
};

template <class Real>
struct RestInverse {
  Pack<Real> q00, q01, q10, q11;

  BENDLAB_INLINE RestInverse(const StrainBatch<Real>& batch, std::size_t lane)
      : q00(load(&batch.q00[lane])),
        q01(load(&batch.q01[lane])),
        q10(load(&batch.q10[lane])),
        q11(load(&batch.q11[lane])) {}
};

template <class Real>
BENDLAB_INLINE PackVector<Real> combination(const Pack<Real>& s, const PackVector<Real>& u,
                                            const Pack<Real>& t, const PackVector<Real>& v) {
  return scaled<Real>(s, u) + scaled<Real>(t, v);
}

template <class Real>
BENDLAB_INLINE Pack<Real> absolute(const Pack<Real>& x) {
  return x < Pack<Real>{} ? -x : x;
}

// A gradient that is one direction scaled per corner (stretch), or a vector per corner (shear, area).
template <class Real>
struct Scaled {
  PackVector<Real> direction;
  Pack<Real> squared;  // |direction|²
  Pack<Real> gb, gc;
  BENDLAB_INLINE Pack<Real> weighted_square(const Corners<Real>& t) const {
    const Pack<Real> ga = gb + gc;
    return (t.a.w * ga * ga + t.b.w * gb * gb + t.c.w * gc * gc) * squared;
  }
  BENDLAB_INLINE void add(Corners<Real>& t, const Pack<Real>& s, const Corners<Real>& mass) const {
    t.a.position = t.a.position - scaled<Real>(s * mass.a.w * (gb + gc), direction);
    t.b.position = t.b.position + scaled<Real>(s * mass.b.w * gb, direction);
    t.c.position = t.c.position + scaled<Real>(s * mass.c.w * gc, direction);
  }
  BENDLAB_INLINE Pack<Real> rate(const Corners<Real>& velocity) const {
    return dot(direction, combination<Real>(gb, velocity.first_edge(), gc, velocity.second_edge()));
  }
};

template <class Real>
struct PerCorner {
  PackVector<Real> gb, gc;
  BENDLAB_INLINE Pack<Real> weighted_square(const Corners<Real>& t) const {
    const PackVector<Real> ga = gb + gc;
    return t.a.w * dot(ga, ga) + t.b.w * dot(gb, gb) + t.c.w * dot(gc, gc);
  }
  BENDLAB_INLINE void add(Corners<Real>& t, const Pack<Real>& s, const Corners<Real>& mass) const {
    t.a.position = t.a.position - scaled<Real>(s * mass.a.w, gb + gc);
    t.b.position = t.b.position + scaled<Real>(s * mass.b.w, gb);
    t.c.position = t.c.position + scaled<Real>(s * mass.c.w, gc);
  }
  BENDLAB_INLINE Pack<Real> rate(const Corners<Real>& velocity) const {
    return dot(gb, velocity.first_edge()) + dot(gc, velocity.second_edge());
  }
};

// One term as C = ratio · scale and ∇C = scale · gradient, so that PBD's correction C / Σ w|∇C|² ∇C needs no
// scale: it is ratio / Σ w|gradient|² gradient, which saves most square roots and divisions. `defined` is a
// lane mask.
template <class Real, class Gradient>
struct Term {
  Pack<Real> ratio, scale;
  Gradient gradient;
  PackMask<Real> defined;
};

template <class Real>
BENDLAB_INLINE Scaled<Real> select(const PackMask<Real>& mask, const Scaled<Real>& a, const Scaled<Real>& b) {
  return {select(mask, a.direction, b.direction), mask ? a.squared : b.squared, mask ? a.gb : b.gb,
          mask ? a.gc : b.gc};
}
template <class Real>
BENDLAB_INLINE PerCorner<Real> select(const PackMask<Real>& mask, const PerCorner<Real>& a,
                                      const PerCorner<Real>& b) {
  return {select(mask, a.gb, b.gb), select(mask, a.gc, b.gc)};
}

// Lanes of a square that is neither collapsed nor overgrown.
template <class Real>
BENDLAB_INLINE PackMask<Real> in_bounds(const Pack<Real>& squared) {
  constexpr Real least = collapsed_ratio<Real> * collapsed_ratio<Real>;
  return (squared > least) & (squared < overgrown_square<Real>);
}

template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, Scaled<Real>> stretch(const Corners<Real>& t, const Pack<Real>& gb,
                                                const Pack<Real>& gc) {
  const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
  const Pack<Real> one = broadcast<Real>(1), squared = dot(f, f);
  const auto defined = in_bounds<Real>(squared);
  if constexpr (form != StrainForm::green) {         // C = l - 1, ∇C = f / l
    const Pack<Real> length = square_root(squared);  // not after the comparison: the terms wait for it
    return {squared - length, one / (defined ? length : one), {f, squared, gb, gc}, defined};
  } else {
    return {squared - one, one, {f, squared, gb + gb, gc + gc}, defined};
  }
}

// Normalised: C = cos = f1·f2 / (l1 l2), ∇C along a1 = (f2 - f1·f2 / l1² f1) / (l1 l2) and a2 likewise. Angle:
// C = atan(f1·f2 / |f1 × f2|), ∇C along the same over |f1 × f2|.
template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, PerCorner<Real>> shear(const Corners<Real>& t, const RestInverse<Real>& q) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
  const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                         f2 = combination<Real>(q.q01, e1, q.q11, e2);
  const Pack<Real> one = broadcast<Real>(1);
  const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), s12 = dot(f1, f2);
  const Pack<Real> product = s11 * s22, not_parallel = product - s12 * s12;  // (l1 l2 sin)²
  const auto aslant = not_parallel > broadcast<Real>(parallel_sine_squared<Real>) * product;
  if constexpr (form == StrainForm::green) {
    return {s12,
            one,
            {combination<Real>(q.q00, f2, q.q01, f1), combination<Real>(q.q10, f2, q.q11, f1)},
            in_bounds<Real>(s11 + s22) & (aslant | (product > broadcast<Real>(open_product<Real>)))};
  } else {
    const auto defined = in_bounds<Real>(s11) & in_bounds<Real>(s22) & aslant;
    const Pack<Real> inverse = one / (defined ? product : one);
    const PackVector<Real> a1 = f2 - scaled<Real>(s12 * s22 * inverse, f1);
    const PackVector<Real> a2 = f1 - scaled<Real>(s12 * s11 * inverse, f2);
    const PerCorner<Real> gradient{combination<Real>(q.q00, a1, q.q01, a2),
                                   combination<Real>(q.q10, a1, q.q11, a2)};
    if constexpr (form == StrainForm::angle) {
      const PackVector<Real> normal = cross(f1, f2);
      const Pack<Real> area = square_root(defined ? dot(normal, normal) : one);
      return {arc_tangent<Real>(s12, area) * area, one / area, gradient, defined};
    }
    return {s12, square_root(inverse), gradient, defined};
  }
}

// C = A / A0 - 1, ∇C along e2 × n and n × e1 with the unnormalised normal.
template <class Real>
BENDLAB_INLINE Term<Real, PerCorner<Real>> area(const Corners<Real>& t, const Pack<Real>& inverse_rest) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge(), normal = cross(e1, e2);
  const Pack<Real> one = broadcast<Real>(1), squared = dot(normal, normal);
  const auto defined = in_bounds<Real>(squared * inverse_rest * inverse_rest);
  const Pack<Real> twice_area = square_root(defined ? squared : one), scale = inverse_rest / twice_area;
  return {(twice_area * inverse_rest - one) * twice_area / inverse_rest,
          scale,
          {cross(e2, normal), cross(normal, e1)},
          defined};
}

// Lanes in which a term is to be corrected along the gradient of the rest shape, and by what: see ConstraintValue.
template <class Real>
struct Opening {
  PackMask<Real> lanes;
  Pack<Real> value;
};

template <class Real>
BENDLAB_INLINE PackMask<Real> collapsed(const Pack<Real>& squared) {
  return ~(squared > collapsed_ratio<Real> * collapsed_ratio<Real>);
}

template <class Real>
struct Stretch {
  Pack<Real> gb, gc;
  PackMask<Real> was_collapsed{};  // before the triangle's first term

  template <StrainForm form>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return stretch<Real, form>(t, gb, gc);
  }
  BENDLAB_INLINE PackMask<Real> has_collapsed(const Corners<Real>& t) const {
    const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
    return collapsed<Real>(dot(f, f));
  }
  // C = f·d - 1 with the rest direction d, whatever another term has made of f: d is f at rest, of length 1.
  template <StrainForm>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real>& t, const Corners<Real>& at_rest) const {
    const PackVector<Real> d = combination<Real>(gb, at_rest.first_edge(), gc, at_rest.second_edge());
    const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
    return {was_collapsed, dot(f, d) - broadcast<Real>(1)};
  }
  static constexpr bool opens_normalised = true;
};

template <class Real>
struct Shear {
  RestInverse<Real> q;

  template <StrainForm form>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return shear<Real, form>(t, q);
  }
  // Where warp and weft are parallel.
  template <StrainForm form>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real>& t, const Corners<Real>&) const {
    const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
    const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                           f2 = combination<Real>(q.q01, e1, q.q11, e2);
    const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), one = broadcast<Real>(1);
    const auto both = in_bounds<Real>(s11) & in_bounds<Real>(s22);
    const Pack<Real> s12 = both ? dot(f1, f2) : Pack<Real>{};
    if constexpr (form == StrainForm::green) {
      return {both, s12};
    } else if constexpr (form == StrainForm::normalised) {
      return {both, s12 / square_root(both ? s11 * s22 : one)};
    } else {
      const PackVector<Real> normal = cross(f1, f2);
      return {both, arc_tangent<Real>(s12, square_root(both ? dot(normal, normal) : one))};
    }
  }
  static constexpr bool opens_normalised = false;
};

template <class Real>
struct Area {
  Pack<Real> inverse_rest;

  template <StrainForm>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return area<Real>(t, inverse_rest);
  }
  template <StrainForm>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real>& t, const Corners<Real>&) const {
    const PackVector<Real> normal = cross(t.first_edge(), t.second_edge());
    return {collapsed<Real>(dot(normal, normal) * inverse_rest * inverse_rest), broadcast<Real>(-1)};
  }
  static constexpr bool opens_normalised = false;
};

// Gives the lanes without a direction that of their rest shape, and a gradient of 0 to those that have none there either.
template <class Real, StrainForm form, class TermOf, class Gradient>
BENDLAB_INLINE Term<Real, Gradient> opened(Term<Real, Gradient> term, const TermOf& of,
                                           const Corners<Real>& t, const StrainBatch<Real>& batch,
                                           std::size_t lane) {
  Corners<Real> at_rest{};
  if (batch.rest_points != nullptr)
    at_rest = {gather(batch.rest_points, &batch.a[lane]), gather(batch.rest_points, &batch.b[lane]),
               gather(batch.rest_points, &batch.c[lane])};
  const Term<Real, Gradient> rest =
      of.template term < TermOf::opens_normalised ? StrainForm::normalised : form > (at_rest);
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

  BENDLAB_INLINE TriangleLanes(const StrainBatch<Real>& strain, std::size_t first_lane)
      : batch(strain), lane(first_lane), q(strain, first_lane) {}

  // One projection of one term: PBD with the fraction k, or XPBD. `opens`: collapsed lanes take the gradient of their rest
  // shape; else `defined` says whether there are any.
  template <StrainForm form, bool compliant, bool opens, class TermOf>
  BENDLAB_INLINE void apply(Corners<Real>& t, const TermOf& of, Real k, const Pack<Real>& a,
                            std::size_t which) {
    auto term = of.template term<form>(t);
    if constexpr (opens)
      term = opened<Real, form>(term, of, t, batch, lane);
    else
      defined = defined & term.defined;
    const Pack<Real> zero{}, one = broadcast<Real>(1), weighted = term.gradient.weighted_square(t);
    const Pack<Real> sum = compliant ? term.scale * term.scale * weighted + a : weighted;
    const auto acts = term.defined & (sum > zero);
    const Pack<Real> divisor = acts ? sum : one;
    Pack<Real> change;  // along `gradient`
    if constexpr (compliant) {
      const Pack<Real> step = acts ? (-term.ratio * term.scale - a * multipliers[which]) / divisor : zero;
      multipliers[which] = multipliers[which] + step;
      change = term.scale * step;
    } else {
      change = acts ? -k * term.ratio / divisor : zero;
    }
    term.gradient.add(t, change, t);
  }

  template <StrainForm form, bool compliant, bool opens>
  BENDLAB_INLINE void project(Corners<Real>& t) {
    const Pack<Real> determinant = absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    Stretch<Real> warp{q.q00, q.q10}, weft{q.q01, q.q11};
    if constexpr (opens)
      warp.was_collapsed = warp.has_collapsed(t), weft.was_collapsed = weft.has_collapsed(t);
    if (batch.warp != 0) apply<form, compliant, opens>(t, warp, batch.warp, stretch_alpha, 0);
    if (batch.weft != 0) apply<form, compliant, opens>(t, weft, batch.weft, stretch_alpha, 1);
    if (batch.shear != 0) apply<form, compliant, opens>(t, Shear<Real>{q}, batch.shear, alpha, 2);
    if (batch.area != 0) apply<form, compliant, opens>(t, Area<Real>{determinant}, batch.area, alpha, 3);
  }
};

template <class Real, StrainForm form, bool compliant, bool opens>
BENDLAB_INLINE bool project_pack(Point<Real>* points, StrainBatch<Real>& batch, std::size_t lane,
                                 Real inverse_h2) {
  const std::size_t count = batch.order.constraint_of_lane.size();
  Corners<Real> t{gather(points, &batch.a[lane]), gather(points, &batch.b[lane]),
                  gather(points, &batch.c[lane])};
  TriangleLanes<Real> triangles(batch, lane);
  if constexpr (compliant) {  // α̃ = compliance / (A0 h²), A0 = 1 / (2 |det Q⁻¹|); four times that on S_ii - 1
    const RestInverse<Real>& q = triangles.q;
    triangles.alpha = inverse_h2 * absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
    triangles.stretch_alpha = form == StrainForm::green ? 4 * triangles.alpha : triangles.alpha;
    for (std::size_t m = 0; m < 4; ++m) triangles.multipliers[m] = load(&batch.multiplier[m * count + lane]);
  }
  triangles.template project<form, compliant, opens>(t);
  if constexpr (!opens)
    if (any(~triangles.defined)) [[unlikely]]
      return false;
  if constexpr (compliant)
    for (std::size_t m = 0; m < 4; ++m) store(&batch.multiplier[m * count + lane], triangles.multipliers[m]);
  scatter(points, &batch.a[lane], t.a);
  scatter(points, &batch.b[lane], t.b);
  scatter(points, &batch.c[lane], t.c);
  return true;
}

// Apart, so that what is rare takes no registers from what is not.
template <class Real, StrainForm form, bool compliant>
[[gnu::noinline]] void project_and_open(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first_lane,
                                        std::size_t last_lane, Real inverse_h2) {
  for (std::size_t lane = first_lane; lane < last_lane; lane += static_cast<std::size_t>(lanes<Real>))
    project_pack<Real, form, compliant, true>(points, batch, lane, inverse_h2);
}

template <class Real, StrainForm form, bool compliant>
void project_lanes(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
                   Real substep) {
  const Real inverse_h2 = compliant ? 2 * batch.compliance / (substep * substep) : Real(0);
  constexpr auto width = static_cast<std::size_t>(lanes<Real>);
  for (std::size_t lane = batch.order.runs[first]; lane < batch.order.runs[last]; lane += width)
    if (!project_pack<Real, form, compliant, false>(points, batch, lane, inverse_h2)) [[unlikely]]
      project_and_open<Real, form, compliant>(points, batch, lane, lane + width, inverse_h2);
}

// Velocities after one term is damped: Δv = -k Ċ / Σ w|∇C|² w ∇C.
template <class Real, class Gradient>
BENDLAB_INLINE void damp_term(const Corners<Real>& t, Corners<Real>& velocity, Term<Real, Gradient> term,
                              Real k) {
  if (any(~term.defined)) [[unlikely]]
    term.gradient = select(term.defined, term.gradient, Gradient{});
  const Pack<Real> zero{}, one = broadcast<Real>(1), sum = term.gradient.weighted_square(t);
  const auto acts = term.defined & (sum > zero);
  term.gradient.add(velocity, acts ? -k * term.gradient.rate(velocity) / (acts ? sum : one) : zero, t);
}

}  // namespace

// Backwards or not: the triangles of a run share no vertex, so their order does not matter.
template <class Real>
void project(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last, Real substep,
             bool) {
  const auto of_form = [&]<StrainForm form>(std::integral_constant<StrainForm, form>) {
    batch.kind == StiffnessKind::compliance
        ? project_lanes<Real, form, true>(points, batch, first, last, substep)
        : project_lanes<Real, form, false>(points, batch, first, last, substep);
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

template void project(Point<float>*, StrainBatch<float>&, std::size_t, std::size_t, float, bool);
template void project(Point<double>*, StrainBatch<double>&, std::size_t, std::size_t, double, bool);
template void damp(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);

}  // namespace bendlab
