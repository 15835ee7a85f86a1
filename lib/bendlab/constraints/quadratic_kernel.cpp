// A lane (an entry of a vector register) holds one hinge. Scalar code (the oracle) is in quadratic_bend.hpp.
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

template <class Real, QuadraticBend::Law law>
struct PackKernel<Real, QuadraticBend, law> : ElasticKernel<Real, QuadraticBend> {
  using P = Pack<Real>;
  using Corners = std::array<PackPoints<Real>, 4>;
  using Rest = std::array<P, 6>;

  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const P& squared, const Rest& rest) {
    return squared > rest[5] * rest[5];
  }

  BENDLAB_INLINE static P rest_size_squared(const Rest& rest) { return rest[5] * rest[5]; }

  BENDLAB_INLINE static PackVector<Real> bend_of(const Corners& p, const Rest& rest) {
    return scaled<Real>(rest[1], p[1].position - p[0].position) +
           scaled<Real>(rest[2], p[2].position - p[0].position) +
           scaled<Real>(rest[3], p[3].position - p[0].position);
  }

  BENDLAB_INLINE static PackConstraint<Real, 4> evaluate(const Corners& p, const Rest& rest) {
    const PackVector<Real> bend = bend_of(p, rest);
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

  BENDLAB_INLINE static P when_collapsed(const Corners& p, const Rest& rest) {
    const PackVector<Real> bend = bend_of(p, rest);
    const P least = collapsed_ratio<Real> * rest[5];
    const P value = law == QuadraticBend::Law::norm ? -rest[4] : -Real(0.5) * rest[4] * rest[4];
    return dot(bend, bend) > least * least ? P{} : value;
  }
};

BENDLAB_ELEMENT_KERNELS(QuadraticBend);

}  // namespace bendlab
