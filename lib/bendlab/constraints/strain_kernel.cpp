#include "bendlab/constraints/kernels.hpp"

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
  Pack<Real> gb, gc;
  BENDLAB_INLINE Pack<Real> weighted_square(const Corners<Real>& t) const {
    const Pack<Real> ga = gb + gc;
    return (t.a.w * ga * ga + t.b.w * gb * gb + t.c.w * gc * gc) * dot(direction, direction);
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

// Value and gradient of one term; `defined` is a lane mask.
template <class Real, class Gradient>
struct Term {
  Pack<Real> value;
  Gradient gradient;
  decltype(Pack<Real>{} > Pack<Real>{}) defined;
};

template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, Scaled<Real>> stretch(const Corners<Real>& t, const Pack<Real>& gb,
                                                const Pack<Real>& gc) {
  const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
  const Pack<Real> one = broadcast<Real>(1), squared = dot(f, f), length = square_root(squared);
  const auto defined = length > broadcast<Real>(collapsed_ratio<Real>);
  if constexpr (form == StrainForm::normalised) {
    const Pack<Real> inverse = one / (defined ? length : one);
    return {length - one, {scaled<Real>(inverse, f), gb, gc}, defined};
  } else {
    return {squared - one, {f, gb + gb, gc + gc}, defined};
  }
}

template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, PerCorner<Real>> shear(const Corners<Real>& t, const RestInverse<Real>& q) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
  const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                         f2 = combination<Real>(q.q01, e1, q.q11, e2);
  const Pack<Real> one = broadcast<Real>(1), collapsed = broadcast<Real>(collapsed_ratio<Real>);
  const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), s12 = dot(f1, f2);
  if constexpr (form == StrainForm::green) {
    return {s12,
            {combination<Real>(q.q00, f2, q.q01, f1), combination<Real>(q.q10, f2, q.q11, f1)},
            s11 + s22 > collapsed * collapsed};
  } else {
    const auto long_enough = (s11 > collapsed * collapsed) & (s22 > collapsed * collapsed);
    const Pack<Real> i1 = one / square_root(long_enough ? s11 : one),
                     i2 = one / square_root(long_enough ? s22 : one);
    const PackVector<Real> n1 = scaled<Real>(i1, f1), n2 = scaled<Real>(i2, f2);
    const Pack<Real> cosine = dot(n1, n2);
    const PackVector<Real> a1 = scaled<Real>(i1, n2 - scaled<Real>(cosine, n1));
    const PackVector<Real> a2 = scaled<Real>(i2, n1 - scaled<Real>(cosine, n2));
    return {cosine,
            {combination<Real>(q.q00, a1, q.q01, a2), combination<Real>(q.q10, a1, q.q11, a2)},
            long_enough & (one - cosine * cosine > broadcast<Real>(parallel_sine_squared<Real>))};
  }
}

template <class Real>
BENDLAB_INLINE Term<Real, PerCorner<Real>> area(const Corners<Real>& t, const Pack<Real>& inverse_rest) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge(), normal = cross(e1, e2);
  const Pack<Real> one = broadcast<Real>(1), twice_area = square_root(dot(normal, normal));
  const auto defined = twice_area * inverse_rest > broadcast<Real>(collapsed_ratio<Real>);
  const PackVector<Real> n = scaled<Real>(one / (defined ? twice_area : one), normal);
  return {twice_area * inverse_rest - one,
          {scaled<Real>(inverse_rest, cross(e2, n)), scaled<Real>(inverse_rest, cross(n, e1))},
          defined};
}

// One projection of one term: PBD with the fraction k, or XPBD with α̃ and the multipliers of these lanes.
template <class Real, bool compliant, class Gradient>
BENDLAB_INLINE void apply(Corners<Real>& t, const Term<Real, Gradient>& term, Real k, const Pack<Real>& alpha,
                          Real* multipliers) {
  const Pack<Real> zero{}, one = broadcast<Real>(1);
  const Pack<Real> sum =
      compliant ? term.gradient.weighted_square(t) + alpha : term.gradient.weighted_square(t);
  const auto acts = term.defined & (sum > zero);
  const Pack<Real> divisor = acts ? sum : one;
  Pack<Real> change;
  if constexpr (compliant) {
    const Pack<Real> multiplier = load(multipliers);
    change = acts ? (-term.value - alpha * multiplier) / divisor : zero;
    store(multipliers, multiplier + change);
  } else {
    change = acts ? -k * term.value / divisor : zero;
  }
  term.gradient.add(t, change, t);
}

template <class Real, StrainForm form, bool compliant>
void project_lanes(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
                   Real substep) {
  const std::size_t count = batch.order.constraint_of_lane.size();
  const Real inverse_h2 = compliant ? 2 * batch.compliance / (substep * substep) : Real(0);
  Real* const multiplier = batch.multiplier.data();
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>)) {
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
      apply<Real, compliant>(t, stretch<Real, form>(t, q.q00, q.q10), batch.warp, stretch_alpha,
                             multiplier + lane);
    if (batch.weft != 0)
      apply<Real, compliant>(t, stretch<Real, form>(t, q.q01, q.q11), batch.weft, stretch_alpha,
                             multiplier + count + lane);
    if (batch.shear != 0)
      apply<Real, compliant>(t, shear<Real, form>(t, q), batch.shear, alpha, multiplier + 2 * count + lane);
    if (batch.area != 0)
      apply<Real, compliant>(t, area<Real>(t, absolute<Real>(q.q00 * q.q11 - q.q01 * q.q10)), batch.area,
                             alpha, multiplier + 3 * count + lane);
    scatter(points, &batch.a[lane], t.a);
    scatter(points, &batch.b[lane], t.b);
    scatter(points, &batch.c[lane], t.c);
  }
}

// Velocities after one term is damped: Δv = -k Ċ / Σ w|∇C|² w ∇C.
template <class Real, class Gradient>
BENDLAB_INLINE void damp_term(const Corners<Real>& t, Corners<Real>& velocity,
                              const Term<Real, Gradient>& term, Real k) {
  const Pack<Real> zero{}, one = broadcast<Real>(1), sum = term.gradient.weighted_square(t);
  const auto acts = term.defined & (sum > zero);
  term.gradient.add(velocity, acts ? -k * term.gradient.rate(velocity) / (acts ? sum : one) : zero, t);
}

}  // namespace

template <class Real>
void project(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last,
             Real substep) {
  const bool green = batch.form == StrainForm::green;
  if (batch.kind == StiffnessKind::compliance)
    green ? project_lanes<Real, StrainForm::green, true>(points, batch, first, last, substep)
          : project_lanes<Real, StrainForm::normalised, true>(points, batch, first, last, substep);
  else
    green ? project_lanes<Real, StrainForm::green, false>(points, batch, first, last, substep)
          : project_lanes<Real, StrainForm::normalised, false>(points, batch, first, last, substep);
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

template void project(Point<float>*, StrainBatch<float>&, std::size_t, std::size_t, float);
template void project(Point<double>*, StrainBatch<double>&, std::size_t, std::size_t, double);
template void damp(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);

}  // namespace bendlab
