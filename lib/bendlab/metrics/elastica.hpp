// How the shape of a strip that is clamped horizontally and hangs under its own weight depends on its
// stiffness.
//
//   clamp ___________ s                    m' = -ρ g (L - s) cos θ,   m = C κ^p,   κ = θ',
//          θ(0) = 0  ‾‾‾-._                θ downward, m the moment per width;  θ(0) = 0,  m(L) = 0
//                    ↓ g    `\  free end
//
// p = 1 is the heavy elastica, with C its flexural rigidity B (Romero et al. 2021 call Γ(H/W) the
// cantilever's master curve). p = 3 is the law of springs between vertices of an inextensible sheet: bending
// to the curvature κ shortens the springs in proportion to κ², so their energy is quartic in κ.
#pragma once

namespace bendlab {

enum class BendingLaw {
  linear,  ///< m = B κ, B in N m
  cubic,   ///< m = C κ³, C in N m³
};

/// The shape in units of the length L.
struct HangingStrip {
  double gamma = 0;  ///< Γ = ρ g L^(p+2) / C, ρ the mass per area
  double drop = 0;   ///< H / L of the free end
  double reach = 0;  ///< W / L of the free end
};

/// The strip with `height_over_width` = H/W: its free end is H below and W in front of the clamp. The error
/// in Γ is 10⁻⁷. Throws std::invalid_argument if H/W is outside [10⁻⁶, 500]: a stiffer strip shows rounding
/// errors, and a softer strip has almost no W.
HangingStrip hanging_strip(BendingLaw law, double height_over_width);

/// d ln Γ / d ln(H/W): the factor by which a relative error of H/W grows in the stiffness. Throws as above.
double amplification(BendingLaw law, double height_over_width);

}  // namespace bendlab
