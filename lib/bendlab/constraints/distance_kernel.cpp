#include "bendlab/constraints/kernels.hpp"

namespace bendlab {
namespace {

//   a o-------------o b      C = |p_a - p_b| - rest_length,   ∇_a C = n,   ∇_b C = -n
//        n = (p_a - p_b) / |p_a - p_b|
template <class Real, bool compliant>
void project_lanes(Point<Real>* points, DistanceBatch<Real>& batch, std::size_t first, std::size_t last,
                   Real alpha) {
  using P = Pack<Real>;
  const P zero{};
  const P collapsed = broadcast<Real>(collapsed_ratio<Real>);
  for (std::size_t lane = first; lane < last; lane += static_cast<std::size_t>(lanes<Real>)) {
    PackPoints<Real> a = gather(points, &batch.a[lane]), b = gather(points, &batch.b[lane]);
    const P rest = load(&batch.rest_length[lane]);
    const PackVector<Real> d = a.position - b.position;
    const P length = square_root(dot(d, d));
    const P sum = a.w + b.w;
    P step;  // of the correction along d, per inverse mass
    if constexpr (compliant) {
      const P multiplier = load(&batch.multiplier[lane]);
      const auto acts = (length > collapsed * rest) & (sum + alpha > zero);
      const P change =
          acts ? (rest - length - alpha * multiplier) / (acts ? sum + alpha : zero + Real(1)) : zero;
      store(&batch.multiplier[lane], multiplier + change);
      step = change / (acts ? length : zero + Real(1));
    } else {
      const auto acts = (length > collapsed * rest) & (sum > zero);
      step = acts ? batch.k * (rest - length) / (acts ? length * sum : zero + Real(1)) : zero;
    }
    a.position = a.position + scaled<Real>(step * a.w, d);
    b.position = b.position - scaled<Real>(step * b.w, d);
    scatter(points, &batch.a[lane], a);
    scatter(points, &batch.b[lane], b);
  }
}

}  // namespace

template <class Real>
void project(Point<Real>* points, DistanceBatch<Real>& batch, std::size_t first, std::size_t last,
             Real substep) {
  if (batch.kind == StiffnessKind::compliance)
    project_lanes<Real, true>(points, batch, first, last, batch.compliance / (substep * substep));
  else
    project_lanes<Real, false>(points, batch, first, last, 0);
}

template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const DistanceBatch<Real>& batch, Real k) {
  using P = Pack<Real>;
  const P zero{};
  for (std::size_t lane = 0; lane < batch.a.size(); lane += static_cast<std::size_t>(lanes<Real>)) {
    const PackPoints<Real> a = gather(points, &batch.a[lane]), b = gather(points, &batch.b[lane]);
    PackPoints<Real> va = gather(velocities, &batch.a[lane]), vb = gather(velocities, &batch.b[lane]);
    const PackVector<Real> d = a.position - b.position;
    const P squared = dot(d, d), sum = a.w + b.w, rest = load(&batch.rest_length[lane]);
    const P shortest = collapsed_ratio<Real> * rest;
    const auto acts = (squared > shortest * shortest) & (sum > zero);
    const P rate = dot(d, va.position - vb.position);  // Ċ times the length
    const P step = acts ? -k * rate / (acts ? squared * sum : zero + Real(1)) : zero;
    va.position = va.position + scaled<Real>(step * a.w, d);
    vb.position = vb.position - scaled<Real>(step * b.w, d);
    scatter(velocities, &batch.a[lane], va);
    scatter(velocities, &batch.b[lane], vb);
  }
}

template void project(Point<float>*, DistanceBatch<float>&, std::size_t, std::size_t, float);
template void project(Point<double>*, DistanceBatch<double>&, std::size_t, std::size_t, double);
template void damp(const Point<float>*, Point<float>*, const DistanceBatch<float>&, float);
template void damp(const Point<double>*, Point<double>*, const DistanceBatch<double>&, double);

}  // namespace bendlab
