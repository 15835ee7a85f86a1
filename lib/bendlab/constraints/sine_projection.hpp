// When a projection with k acts on a hinge of HingeAngle::Law::sine.
#pragma once

#include "bendlab/constraints/hinge_angle.hpp"

namespace bendlab {

/// It acts while |C| is smaller. A projection turns a hinge that is flat at rest by 2 tan(θ/2). If the fold
/// is tighter than 134 degrees (tan φ = 2 φ, φ = θ/2), this is more than 2 θ, so the hinge would fold farther
/// to the other side.
inline constexpr double largest_sine = 1.83;

}  // namespace bendlab
