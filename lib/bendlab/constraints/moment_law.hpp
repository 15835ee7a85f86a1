// How the moment of an element depends on the value C of its constraint (for a hinge: an angle), where the
// moment is not linear. α is the compliance, ψ the energy:
//
//   linear      ψ = C² / 2α,   ψ' = C / α
//   softening   ψ' = M(κ)/B · length / α, κ = |C| / length: the sheet has the moment M at the curvature κ
//   yield       ψ' = |C| / α up to |C| = yield, then with the slope hardening / α. At the end of a step the
//               rest values follow C. So a plastic fold keeps a curvature, and internal friction slides
//
//        M |      .--------- softening             M |     .----------- yield, hardening 0
//          |    .´                                   |    /|
//          |   /                                     |   / |    returns along the first slope
//          |  /                                      |  /  |
//          +-------------- κ                         +-------------- κ
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bendlab {

/// The moment of a softening sheet divided by its initial rigidity B: M/B as a function of the curvature κ.
struct SofteningLaw {
  /// The curvature at which the secant rigidity M/κ is half of B, 1/m: M = B κ / (1 + κ / half_at). 0: a
  /// table.
  double half_at = 0;
  /// Points of a piecewise linear M/B (1/m) over κ (1/m), ascending, without the point (0, 0). The last slope
  /// goes on for ever. Empty: no softening.
  std::vector<double> curvatures, moments;

  bool is_given() const { return half_at > 0 || !curvatures.empty(); }

  /// M/B, 1/m, for κ ≥ 0.
  double moment(double curvature) const;
  /// ∫ M/B dκ from 0, 1/m².
  double energy(double curvature) const;
};

inline double SofteningLaw::moment(double curvature) const {
  if (half_at > 0) return curvature / (1 + curvature / half_at);
  double k = 0, m = 0, slope = 1;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    slope = (moments[i] - m) / (curvatures[i] - k);
    if (curvature <= curvatures[i]) break;
    k = curvatures[i], m = moments[i];
  }
  return m + slope * (curvature - k);
}

inline double SofteningLaw::energy(double curvature) const {
  if (half_at > 0) {
    const double ratio = curvature / half_at;
    // a² (x - ln(1 + x)), by its series where both terms nearly cancel.
    return half_at * half_at * (ratio < 1e-4 ? ratio * ratio * (0.5 - ratio / 3) : ratio - std::log1p(ratio));
  }
  double k = 0, m = 0, slope = 1, sum = 0;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    slope = (moments[i] - m) / (curvatures[i] - k);
    if (curvature <= curvatures[i]) break;
    sum += 0.5 * (m + moments[i]) * (curvatures[i] - k);
    k = curvatures[i], m = moments[i];
  }
  return sum + (m + 0.5 * slope * (curvature - k)) * (curvature - k);
}

/// Per element, beside the rest values of an ElementList. All three are empty if every moment is linear.
struct MomentLaws {
  SofteningLaw softening = {};
  std::vector<double> length = {};     ///< #C: |C| / length is the curvature (length: m); 0: does not soften
  std::vector<double> yield = {};      ///< #C: |C| at which the element yields; infinity: never
  std::vector<double> hardening = {};  ///< #C: slope beyond the yield, relative to the slope before

  bool empty() const { return length.empty() && yield.empty(); }
  bool slips() const { return !yield.empty(); }
};

/// What a nonlinear element resists at its present value.
struct Resistance {
  double energy;  ///< ψ α
  double secant;  ///< ψ' α / C: the factor on the stiffness 1/α
};

/// The resistance of an element with this value |C|, length, yield and hardening.
inline Resistance resistance(const SofteningLaw& softening, double value, double length, double yield,
                             double hardening) {
  if (length > 0 && value > 0) {
    const double curvature = value / length;
    return {length * length * softening.energy(curvature), softening.moment(curvature) / curvature};
  }
  if (value > yield) {
    const double beyond = value - yield, moment = yield + hardening * beyond;
    return {0.5 * yield * yield + (yield + 0.5 * hardening * beyond) * beyond, moment / value};
  }
  return {0.5 * value * value, 1};
}

inline Resistance resistance(const MomentLaws& laws, std::size_t c, double value) {
  constexpr double never = std::numeric_limits<double>::infinity();
  return resistance(laws.softening, std::abs(value), laws.length.empty() ? 0 : laws.length[c],
                    laws.yield.empty() ? never : laws.yield[c], laws.yield.empty() ? 0 : laws.hardening[c]);
}

/// |C| of an element after it has yielded at this |C|, which is then also its yield.
template <class Real>
Real value_after_yield(Real value, Real yield, Real hardening) {
  return yield + hardening * (value - yield);
}

}  // namespace bendlab
