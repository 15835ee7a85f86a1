#include "bendlab/solver/flight.hpp"

#include <algorithm>
#include <cmath>

namespace bendlab {

template <class Real>
Real largest_velocity_gradient(const Point<Real>* velocities, const StrainBatch<Real>& batch) {
  constexpr auto width = static_cast<std::size_t>(lanes<Real>);
  Pack<Real> largest{};
  for (std::size_t lane = 0; lane < batch.a.size(); lane += width) {
    const PackVector<Real> a = gather(velocities, &batch.a[lane]).position;
    const PackVector<Real> e1 = gather(velocities, &batch.b[lane]).position - a,
                           e2 = gather(velocities, &batch.c[lane]).position - a;
    const PackVector<Real> f1 = scaled<Real>(load(&batch.q00[lane]), e1) +
                                scaled<Real>(load(&batch.q10[lane]), e2),
                           f2 = scaled<Real>(load(&batch.q01[lane]), e1) +
                                scaled<Real>(load(&batch.q11[lane]), e2);
    const Pack<Real> squared = dot(f1, f1) + dot(f2, f2);
    largest = squared > largest ? squared : largest;
  }
  Real most = 0;
  for (std::size_t i = 0; i < width; ++i) most = std::max(most, largest[i]);
  return std::sqrt(most);
}

// ‖∇v‖ grows by no more than ‖∇a‖ t: bare x + ½ ‖∇a‖ x² would be the flight's, bare x + ‖∇a‖ x² is that of velocities with their
// forces, which positions are predicted with.
int parts_of_flight(double h, double bare, double loaded, double limit, int most) {
  const double growth = std::max(loaded - bare, 0.0) / h;
  const double longest = 2 * limit / (bare + std::sqrt(bare * bare + 4 * growth * limit));
  const double parts = std::ceil(h / longest - 1e-9);  // a part that just fits is not cut
  return parts < most ? std::max(1, static_cast<int>(parts)) : most;
}

template float largest_velocity_gradient(const Point<float>*, const StrainBatch<float>&);
template double largest_velocity_gradient(const Point<double>*, const StrainBatch<double>&);

}  // namespace bendlab
