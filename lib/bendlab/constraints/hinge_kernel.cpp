// A lane (an entry of a vector register) holds one hinge.
//
//       p2            p[0] … p[3]   its corners: packs of x, y, z and of w = 1/m
//      /  \           rest[0]       θ0
//    p0 -- p1         rest[1]       1 / rest length of the edge, 1/m
//      \  /           rest[2], [3]  sin(θ0/2), cos(θ0/2)
//       p3
//
// Symbols and order are as in the oracle (the scalar code), hinge_angle() in hinge_angle.hpp.
#include "bendlab/constraints/element_kernel.hpp"
#include "bendlab/constraints/hinge_angle.hpp"
#include "bendlab/constraints/pack_turn.hpp"
#include "bendlab/constraints/sine_projection.hpp"

namespace bendlab {

template <class Real, HingeAngle::Law law>
struct PackKernel<Real, HingeAngle, law> : ElasticKernel<Real, HingeAngle> {
  using P = Pack<Real>;
  using Rest = std::array<P, 4>;

  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const P& squared, const Rest& rest) {
    return squared * rest[1] * rest[1] > broadcast<Real>(1);
  }

  BENDLAB_INLINE static PackMask<Real> resists(const P& value) {
    constexpr Real most =
        law == HingeAngle::Law::sine ? Real(largest_sine) : std::numeric_limits<Real>::infinity();
    return (value < P{} ? -value : value) < broadcast<Real>(most);
  }

  BENDLAB_INLINE static P rest_size_squared(const Rest& rest) { return 1 / (rest[1] * rest[1]); }

  BENDLAB_INLINE static PackConstraint<Real, 4> evaluate(const std::array<PackPoints<Real>, 4>& p,
                                                         const Rest& rest) {
    const P one = broadcast<Real>(1), per_length = rest[1];
    const auto difference = [&](std::size_t to, std::size_t from) {
      return scaled<Real>(per_length, p[to].position - p[from].position);
    };
    const PackVector<Real> e = difference(1, 0), a = difference(2, 0), b = difference(2, 1),
                           c = difference(3, 1), d = difference(3, 0);
    const PackVector<Real> n1 = cross(a, b), n2 = cross(c, d);
    const P squared = dot(e, e), s1 = dot(n1, n1), s2 = dot(n2, n2);
    const P least = broadcast(collapsed_ratio<Real> * collapsed_ratio<Real>);
    PackConstraint<Real, 4> result;
    const P product = s1 * s2;
    result.defined = (squared > least) & (s1 > least) & (s2 > least) &
                     (product < overgrown_square<Real> * overgrown_square<Real>);
    const P per_edge = inverse_square_root(result.defined ? squared : one), length = squared * per_edge;
    // (n1 × n2)·e = -|e|² n1·d, because n1 is normal to e.
    const P angle = arc_tangent<Real>(-length * dot(n1, d), dot(n1, n2));
    const P per_both = per_length / (result.defined ? product : one);  // one division for both normals
    const P i1 = per_both * s2, i2 = per_both * s1;

    P slope = one;
    constexpr Real pi = std::numbers::pi_v<Real>;
    P change = angle - rest[0];
    if constexpr (law == HingeAngle::Law::angle) {
      change = change > pi ? change - 2 * pi : change;
      result.value = change < -pi ? change + 2 * pi : change;
    } else if constexpr (law != HingeAngle::Law::half_sine) {
      constexpr Turn measure = law == HingeAngle::Law::tangent ? Turn::tangent : Turn::sine;
      const PackTurn<Real> now = pack_turn<Real, measure>(Real(0.5) * angle),
                           at_rest = pack_turn<Real, measure>(Real(0.5) * rest[0]);
      result.value = 2 * (now.value - at_rest.value);
      slope = now.slope;
    } else {
      const P delta = Real(0.5) * change, s = sine<Real>(Real(0.5) * delta);
      const P rest_of_one = one - s * s, size = delta < P{} ? -delta : delta;
      const P cosine = square_root(rest_of_one > P{} ? rest_of_one : P{});  // s may round to above 1
      const P twice_energy = 4 * rest[2] * (2 * s * cosine - delta) + 8 * rest[3] * s * s;
      const auto tiny = (size < std::sqrt(std::numeric_limits<Real>::epsilon())) | (twice_energy <= P{});
      const P root = square_root(tiny ? one : twice_energy);
      const P signed_root = delta < P{} ? -root : root;
      result.value = tiny ? delta * square_root(2 * rest[3]) : signed_root;
      slope = tiny ? square_root(Real(0.5) * rest[3])
                   : 2 * (rest[3] * cosine - rest[2] * s) * s / (tiny ? one : signed_root);
    }
    const P t1 = slope * i1, t2 = slope * i2, e1 = t1 * per_edge, e2 = t2 * per_edge;
    result.gradient[0] = scaled<Real>(-e1 * dot(b, e), n1) - scaled<Real>(e2 * dot(c, e), n2);
    result.gradient[1] = scaled<Real>(e1 * dot(a, e), n1) + scaled<Real>(e2 * dot(d, e), n2);
    result.gradient[2] = scaled<Real>(-length * t1, n1);
    result.gradient[3] = scaled<Real>(-length * t2, n2);
    return result;
  }
};

BENDLAB_ELEMENT_KERNELS(HingeAngle);

}  // namespace bendlab
