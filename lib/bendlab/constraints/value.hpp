// The value and gradient of one constraint, as the oracle computes them.
#pragma once

#include <array>
#include <cstddef>

#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// C and ∇C of a constraint on N vertices. `defined` is false if the gradient has no direction. The value is
/// then the one to correct along the gradient of the rest shape, so that a collapsed element opens again. 0:
/// it cannot be corrected (a hinge without an angle, which its triangles' strain opens; an overgrown
/// element).
template <class Real, std::size_t N>
struct ConstraintValue {
  Real value = 0;
  std::array<Vector3Of<Real>, N> gradient;
  bool defined = true;
};

}  // namespace bendlab
