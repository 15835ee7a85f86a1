// A constraint at one state: what the oracle computes one at a time.
#pragma once

#include <array>
#include <cstddef>

#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// C and ∇C of a constraint on N vertices; `defined` is false where the gradient has no direction. The value
/// is then what a collapsed element is to be corrected by along the gradient of its rest shape: that is how
/// it opens again. 0: nothing can be corrected (a hinge without an angle, which its triangles' strain opens;
/// an overgrown element).
template <class Real, std::size_t N>
struct ConstraintValue {
  Real value = 0;
  std::array<Vector3Of<Real>, N> gradient;
  bool defined = true;
};

}  // namespace bendlab
