// What lies in a lane: one hinge of QuadraticBend (quadratic_bend.hpp, with the scalar code).
//
//       p2            p[0] … p[3]         its corners: packs of x, y, z and of w = 1/m
//      /  \           rest[0] … rest[3]   K_0 … K_3
//    p0 -- p1         rest[4]             |Kx| at rest, m
//      \  /           rest[5]             rest length of the edge, m
//       p3
//                     bend = Kx = Σ K_i p_i, relative to p0 because Σ K_i = 0
#include "bendlab/constraints/element_kernel.hpp"
#include "bendlab/constraints/quadratic_bend.hpp"

namespace bendlab {
template <>
struct PackKernel<QuadraticBend> {
  using Laws = LawList<QuadraticBend::Law::norm, QuadraticBend::Law::energy>;

  template <class Real>
  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const Pack<Real>& squared,
                                                         const std::array<Pack<Real>, 6>& rest) {
    return squared > rest[5] * rest[5];
  }

  template <class Real>
  BENDLAB_INLINE static Pack<Real> rest_size_squared(const std::array<Pack<Real>, 6>& rest) {
    return rest[5] * rest[5];
  }

  template <class Real, QuadraticBend::Law law>
  BENDLAB_INLINE static PackConstraint<Real, 4> evaluate(const std::array<PackPoints<Real>, 4>& p,
                                                         const std::array<Pack<Real>, 6>& rest,
                                                         std::integral_constant<QuadraticBend::Law, law>) {
    using P = Pack<Real>;
    const PackVector<Real> bend = scaled<Real>(rest[1], p[1].position - p[0].position) +
                                  scaled<Real>(rest[2], p[2].position - p[0].position) +
                                  scaled<Real>(rest[3], p[3].position - p[0].position);
    const P squared = dot(bend, bend), one = broadcast<Real>(1), least = collapsed_ratio<Real> * rest[5];
    PackConstraint<Real, 4> result;
    result.defined = (squared > least * least) & (squared < overgrown_square<Real> * rest[5] * rest[5]);
    if constexpr (law == QuadraticBend::Law::norm) {
      const P per_norm = inverse_square_root(result.defined ? squared : one);
      result.value = squared * per_norm - rest[4];
      for (std::size_t i = 0; i < 4; ++i) result.gradient[i] = scaled<Real>(rest[i] * per_norm, bend);
    } else {
      result.value = Real(0.5) * (squared - rest[4] * rest[4]);
      for (std::size_t i = 0; i < 4; ++i) result.gradient[i] = scaled<Real>(rest[i], bend);
    }
    return result;
  }

  template <class Real, QuadraticBend::Law law>
  BENDLAB_INLINE static Pack<Real> when_collapsed(const std::array<PackPoints<Real>, 4>& p,
                                                  const std::array<Pack<Real>, 6>& rest,
                                                  std::integral_constant<QuadraticBend::Law, law>) {
    using P = Pack<Real>;
    const PackVector<Real> bend = scaled<Real>(rest[1], p[1].position - p[0].position) +
                                  scaled<Real>(rest[2], p[2].position - p[0].position) +
                                  scaled<Real>(rest[3], p[3].position - p[0].position);
    const P least = collapsed_ratio<Real> * rest[5];
    const P value = law == QuadraticBend::Law::norm ? -rest[4] : -Real(0.5) * rest[4] * rest[4];
    return dot(bend, bend) > least * least ? P{} : value;
  }
};

BENDLAB_ELEMENT_KERNELS(QuadraticBend);

}  // namespace bendlab
