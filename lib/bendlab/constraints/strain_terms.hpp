// The terms of a triangle that the strain kernel projects (stretch, shear, area): values and gradients for
// the lanes of a pack. Only strain_kernel.cpp includes this header. The code is in an unnamed namespace,
// because GCC allocates registers differently for templates that other sources may share.
#pragma once

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/pack_math.hpp"

namespace bendlab {
namespace {

//        c                 e1 = p_b - p_a, e2 = p_c - p_a
//       / \                f1 = q00 e1 + q10 e2 (warp),  f2 = q01 e1 + q11 e2 (weft)
//      /   \               ∇_b = coefficient of e1, ∇_c = coefficient of e2, ∇_a = -∇_b - ∇_c
//     a-----b

// If each position is stored as base + move (split places, point.hpp), a, b and c are the moves of the
// corners, and first_base and second_base are the edges from a to b and from a to c between the bases. Their
// sum would lose digits.
template <class Real, bool split = false>
struct Corners {
  PackPoints<Real> a, b, c;
  PackVector<Real> first_base, second_base;  // split only

  BENDLAB_INLINE PackVector<Real> first_edge() const {
    if constexpr (split) return first_base + (b.position - a.position);
    return b.position - a.position;
  }
  BENDLAB_INLINE PackVector<Real> second_edge() const {
    if constexpr (split) return second_base + (c.position - a.position);
    return c.position - a.position;
  }
  BENDLAB_INLINE Pack<Real> largest_w() const { return larger<Real>(larger<Real>(a.w, b.w), c.w); }
  // The square of the longest edge, or `at_rest` if `at_rest` is larger.
  BENDLAB_INLINE Pack<Real> size_squared(const Pack<Real>& at_rest) const {
    const PackVector<Real> e1 = first_edge(), e2 = second_edge(), e3 = e2 - e1;
    return larger<Real>(larger<Real>(dot(e1, e1), dot(e2, e2)), larger<Real>(dot(e3, e3), at_rest));
  }
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

// |∇C|² of each corner.
template <class Real>
struct PerTriangle {
  Pack<Real> a, b, c;

  template <class Triangle>
  BENDLAB_INLINE Pack<Real> weighted_sum(const Triangle& t) const {
    return t.a.w * a + t.b.w * b + t.c.w * c;
  }
  BENDLAB_INLINE Pack<Real> sum() const { return a + b + c; }
  // max w²|∇C|²: the squared move of the corner that moves farthest, for a change of the multiplier by 1.
  template <class Triangle>
  BENDLAB_INLINE Pack<Real> farthest(const Triangle& t) const {
    return larger<Real>(larger<Real>(t.a.w * t.a.w * a, t.b.w * t.b.w * b), t.c.w * t.c.w * c);
  }
};

// The gradient of stretch has one direction, and a factor per corner. PerCorner (shear, area) has three
// vectors.
template <class Real>
struct Scaled {
  PackVector<Real> direction;
  Pack<Real> squared;  // |direction|²
  Pack<Real> gb, gc;
  BENDLAB_INLINE PerTriangle<Real> squares() const {
    const Pack<Real> ga = gb + gc;
    return {ga * ga * squared, gb * gb * squared, gc * gc * squared};
  }
  template <class Triangle, class Masses>
  BENDLAB_INLINE void add(Triangle& t, const Pack<Real>& s, const Masses& mass) const {
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
  BENDLAB_INLINE PerTriangle<Real> squares() const {
    const PackVector<Real> ga = gb + gc;
    return {dot(ga, ga), dot(gb, gb), dot(gc, gc)};
  }
  template <class Triangle, class Masses>
  BENDLAB_INLINE void add(Triangle& t, const Pack<Real>& s, const Masses& mass) const {
    t.a.position = t.a.position - scaled<Real>(s * mass.a.w, gb + gc);
    t.b.position = t.b.position + scaled<Real>(s * mass.b.w, gb);
    t.c.position = t.c.position + scaled<Real>(s * mass.c.w, gc);
  }
  BENDLAB_INLINE Pack<Real> rate(const Corners<Real>& velocity) const {
    return dot(gb, velocity.first_edge()) + dot(gc, velocity.second_edge());
  }
};

// One term as C = ratio · scale and ∇C = scale · gradient. PBD's correction C / Σ w|∇C|² ∇C is then ratio / Σ
// w|gradient|² gradient. The scale cancels, which saves most square roots and divisions. `defined` is a lane
// mask.
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

// The lanes in which a squared ratio to the rest value is neither collapsed nor overgrown (tolerances.hpp).
template <class Real>
BENDLAB_INLINE PackMask<Real> in_bounds(const Pack<Real>& squared) {
  constexpr Real least = collapsed_ratio<Real> * collapsed_ratio<Real>;
  return (squared > least) & (squared < overgrown_square<Real>);
}

template <class Real, StrainForm form, bool split>
BENDLAB_INLINE Term<Real, Scaled<Real>> stretch(const Corners<Real, split>& t, const Pack<Real>& gb,
                                                const Pack<Real>& gc) {
  const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
  const Pack<Real> one = broadcast<Real>(1), squared = dot(f, f);
  const auto defined = in_bounds<Real>(squared);
  if constexpr (!is_green(form)) {                   // C = l - 1, ∇C = f / l
    const Pack<Real> length = square_root(squared);  // not of a selected value: need not wait for `defined`
    return {squared - length, one / (defined ? length : one), {f, squared, gb, gc}, defined};
  } else {
    return {squared - one, one, {f, squared, gb + gb, gc + gc}, defined};
  }
}

// Normalised: C = cos = f1·f2 / (l1 l2). ∇C follows from a1 = (f2 - f1·f2 / l1² f1) / (l1 l2), and a2 with f1
// and f2 exchanged. Angle: C = atan(f1·f2 / |f1 × f2|), with |f1 × f2| in place of l1 l2 in a1 and a2.
template <class Real, StrainForm form, bool split>
BENDLAB_INLINE Term<Real, PerCorner<Real>> shear(const Corners<Real, split>& t, const RestInverse<Real>& q) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
  const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                         f2 = combination<Real>(q.q01, e1, q.q11, e2);
  const Pack<Real> one = broadcast<Real>(1);
  const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), s12 = dot(f1, f2);
  const Pack<Real> product = s11 * s22, not_parallel = product - s12 * s12;  // (l1 l2 sin)²
  const auto aslant = not_parallel > broadcast<Real>(parallel_sine_squared<Real>) * product;
  if constexpr (is_green(form)) {
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

// C = A / A0 - 1. The gradients of b and c are parallel to e2 × n and n × e1, where n = e1 × e2 is not a
// unit.
template <class Real, bool split>
BENDLAB_INLINE Term<Real, PerCorner<Real>> area(const Corners<Real, split>& t,
                                                const Pack<Real>& inverse_rest) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge(), normal = cross(e1, e2);
  const Pack<Real> one = broadcast<Real>(1), squared = dot(normal, normal);
  const auto defined = in_bounds<Real>(squared * inverse_rest * inverse_rest);
  const Pack<Real> twice_area = square_root(defined ? squared : one), scale = inverse_rest / twice_area;
  return {(twice_area * inverse_rest - one) * twice_area / inverse_rest,
          scale,
          {cross(e2, normal), cross(normal, e1)},
          defined};
}

// C = S_11 + S_22 - 2, ∂C/∂f_i = 2 f_i: the fourth term of StrainForm::stvk.
template <class Real, bool split>
BENDLAB_INLINE Term<Real, PerCorner<Real>> trace(const Corners<Real, split>& t, const RestInverse<Real>& q) {
  const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
  const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                         f2 = combination<Real>(q.q01, e1, q.q11, e2);
  const Pack<Real> sum = dot(f1, f1) + dot(f2, f2);
  const PackVector<Real> b = combination<Real>(q.q00, f1, q.q01, f2),
                         c = combination<Real>(q.q10, f1, q.q11, f2);
  return {sum - broadcast<Real>(2), broadcast<Real>(1), {b + b, c + c}, in_bounds<Real>(sum)};
}

// The lanes in which a term is corrected along the gradient of the rest shape, and ConstraintValue::value
// there.
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

  template <StrainForm form, bool split>
  BENDLAB_INLINE auto term(const Corners<Real, split>& t) const {
    return stretch<Real, form, split>(t, gb, gc);
  }
  template <bool split>
  BENDLAB_INLINE PackMask<Real> has_collapsed(const Corners<Real, split>& t) const {
    const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
    return collapsed<Real>(dot(f, f));
  }
  // C = f·d - 1, even if an earlier term changed f. d is f in the rest shape and has the length 1.
  template <StrainForm, bool split>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real, split>& t, const Corners<Real>& at_rest) const {
    const PackVector<Real> d = combination<Real>(gb, at_rest.first_edge(), gc, at_rest.second_edge());
    const PackVector<Real> f = combination<Real>(gb, t.first_edge(), gc, t.second_edge());
    return {was_collapsed, dot(f, d) - broadcast<Real>(1)};
  }
  static constexpr bool opens_normalised = true;
  static constexpr bool overshoots = false;
};

template <class Real>
struct Shear {
  RestInverse<Real> q;

  template <StrainForm form, bool split>
  BENDLAB_INLINE auto term(const Corners<Real, split>& t) const {
    return shear<Real, form, split>(t, q);
  }
  // For parallel warp and weft.
  template <StrainForm form, bool split>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real, split>& t, const Corners<Real>&) const {
    const PackVector<Real> e1 = t.first_edge(), e2 = t.second_edge();
    const PackVector<Real> f1 = combination<Real>(q.q00, e1, q.q10, e2),
                           f2 = combination<Real>(q.q01, e1, q.q11, e2);
    const Pack<Real> s11 = dot(f1, f1), s22 = dot(f2, f2), one = broadcast<Real>(1);
    const auto both = in_bounds<Real>(s11) & in_bounds<Real>(s22);
    const Pack<Real> s12 = both ? dot(f1, f2) : Pack<Real>{};
    if constexpr (is_green(form)) {
      return {both, s12};
    } else if constexpr (form == StrainForm::normalised) {
      return {both, s12 / square_root(both ? s11 * s22 : one)};
    } else {
      const PackVector<Real> normal = cross(f1, f2);
      return {both, arc_tangent<Real>(s12, square_root(both ? dot(normal, normal) : one))};
    }
  }
  static constexpr bool opens_normalised = false;
  static constexpr bool overshoots = true;  // as published
};

template <class Real>
struct Area {
  RestInverse<Real> q;
  Pack<Real> inverse_rest;

  template <StrainForm form, bool split>
  BENDLAB_INLINE auto term(const Corners<Real, split>& t) const {
    if constexpr (form == StrainForm::stvk)
      return trace<Real>(t, q);
    else
      return area<Real>(t, inverse_rest);
  }
  template <StrainForm form, bool split>
  BENDLAB_INLINE Opening<Real> opening(const Corners<Real, split>& t, const Corners<Real>&) const {
    if constexpr (form == StrainForm::stvk) return {PackMask<Real>{}, Pack<Real>{}};
    const PackVector<Real> normal = cross(t.first_edge(), t.second_edge());
    return {collapsed<Real>(dot(normal, normal) * inverse_rest * inverse_rest), broadcast<Real>(-1)};
  }
  static constexpr bool opens_normalised = false;
  static constexpr bool overshoots = false;
};

}  // namespace
}  // namespace bendlab
