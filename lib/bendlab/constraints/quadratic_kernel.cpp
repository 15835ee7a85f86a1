// A lane (an entry of a vector register) holds one sum of N vertices, here with N = 4. Scalar code (the
// oracle) is in quadratic_bend.hpp.
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

template <class Scalar, std::size_t N, typename VertexSum<N>::Law law>
struct SumKernel : ElasticKernel<Scalar, VertexSum<N>> {
  using Real = Scalar;
  using Kind = VertexSum<N>;
  using P = Pack<Real>;
  using Corners = std::array<PackPoints<Real>, N>;
  using Rest = std::array<P, N + 2>;

  BENDLAB_INLINE static PackMask<Real> exceeds_rest_size(const P& squared, const Rest& rest) {
    return squared > rest[N + 1] * rest[N + 1];
  }

  BENDLAB_INLINE static P rest_size_squared(const Rest& rest) { return rest[N + 1] * rest[N + 1]; }

  BENDLAB_INLINE static PackVector<Real> bend_of(const Corners& p, const Rest& rest) {
    PackVector<Real> sum = scaled<Real>(rest[1], p[1].position - p[0].position);
    for (std::size_t i = 2; i < N; ++i) sum = sum + scaled<Real>(rest[i], p[i].position - p[0].position);
    return sum;
  }

  BENDLAB_INLINE static PackConstraint<Real, N> evaluate(const Corners& p, const Rest& rest) {
    const PackVector<Real> bend = bend_of(p, rest);
    const P size = rest[N + 1], squared = dot(bend, bend), one = broadcast<Real>(1),
            least = collapsed_ratio<Real> * size;
    PackConstraint<Real, N> result;
    result.defined = (squared > least * least) & (squared < overgrown_square<Real> * size * size);
    if constexpr (law == Kind::Law::norm) {
      const P per_norm = inverse_square_root(result.defined ? squared : one);
      result.value = squared * per_norm - rest[N];
      for (std::size_t i = 0; i < N; ++i) result.gradient[i] = scaled<Real>(rest[i] * per_norm, bend);
    } else {
      result.value = Real(0.5) * (squared - rest[N] * rest[N]);
      for (std::size_t i = 0; i < N; ++i) result.gradient[i] = scaled<Real>(rest[i], bend);
    }
    return result;
  }

  BENDLAB_INLINE static P when_collapsed(const Corners& p, const Rest& rest) {
    const PackVector<Real> bend = bend_of(p, rest);
    const P least = collapsed_ratio<Real> * rest[N + 1];
    const P value = law == Kind::Law::norm ? -rest[N] : -Real(0.5) * rest[N] * rest[N];
    return dot(bend, bend) > least * least ? P{} : value;
  }
};

template <class Real, QuadraticBend::Law law>
struct PackKernel<Real, QuadraticBend, law> : SumKernel<Real, 4, law> {};
template <class Real, LaplacianBend::Law law>
struct PackKernel<Real, LaplacianBend, law> : SumKernel<Real, 13, law> {};

BENDLAB_ELEMENT_KERNELS(QuadraticBend);
BENDLAB_ELEMENT_KERNELS(LaplacianBend);

}  // namespace bendlab
