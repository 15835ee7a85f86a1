// The stiffness of a strip from its shape. The strip is clamped horizontally and hangs under its own weight.
//
//   clamp ___________ s                    m' = -ρ g (L - s) cos θ,   m = C κ^p,   κ = θ',
//          θ(0) = 0  ‾‾‾-._                θ is positive downward;  θ(0) = 0,  m(L) = 0
//                    ↓ g    `\  free end
//
// m is the moment per width. p = 1 is the heavy elastica, where C is the flexural rigidity B. (Romero et al.
// 2021 call Γ(H/W) the cantilever's master curve.) p = 3 is the law of springs between vertices of an
// inextensible sheet: bending to the curvature κ shortens the springs in proportion to κ², so the energy is
// quartic in κ.
#pragma once

namespace bendlab {

enum class BendingLaw {
  linear,  ///< m = B κ, B in N m
  cubic,   ///< m = C κ³, C in N m³
};

/// The shape; lengths in units of the strip's length L.
struct HangingStrip {
  double gamma = 0;  ///< Γ = ρ g L^(p+2) / C, ρ the mass per area
  double drop = 0;   ///< H / L of the free end
  double reach = 0;  ///< W / L of the free end
};

/// The strip whose free end is H below the clamp and W in front of the clamp, for `height_over_width` = H/W.
/// The error in Γ is 10⁻⁷. Throws std::invalid_argument if H/W is outside [10⁻⁶, 500]. For a smaller H/W
/// rounding errors are too large; for a larger H/W, W is nearly 0.
HangingStrip hanging_strip(BendingLaw law, double height_over_width);

/// d ln Γ / d ln(H/W): the relative error of the stiffness, divided by the relative error of H/W. Throws like
/// hanging_strip().
double amplification(BendingLaw law, double height_over_width);

}  // namespace bendlab
