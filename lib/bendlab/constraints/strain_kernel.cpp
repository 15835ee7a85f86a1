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
  decltype(Pack<Real>{} > Pack<Real>{}) defined;
};

template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, Scaled<Real>> stretch(const Corners<Real>& t, const Pack<Real>& gb,
                                                const Pack<Real>& gc) {
  const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
  const Pack<Real> one = broadcast<Real>(1), squared = dot(f, f),
                   shortest = broadcast<Real>(collapsed_ratio<Real>);
  const auto defined = squared > shortest * shortest;
  if constexpr (form == StrainForm::normalised) {  // C = l - 1, ∇C = f / l
    const Pack<Real> length = square_root(squared);
    return {squared - length, one / (defined ? length : one), {f, squared, gb, gc}, defined};
  } else {
    return {squared - one, one, {f, squared, gb + gb, gc + gc}, defined};
  }
}

// Normalised: C = cos = f1·f2 / (l1 l2), ∇C along a1 = (f2 - f1·f2 / l1² f1) / (l1 l2) and a2 likewise.
template <class Real, StrainForm form>
BENDLAB_INLINE Term<Real, PerCorner<Real>> shear(const Corners<Real>& t, const RestInverse<Real>& q) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
  const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                         f2 = combination<Real>(q.q01, e1, q.q11, e2);
  const Pack<Real> one = broadcast<Real>(1), collapsed = broadcast<Real>(collapsed_ratio<Real>);
  const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), s12 = dot(f1, f2);
  if constexpr (form == StrainForm::green) {
    return {s12,
            one,
            {combination<Real>(q.q00, f2, q.q01, f1), combination<Real>(q.q10, f2, q.q11, f1)},
            s11 + s22 > collapsed * collapsed};
  } else {
    const Pack<Real> product = s11 * s22, not_parallel = product - s12 * s12;  // (l1 l2 sin)²
    const auto defined = (s11 > collapsed * collapsed) & (s22 > collapsed * collapsed) &
                         (not_parallel > broadcast<Real>(parallel_sine_squared<Real>) * product);
    const Pack<Real> inverse = one / (defined ? product : one);
    const PackVector<Real> a1 = f2 - scaled<Real>(s12 * s22 * inverse, f1);
    const PackVector<Real> a2 = f1 - scaled<Real>(s12 * s11 * inverse, f2);
    return {s12,
            square_root(inverse),
            {combination<Real>(q.q00, a1, q.q01, a2), combination<Real>(q.q10, a1, q.q11, a2)},
            defined};
  }
}

// C = A / A0 - 1, ∇C along e2 × n and n × e1 with the unnormalised normal.
template <class Real>
BENDLAB_INLINE Term<Real, PerCorner<Real>> area(const Corners<Real>& t, const Pack<Real>& inverse_rest) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge(), normal = cross(e1, e2);
  const Pack<Real> one = broadcast<Real>(1), twice_area = square_root(dot(normal, normal));
  const auto defined = twice_area * inverse_rest > broadcast<Real>(collapsed_ratio<Real>);
  const Pack<Real> scale = inverse_rest / (defined ? twice_area : one);
  return {(twice_area * inverse_rest - one) * twice_area / inverse_rest,
          scale,
          {cross(e2, normal), cross(normal, e1)},
          defined};
}

// One projection of one term: PBD with the fraction k, or XPBD with α̃ and the multipliers of these lanes.
template <class Real, bool compliant, class Gradient>
BENDLAB_INLINE void apply(Corners<Real>& t, const Term<Real, Gradient>& term, Real k, const Pack<Real>& alpha,
                          Real* multipliers) {
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

// Backwards or not: the triangles of a run share no vertex, so their order does not matter.
template <class Real>
void project(Point<Real>* points, StrainBatch<Real>& batch, std::size_t first, std::size_t last, Real substep,
             bool) {
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

template void project(Point<float>*, StrainBatch<float>&, std::size_t, std::size_t, float, bool);
template void project(Point<double>*, StrainBatch<double>&, std::size_t, std::size_t, double, bool);
template void damp(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);

}  // namespace bendlab
