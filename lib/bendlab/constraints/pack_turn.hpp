// The measures of turn.hpp for the lanes of a pack.
#pragma once

#include "bendlab/constraints/pack_math.hpp"
#include "bendlab/constraints/turn.hpp"

namespace bendlab {

template <class Real>
struct PackTurn {
  Pack<Real> value, slope;
};

template <class Real, Turn measure>
BENDLAB_INLINE PackTurn<Real> pack_turn(const Pack<Real>& angle) {
  using P = Pack<Real>;
  const P one = broadcast<Real>(1);
  if constexpr (measure == Turn::angle) {
    return {angle, one};
  } else {
    constexpr Real most = measure == Turn::sine ? std::numbers::pi_v<Real> / 2 : steepest_turn<Real>;
    const P low = angle < -most ? broadcast<Real>(-most) : angle,
            within = low > most ? broadcast<Real>(most) : low;
    const P s = sine<Real>(within), left = one - s * s;
    const P cosine = square_root(left > P{} ? left : P{});
    if constexpr (measure == Turn::sine) {
      return {s, within == angle ? cosine : P{}};
    } else {
      const P tangent = s / cosine, slope = one + tangent * tangent;
      return {tangent + (angle - within) * slope, slope};
    }
  }
}

}  // namespace bendlab
