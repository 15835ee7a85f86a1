// The value and gradient of one constraint, as the oracle computes them.
#pragma once

#include <array>
#include <cstddef>

#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// C and ∇C of a constraint on N vertices. `defined` is false if the gradient has no direction. `value` is
/// then the value to correct along the gradient of the rest shape, so that a collapsed element opens again.
/// If that value is 0, the element cannot be corrected: it is a hinge without an angle, which the strain of
/// its triangles opens, or an overgrown element.
template <class Real, std::size_t N>
struct ConstraintValue {
  Real value = 0;
  std::array<Vector3Of<Real>, N> gradient;
  bool defined = true;
};

}  // namespace bendlab
