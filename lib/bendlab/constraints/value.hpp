// A constraint at one state: what the oracle computes one at a time.
#pragma once

#include <array>
#include <cstddef>

#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// C and ∇C of a constraint on N vertices; `defined` is false where the gradient has no direction (a
/// collapsed element), and then nothing is corrected.
template <class Real, std::size_t N>
struct ConstraintValue {
  Real value = 0;
  std::array<Vector3Of<Real>, N> gradient;
  bool defined = true;
};

}  // namespace bendlab
