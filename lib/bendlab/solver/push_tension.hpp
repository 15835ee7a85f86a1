// How stiff a membrane must be to hold springs that push.
#pragma once

#include <algorithm>

namespace bendlab {

/// The least stiffness of a membrane, N/m, so that springs that push with `tension` (N/m) stretch it by at
/// most `error`. `error` is how far a softer membrane may move the cloth, as a share of the cloth's size. The
/// membrane stretches by tension / stiffness, and by more once neighbours give way: above 0.04 sheets tear
/// (bending/push_bound.hpp).
inline double membrane_for_push(double tension, double error) {
  constexpr double tears = 0.04;
  return tension > 0 ? tension / std::min(error, tears) : 0;
}

}  // namespace bendlab
