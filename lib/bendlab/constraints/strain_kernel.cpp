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
  return {select(mask, a.direction, b.direction), mask ? a.squared : b.squared, a.gb, a.gc};
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
  if constexpr (form != StrainForm::green) {  // C = l - 1, ∇C = f / l
    const Pack<Real> length = square_root(defined ? squared : one);
    return {squared - length, one / length, {f, squared, gb, gc}, defined};
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
  if constexpr (form == StrainForm::green) {
    return {s12,
            one,
            {combination<Real>(q.q00, f2, q.q01, f1), combination<Real>(q.q10, f2, q.q11, f1)},
            in_bounds<Real>(s11 + s22)};
  } else {
    const Pack<Real> product = s11 * s22, not_parallel = product - s12 * s12;  // (l1 l2 sin)²
    const auto defined = in_bounds<Real>(s11) & in_bounds<Real>(s22) &
                         (not_parallel > broadcast<Real>(parallel_sine_squared<Real>) * product);
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

// What a term says of a triangle that has collapsed for it, and 0 elsewhere: see ConstraintValue.
template <class Real>
BENDLAB_INLINE Pack<Real> minus_one_below(const Pack<Real>& squared) {
  constexpr Real least = collapsed_ratio<Real> * collapsed_ratio<Real>;
  return squared > least ? Pack<Real>{} : broadcast<Real>(-1);
}

template <class Real>
struct Stretch {
  const Pack<Real>&gb, &gc;

  template <StrainForm form>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return stretch<Real, form>(t, gb, gc);
  }
  template <StrainForm>
  BENDLAB_INLINE Pack<Real> when_collapsed(const Corners<Real>& t) const {
    const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
    return minus_one_below<Real>(dot(f, f));
  }
};

template <class Real>
struct Shear {
  const RestInverse<Real>& q;

  template <StrainForm form>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return shear<Real, form>(t, q);
  }
  template <StrainForm form>
  BENDLAB_INLINE Pack<Real> when_collapsed(const Corners<Real>& t) const {
    if constexpr (form == StrainForm::green) return Pack<Real>{};
    const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
    const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                           f2 = combination<Real>(q.q01, e1, q.q11, e2);
    const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), one = broadcast<Real>(1);
    const auto both = in_bounds<Real>(s11) & in_bounds<Real>(s22);
    const Pack<Real> cosine = (both ? dot(f1, f2) : Pack<Real>{}) / square_root(both ? s11 * s22 : one);
    if constexpr (form == StrainForm::normalised) return cosine;
    const PackVector<Real> normal = cross(f1, f2);
    return both ? arc_tangent<Real>(dot(f1, f2), square_root(both ? dot(normal, normal) : one)) : Pack<Real>{};
  }
};

template <class Real>
struct Area {
  Pack<Real> inverse_rest;

  template <StrainForm>
  BENDLAB_INLINE auto term(const Corners<Real>& t) const {
    return area<Real>(t, inverse_rest);
  }
  template <StrainForm>
  BENDLAB_INLINE Pack<Real> when_collapsed(const Corners<Real>& t) const {
    const PackVector<Real> normal = cross(t.first_edge(), t.second_edge());
    return minus_one_below<Real>(dot(normal, normal) * inverse_rest * inverse_rest);
  }
};

// Gives the lanes without a direction that of their rest shape, and a gradient of 0 to those that have none there either.
template <class Real, StrainForm form, class TermOf, class Gradient>
BENDLAB_INLINE Term<Real, Gradient> opened(Term<Real, Gradient> term, const TermOf& of, const Corners<Real>& t,
                                           const Point<Real>* rest_points, const StrainBatch<Real>& batch,
                                           std::size_t lane) {
  const Pack<Real> zero{};
  Corners<Real> at_rest{};
  if (rest_points != nullptr)
    at_rest = {gather(rest_points, &batch.a[lane]), gather(rest_points, &batch.b[lane]),
               gather(rest_points, &batch.c[lane])};
  const Term<Real, Gradient> rest = of.template term<form>(at_rest);
  const Pack<Real> value = of.template when_collapsed<form>(t);
  const PackMask<Real> opens = ~term.defined & rest.defined & (value != zero);
  term.gradient = select(term.defined, term.gradient, select(opens, rest.gradient, Gradient{}));
  term.ratio = opens ? value / rest.scale : term.ratio;
  term.scale = opens ? rest.scale : term.scale;
  term.defined = term.defined | opens;
  return term;
}

// One projection of one term: PBD with the fraction k, or XPBD with α̃ and the multipliers of these lanes.
template <class Real, StrainForm form, bool compliant, class TermOf>
BENDLAB_INLINE void apply(Corners<Real>& t, const TermOf& of, const StrainBatch<Real>& batch, std::size_t lane, Real k,
                          const Pack<Real>& alpha, Real* multipliers) {
  auto term = of.template term<form>(t);
  if (any(~term.defined)) [[unlikely]]
    term = opened<Real, form>(term, of, t, batch.rest_points, batch, lane);
  const Pack<Real> zero{}, one = broadcast<Real>(1), weighted = term.gradient.weighted_square(t);
  const Pack<Real> sum = compliant ? term.scale * term.scale * weighted + alpha : weighted;
  const auto acts = term.defined & (sum > zero);
  const Pack<Real> divisor = acts ? sum : one;
  Pack<Real> change;  // along `gradient`
  if constexpr (compliant) {
    const Pack<Real> multiplier = load(multipliers);
    const Pack<Real> step = acts ? (-term.ratio * term.scale - alpha * multiplier) / divisor : zero;
    store(multipliers, multiplier + step);
    change = term.scale * step;
  } else {
    change = acts ? -k * term.ratio / divisor : zero;
  }
  term.gradient.add(t, change, t);
}

template <class Real, StrainForm form, bool compliant>
void project_lanes(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
                   Real substep) {
  const std::size_t count = batch.order.constraint_of_lane.size();
  const Real inverse_h2 = compliant ? 2 * batch.compliance / (substep * substep) : Real(0);
  Real* const multiplier = batch.multiplier.data();
  for (std::size_t lane = batch.order.runs[first]; lane < batch.order.runs[last];
       lane += static_cast<std::size_t>(lanes<Real>)) {
    Corners<Real> t{gather(points, &batch.a[lane]), gather(points, &batch.b[lane]),
                    gather(points, &batch.c[lane])};
    const RestInverse<Real> q(batch, lane);
    Pack<Real> alpha{}, stretch_alpha{};
    if constexpr (compliant) {  // α̃ = compliance / (A0 h²), A0 = 1 / (2 |det Q⁻¹|); four times that on S_ii -
                                // 1
      alpha = inverse_h2 * absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10);
      stretch_alpha = form == StrainForm::green ? 4 * alpha : alpha;
    }
    if (batch.warp != 0)
      apply<Real, form, compliant>(t, Stretch<Real>{q.q00, q.q10}, batch, lane, batch.warp, stretch_alpha,
                                   multiplier + lane);
    if (batch.weft != 0)
      apply<Real, form, compliant>(t, Stretch<Real>{q.q01, q.q11}, batch, lane, batch.weft, stretch_alpha,
                                   multiplier + count + lane);
    if (batch.shear != 0)
      apply<Real, form, compliant>(t, Shear<Real>{q}, batch, lane, batch.shear, alpha,
                                   multiplier + 2 * count + lane);
    if (batch.area != 0)
      apply<Real, form, compliant>(t, Area<Real>{absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10)}, batch, lane,
                                   batch.area, alpha, multiplier + 3 * count + lane);
    scatter(points, &batch.a[lane], t.a);
    scatter(points, &batch.b[lane], t.b);
    scatter(points, &batch.c[lane], t.c);
  }
}

// Velocities after one term is damped: Δv = -k Ċ / Σ w|∇C|² w ∇C.
template <class Real, class Gradient>
BENDLAB_INLINE void damp_term(const Corners<Real>& t, Corners<Real>& velocity,
                              Term<Real, Gradient> term, Real k) {
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
