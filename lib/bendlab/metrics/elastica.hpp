// A strip that is clamped horizontally and hangs under its own weight: the curves that tell how stiff it is.
//
//   clamp ___________ s                    m' = -ρ g (L - s) cos θ,   m = C κ^p,   κ = θ',
//          θ(0) = 0  ‾‾‾-._                θ downward, m the moment per width;  θ(0) = 0,  m(L) = 0
//                    ↓ g    `\  free end
//
// p = 1 is the heavy elastica, C its flexural rigidity B (Romero et al. 2021 call Γ(H/W) the cantilever's
// master curve). p = 3 is what springs between vertices of an inextensible sheet give: bending to curvature κ
// shortens them by ∝ κ², so that their energy is quartic.
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

/// The strip whose free end is `height_over_width` = H/W below and before the clamp, to 10⁻⁷ in Γ. Throws
/// std::invalid_argument outside [10⁻⁶, 500]: a straighter strip shows rounding, a limper one has no width
/// left.
HangingStrip hanging_strip(BendingLaw law, double height_over_width);

/// d ln Γ / d ln(H/W) there: by how much a relative error of H/W is larger in the stiffness. Throws as above.
double amplification(BendingLaw law, double height_over_width);

}  // namespace bendlab
