// Springs that push, and a membrane that has to hold them.
#pragma once

#include <algorithm>

namespace bendlab {

/// N/m: how stiff a membrane must stay so that springs that stretch it with the tension T (N/m) make it grow
/// by no more than `error`, the share of its size by which a softer membrane may move the cloth. It grows by
/// T over its stiffness, and by more once neighbours give way: above 0.04 sheets tear
/// (bending/push_bound.hpp).
inline double membrane_for_push(double tension, double error) {
  constexpr double tears = 0.04;
  return tension > 0 ? tension / std::min(error, tears) : 0;
}

}  // namespace bendlab
