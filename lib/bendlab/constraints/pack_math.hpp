// Trigonometric functions of packs, with an error of two or three units in the last place. The functions are
// polynomials through the Chebyshev nodes of their range, with a relative error below 2·10⁻⁸ (float) and
// 4·10⁻¹⁷ (double). Bessel functions are sums of Taylor series.
#pragma once

#include <array>
#include <numbers>

#include "bendlab/constraints/pack.hpp"

namespace bendlab {
namespace detail {

template <class Real>
inline constexpr auto arc_tangent_series = [] {  // atan(√z) / √z on [0, tan²(π/8)]
  if constexpr (sizeof(Real) == 4)
    return std::array{0.99999998126f, -0.33332785772f, 0.19974082416f, -0.13848490212f, 0.07976291807f};
  else
    return std::array{0.9999999999999999653,   -0.3333333333332843857,  0.1999999999885511013,
                      -0.1428571418097646683,  0.1111110618045594522,   -0.0909077307480841379,
                      0.07689953496306857756,  -0.06640233930429408589, 0.05688349226809010479,
                      -0.04348052215716462478, 0.02113537315769324521};
}();

template <class Real>
inline constexpr auto sine_series = [] {  // sin(√z) / √z on [0, (π/2)²]
  if constexpr (sizeof(Real) == 4)
    return std::array{0.9999999957f, -0.1666665795f, 0.008333050171f, -0.0001980901741f, 2.605107635e-6f};
  else
    return std::array{0.9999999999999999998,     -0.1666666666666666531,    0.008333333333333186384,
                      -0.0001984126984120867517, 2.755731921122960662e-6,   -2.505210689056951954e-8,
                      1.605894087848655993e-10,  -7.643026557971632663e-13, 2.721574942298344283e-15};
}();

// For z up to π²: j1(√z) / √z = S = Σ (-1)ⁿ 2 (n + 1) zⁿ / (2n + 3)!, and j2(√z) / z = -2 dS/dz.
template <class Real, bool second>
inline constexpr auto bessel_series = [] {
  std::array<Real, sizeof(Real) == 4 ? 8 : 13> series{};
  double factorial = second ? 120 : 6, sign = 1;
  for (std::size_t n = 0; n < series.size(); ++n, sign = -sign) {
    const auto m = static_cast<double>(second ? n + 1 : n);
    series[n] = static_cast<Real>(sign * (second ? 4 * m : 2) * (m + 1) / factorial);
    factorial *= (2 * m + 4) * (2 * m + 5);
  }
  return series;
}();

template <class Real, std::size_t terms>
BENDLAB_INLINE Pack<Real> polynomial(const std::array<Real, terms>& coefficients, const Pack<Real>& z) {
  Pack<Real> sum = broadcast(coefficients[terms - 1]);
  for (std::size_t i = terms - 1; i-- > 0;) sum = sum * z + coefficients[i];
  return sum;
}

template <class Real>
BENDLAB_INLINE Pack<Real> with_sign_of(const Pack<Real>& magnitude, const Pack<Real>& sign) {
  return sign < Pack<Real>{} ? -magnitude : magnitude;
}

}  // namespace detail

/// The angle of (x, y) in [-π, π]; 0 if x = y = 0. -0 counts as 0.
template <class Real>
BENDLAB_INLINE Pack<Real> arc_tangent(const Pack<Real>& y, const Pack<Real>& x) {
  using P = Pack<Real>;
  const P zero{}, ax = x < zero ? -x : x, ay = y < zero ? -y : y;
  const auto steep = ay > ax;
  const P high = steep ? ay : ax, low = steep ? ax : ay;
  // For angles above π/8: atan(t) = π/4 + atan((t - 1) / (t + 1)).
  const auto beyond = low > Real(0.4142135623730950488) * high;
  const P top = beyond ? low - high : low, bottom = beyond ? low + high : high;
  const P t = top / (bottom > zero ? bottom : broadcast<Real>(1));
  constexpr Real pi = std::numbers::pi_v<Real>;
  P angle = t * detail::polynomial(detail::arc_tangent_series<Real>, t * t);
  angle = beyond ? angle + pi / 4 : angle;
  angle = steep ? pi / 2 - angle : angle;
  angle = x < zero ? pi - angle : angle;
  return detail::with_sign_of<Real>(angle, y);
}

/// sin x for x in [-π/2, π/2].
template <class Real>
BENDLAB_INLINE Pack<Real> sine(const Pack<Real>& x) {
  return x * detail::polynomial(detail::sine_series<Real>, x * x);
}

/// Spherical Bessel functions j1(√z) / √z and j2(√z) / z for z in [0, π²]. The absolute error is two or three
/// units in the last place of the values at 0, which are 1/3 and 1/15. With y = √z: j1(y) / y = (sinc y - cos
/// y) / y², and sinc y = 3 j1(y) / y - j2(y).
template <class Real>
BENDLAB_INLINE Pack<Real> bessel_1(const Pack<Real>& z) {
  return detail::polynomial(detail::bessel_series<Real, false>, z);
}
template <class Real>
BENDLAB_INLINE Pack<Real> bessel_2(const Pack<Real>& z) {
  return detail::polynomial(detail::bessel_series<Real, true>, z);
}

}  // namespace bendlab
