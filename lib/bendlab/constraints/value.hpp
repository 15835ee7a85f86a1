// The value and gradient of one constraint, as the oracle computes them.
#pragma once

#include <array>
#include <cstddef>

#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// C and ∇C of a constraint on N vertices. `defined` is false if the gradient has no direction.
/// A projection then uses the gradient of the rest shape, if there is a rest shape, and corrects `value`, so
/// that a collapsed element opens again. If this value is 0, the projection does nothing: the element is
/// overgrown (tolerances.hpp), or a hinge with a collapsed triangle, which its strain constraint opens.
template <class Real, std::size_t N>
struct ConstraintValue {
  Real value = 0;
  std::array<Vector3Of<Real>, N> gradient;
  bool defined = true;
};

}  // namespace bendlab
