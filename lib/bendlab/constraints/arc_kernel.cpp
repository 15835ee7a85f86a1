// A lane (an entry of a vector register) holds one segment of ArcSpring (arc_spring.hpp).
//
//     .-'''-.         p[0], p[1]   vertices a and b: packs of x, y, z and of w = 1/m
//    /       \        rest[0]      L, m
//   a----r----b       r = |p[0] - p[1]|, ρ = r/L, y = κL/2 with r/L = sinc y
#include "bendlab/constraints/arc_spring.hpp"
#include "bendlab/constraints/element_kernel.hpp"
#include "bendlab/constraints/pack_math.hpp"

namespace bendlab {

template <class Real, ArcSpring::Law law>
struct PackKernel<Real, ArcSpring, law> : ElasticKernel<Real, ArcSpring> {
  using P = Pack<Real>;
  using Corners = std::array<PackPoints<Real>, 2>;
  using Rest = std::array<P, 1>;

  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const P& squared, const Rest& rest) {
    return squared > rest[0] * rest[0];
  }

  BENDLAB_INLINE static P rest_size_squared(const Rest& rest) { return rest[0] * rest[0]; }

  BENDLAB_INLINE static PackMask<Real> resists(const P& value) { return value < P{}; }

  BENDLAB_INLINE static PackConstraint<Real, 2> evaluate(const Corners& p, const Rest& rest) {
    const PackVector<Real> d = p[0].position - p[1].position;
    const P squared = dot(d, d), shortest = collapsed_ratio<Real> * rest[0];
    PackConstraint<Real, 2> result;
    result.defined = squared > shortest * shortest;
    const P per_length = inverse_square_root(result.defined ? squared : broadcast<Real>(1));
    result.value = squared * per_length - rest[0];
    result.gradient = {scaled<Real>(per_length, d), scaled<Real>(-per_length, d)};
    return result;
  }

  BENDLAB_INLINE static P when_collapsed(const Corners& p, const Rest& rest) {
    const PackVector<Real> d = p[0].position - p[1].position;
    const P shortest = collapsed_ratio<Real> * rest[0];
    return dot(d, d) > shortest * shortest ? P{} : -rest[0];
  }

  // The push p = P L²/k_b of a segment at ρ = r/L, and the slope dp/dρ.
  struct Bent {
    P ratio, push, slope;
  };

  // ArcSpring::change() for all lanes. In units of L (lengths) and k_b/L² (pushes), the new ρ solves
  //
  //     load - yielding (1 - ρ) = p(ρ)
  //
  // `load` is the push that would hold the segment straight, and `yielding` is the decrease of that push if
  // the segment shortens by L. For a segment that does not buckle the equation may have no solution. The lane
  // of such a segment uses twice the largest load of a straight segment, and its result is not used.
  BENDLAB_INLINE static P change(const P& value, const Rest& rest, const P& w, const P& alpha,
                                 const P& multiplier) {
    const P length = rest[0], per_both = 1 / (length * w), per_w = length * per_both;
    const P straight = multiplier - value * per_w, to_push = alpha * length * length;
    P limit;  // the largest load that leaves a segment straight
    if constexpr (law == ArcSpring::Law::exact)
      limit = broadcast<Real>(12);
    else
      limit = quartic_at(broadcast<Real>(1)).push;
    const P whole_load = to_push * straight;
    const auto buckles = whole_load > limit;
    const P load = buckles ? whole_load : 2 * limit, yielding = to_push * length * per_w,
            shortened = -value * per_both * w;
    Bent bent;
    if constexpr (law == ArcSpring::Law::exact)
      bent = arc(load, yielding);
    else
      bent = quartic(load, yielding);
    // The last step of Newton's method solves for ρ: it is exact to rounding for every `yielding`.
    const P held = to_push * multiplier;
    const P step = (bent.push - held + bent.slope * (1 - bent.ratio - shortened)) / (yielding - bent.slope);
    const P buckled = buckles ? step * length * per_w : -value * per_w;
    return straight < P{} ? -multiplier : buckled;
  }

 private:
  // The coefficients of the polynomial law or of its derivative, by ascending powers. A loop computes the
  // coefficients, because GCC 12 computes wrong numbers from a list of casts under -frounding-math.
  template <bool derivative>
  static constexpr auto series = [] {
    std::array<Real, ArcSpring::polynomial.size() - derivative> coefficients{};
    for (std::size_t n = 0; n < coefficients.size(); ++n)
      coefficients[n] = static_cast<Real>((derivative ? static_cast<double>(n + 1) : 1) *
                                          ArcSpring::polynomial[n + derivative]);
    return coefficients;
  }();

  BENDLAB_INLINE static Bent quartic_at(const P& ratio) {
    return {ratio, detail::polynomial(series<false>, ratio), detail::polynomial(series<true>, ratio)};
  }

  // The zero of the hyperbola with the values `at_0` at 0 and `at_1` at 1, and the slope `slope_at_0` at 0.
  BENDLAB_INLINE static P first_guess(const P& at_0, const P& slope_at_0, const P& at_1) {
    return at_0 / (at_0 + slope_at_0 * (at_1 / (at_0 - at_1)));
  }

  BENDLAB_INLINE static P clamped(const P& x, Real highest) {
    const P low = x > P{} ? x : P{};
    return low < highest ? low : broadcast(highest);
  }

  // With z = y²: ρ = 3e - z f and p = 4/e, where e = j1(y)/y and f = j2(y)/y². The derivatives by z are -f/2
  // for e and -e/2 for ρ. Multiplied by e, the equation of change() is G(z) = e (load - yielding (1 - ρ)) - 4
  // = 0. G decreases and is convex up to its root, so Newton's method does not diverge. After `steps` the
  // error of z is 10⁻³ (float) or 10⁻⁷ (double). The last step in change() squares the error.
  BENDLAB_INLINE static Bent arc(const P& load, const P& yielding) {
    constexpr int steps = sizeof(Real) == 4 ? 3 : 4;
    constexpr auto closed = static_cast<Real>(9.869604401089358);  // z = π² at y = π
    P z = closed * clamped(first_guess(load / 3 - 4, -closed * (load / 30 + yielding / 18),
                                       (load - yielding) / closed - 4),
                           1);
    P e = bessel_1<Real>(z), f = bessel_2<Real>(z);
    for (int step = 0; step < steps; ++step) {
      const P force = load - yielding * (1 - 3 * e + z * f);
      z = clamped(z + 2 * (e * force - 4) / (f * force + yielding * e * e), closed);
      e = bessel_1<Real>(z), f = bessel_2<Real>(z);
    }
    const P per_e = 1 / e;
    return {3 * e - z * f, 4 * per_e, -4 * f * per_e * per_e * per_e};
  }

  // The push under the polynomial law, for which p is convex in ρ. The first guess uses the slope at ρ = 1.
  BENDLAB_INLINE static Bent quartic(const P& load, const P& yielding) {
    constexpr int steps = sizeof(Real) == 4 ? 2 : 3;
    const Bent straight = quartic_at(broadcast<Real>(1));
    const P guess =
        first_guess(load - straight.push, straight.slope - yielding, load - yielding - series<false>[0]);
    Bent bent = quartic_at(1 - clamped(guess, 1));
    for (int step = 0; step < steps; ++step) {
      const P left = bent.push - load + yielding * (1 - bent.ratio);
      bent = quartic_at(clamped(bent.ratio + left / (yielding - bent.slope), 1));
    }
    return bent;
  }
};

BENDLAB_ELEMENT_KERNELS(ArcSpring);

}  // namespace bendlab
