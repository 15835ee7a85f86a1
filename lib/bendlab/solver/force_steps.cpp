#include "bendlab/solver/force_steps.hpp"

#include <algorithm>
#include <cmath>

#include "bendlab/constraints/pack.hpp"

namespace bendlab {

template <class Real>
Real largest_gained_gradient(const Point<Real>* velocities, const Point<Real>* before,
                             const StrainBatch<Real>& batch) {
  constexpr auto width = static_cast<std::size_t>(lanes<Real>);
  const auto gained = [&](const int* corners) {
    return gather(velocities, corners).position - gather(before, corners).position;
  };
  Pack<Real> largest{};
  for (std::size_t lane = 0; lane < batch.a.size(); lane += width) {
    const PackVector<Real> a = gained(&batch.a[lane]), e1 = gained(&batch.b[lane]) - a,
                           e2 = gained(&batch.c[lane]) - a;
    const PackVector<Real> f1 =
        scaled<Real>(load(&batch.q00[lane]), e1) + scaled<Real>(load(&batch.q10[lane]), e2);
    const PackVector<Real> f2 =
        scaled<Real>(load(&batch.q01[lane]), e1) + scaled<Real>(load(&batch.q11[lane]), e2);
    const Pack<Real> squared = dot(f1, f1) + dot(f2, f2);
    largest = larger<Real>(squared, largest);
  }
  Real most = 0;
  for (std::size_t i = 0; i < width; ++i) most = std::max(most, largest[i]);
  return std::sqrt(most);
}

int force_steps(double change, double limit) {
  const double steps = std::ceil(std::sqrt(change / limit) - 1e-6);  // a step that just fits is not cut
  return steps < most_force_steps ? std::max(1, static_cast<int>(steps)) : most_force_steps;
}

template float largest_gained_gradient(const Point<float>*, const Point<float>*, const StrainBatch<float>&);
template double largest_gained_gradient(const Point<double>*, const Point<double>*,
                                        const StrainBatch<double>&);

}  // namespace bendlab
