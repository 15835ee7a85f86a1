// What lies in a lane: one segment of ArcSpring (arc_spring.hpp).
//
//     .-'''-.         p[0], p[1]   vertices a and b: packs of x, y, z and of w = 1/m
//    /       \        rest[0]      L, m
//   a----r----b       r = |p[0] - p[1]|, ρ = r/L, y = κL/2 with r/L = sinc y
#include "bendlab/constraints/arc_spring.hpp"
#include "bendlab/constraints/element_kernel.hpp"
#include "bendlab/constraints/pack_math.hpp"

namespace bendlab {
template <>
struct PackKernel<ArcSpring> {
  using Law = ArcSpring::Law;
  using Laws = LawList<Law::exact, Law::polynomial>;

  template <class Real>
  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const Pack<Real>& squared,
                                                         const std::array<Pack<Real>, 1>& rest) {
    return squared > rest[0] * rest[0];
  }

  template <class Real>
  BENDLAB_INLINE static Pack<Real> rest_size_squared(const std::array<Pack<Real>, 1>& rest) {
    return rest[0] * rest[0];
  }

  template <class Real, Law law>
  BENDLAB_INLINE static PackConstraint<Real, 2> evaluate(const std::array<PackPoints<Real>, 2>& p,
                                                         const std::array<Pack<Real>, 1>& rest,
                                                         std::integral_constant<Law, law>) {
    using P = Pack<Real>;
    const PackVector<Real> d = p[0].position - p[1].position;
    const P squared = dot(d, d), shortest = collapsed_ratio<Real> * rest[0];
    PackConstraint<Real, 2> result;
    result.defined = squared > shortest * shortest;
    const P per_length = inverse_square_root(result.defined ? squared : broadcast<Real>(1));
    result.value = squared * per_length - rest[0];
    result.gradient = {scaled<Real>(per_length, d), scaled<Real>(-per_length, d)};
    return result;
  }

  template <class Real, Law law>
  BENDLAB_INLINE static Pack<Real> when_collapsed(const std::array<PackPoints<Real>, 2>& p,
                                                  const std::array<Pack<Real>, 1>& rest,
                                                  std::integral_constant<Law, law>) {
    const PackVector<Real> d = p[0].position - p[1].position;
    const Pack<Real> shortest = collapsed_ratio<Real> * rest[0];
    return dot(d, d) > shortest * shortest ? Pack<Real>{} : -rest[0];
  }

  // A segment at ρ = r/L: its push p = P L²/k_b, and the slope dp/dρ.
  template <class Real>
  struct Bent {
    Pack<Real> ratio, push, slope;
  };

  // The lanes' ArcSpring::change(). In units of L and k_b/L² the new ρ solves
  //
  //     load - yielding (1 - ρ) = p(ρ)
  //
  // `load` is the push that would hold the segment straight, and `yielding` is the decrease of that push if
  // the segment shortens by L. Lanes that need no solution compute one with a load that has a solution.
  template <class Real, Law law>
  BENDLAB_INLINE static Pack<Real> change(const Pack<Real>& value, const std::array<Pack<Real>, 1>& rest,
                                          std::integral_constant<Law, law>, const Pack<Real>& w,
                                          const Pack<Real>& alpha, const Pack<Real>& multiplier) {
    using P = Pack<Real>;
    const P length = rest[0], per_both = 1 / (length * w), per_w = length * per_both;
    const P straight = multiplier - value * per_w, to_push = alpha * length * length;
    P limit;  // the largest load that leaves a segment straight
    if constexpr (law == Law::exact)
      limit = broadcast<Real>(12);
    else
      limit = quartic_at<Real>(broadcast<Real>(1)).push;
    const P whole_load = to_push * straight;
    const auto buckles = whole_load > limit;
    const P load = buckles ? whole_load : 2 * limit, yielding = to_push * length * per_w,
            shortened = -value * per_both * w;
    Bent<Real> bent;
    if constexpr (law == Law::exact)
      bent = arc<Real>(load, yielding);
    else
      bent = quartic<Real>(load, yielding);
    // The last step is taken in ρ: it is exact to rounding, whether the push changes the length much or
    // little.
    const P held = to_push * multiplier;
    const P step = (bent.push - held + bent.slope * (1 - bent.ratio - shortened)) / (yielding - bent.slope);
    const P buckled = buckles ? step * length * per_w : -value * per_w;
    return straight < P{} ? -multiplier : buckled;
  }

 private:
  // The polynomial law or its derivative, by ascending powers. Computed element by element, because GCC 12
  // computes wrong numbers from a list of casts under -frounding-math.
  template <class Real, bool derivative>
  static constexpr auto series = [] {
    std::array<Real, ArcSpring::polynomial.size() - derivative> coefficients{};
    for (std::size_t n = 0; n < coefficients.size(); ++n)
      coefficients[n] = static_cast<Real>((derivative ? static_cast<double>(n + 1) : 1) *
                                          ArcSpring::polynomial[n + derivative]);
    return coefficients;
  }();

  template <class Real>
  BENDLAB_INLINE static Bent<Real> quartic_at(const Pack<Real>& ratio) {
    return {ratio, detail::polynomial(series<Real, false>, ratio),
            detail::polynomial(series<Real, true>, ratio)};
  }

  // Fraction of an interval at which a hyperbola is 0 that has the values of both ends and the first end's
  // slope.
  template <class Real>
  BENDLAB_INLINE static Pack<Real> first_guess(const Pack<Real>& at_0, const Pack<Real>& slope_at_0,
                                               const Pack<Real>& at_1) {
    return at_0 / (at_0 + slope_at_0 * (at_1 / (at_0 - at_1)));
  }

  template <class Real>
  BENDLAB_INLINE static Pack<Real> clamped(const Pack<Real>& x, Real highest) {
    const Pack<Real> low = x > Pack<Real>{} ? x : Pack<Real>{};
    return low < highest ? low : broadcast(highest);
  }

  // In z = y²: ρ = 3e - z f and p = 4/e with e = j1(y)/y, f = j2(y)/y², e' = -f/2 and ρ' = -e/2. Times e, the
  // equation reads G(z) = e (load - yielding (1 - ρ)) - 4 = 0. G falls and is convex up to its root, so
  // Newton's method does not diverge. After these steps the error of z is 10⁻³ (float) and 10⁻⁷ (double); the
  // last step in change() squares it.
  template <class Real>
  BENDLAB_INLINE static Bent<Real> arc(const Pack<Real>& load, const Pack<Real>& yielding) {
    using P = Pack<Real>;
    constexpr int steps = sizeof(Real) == 4 ? 3 : 4;
    constexpr auto closed = static_cast<Real>(9.869604401089358);  // z = π² at y = π
    P z = closed * clamped<Real>(first_guess<Real>(load / 3 - 4, -closed * (load / 30 + yielding / 18),
                                                   (load - yielding) / closed - 4),
                                 1);
    P e = bessel_1<Real>(z), f = bessel_2<Real>(z);
    for (int step = 0; step < steps; ++step) {
      const P force = load - yielding * (1 - 3 * e + z * f);
      z = clamped<Real>(z + 2 * (e * force - 4) / (f * force + yielding * e * e), closed);
      e = bessel_1<Real>(z), f = bessel_2<Real>(z);
    }
    const P per_e = 1 / e;
    return {3 * e - z * f, 4 * per_e, -4 * f * per_e * per_e * per_e};
  }

  // The same with the polynomial law: p is convex in ρ, and the steps start at 1 - ρ = 0.
  template <class Real>
  BENDLAB_INLINE static Bent<Real> quartic(const Pack<Real>& load, const Pack<Real>& yielding) {
    using P = Pack<Real>;
    constexpr int steps = sizeof(Real) == 4 ? 2 : 3;
    const Bent<Real> straight = quartic_at<Real>(broadcast<Real>(1));
    const P guess = first_guess<Real>(load - straight.push, straight.slope - yielding,
                                      load - yielding - series<Real, false>[0]);
    Bent<Real> bent = quartic_at<Real>(1 - clamped<Real>(guess, 1));
    for (int step = 0; step < steps; ++step) {
      const P left = bent.push - load + yielding * (1 - bent.ratio);
      bent = quartic_at<Real>(clamped<Real>(bent.ratio + left / (yielding - bent.slope), 1));
    }
    return bent;
  }
};

BENDLAB_ELEMENT_KERNELS(ArcSpring);

}  // namespace bendlab
