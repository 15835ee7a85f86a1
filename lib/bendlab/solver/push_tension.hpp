// How stiff a membrane must be to resist springs that push.
#pragma once

#include <algorithm>

namespace bendlab {

/// The least stiffness of a membrane, N/m, with which springs that push with `tension` (N/m) stretch the
/// membrane by at most `error`. `error` is how far a softer membrane may move the cloth, as a share of the
/// cloth's size. The membrane stretches by tension / stiffness, and by more if neighbours give way. If the
/// stretch is above 0.04, sheets tear (bending/push_bound.hpp).
inline double membrane_for_push(double tension, double error) {
  constexpr double tears = 0.04;
  return tension > 0 ? tension / std::min(error, tears) : 0;
}

}  // namespace bendlab
