// Whether projections resolve a membrane whose stiffness is stated.
#pragma once

namespace bendlab {

struct BuiltScene;

/// The Courant number C of a membrane with the stiffness Y = 1 / compliance (N/m) and the mass ρ per area:
/// how many cells a wave of stretch, whose speed is √(Y/ρ), crosses in a substep. The compliance has to be
/// above 0.
double courant_number(const BuiltScene& scene);

/// C²/n with n projections per substep: a membrane that is projected stretches about 1 + C²/n times as far as
/// stated. 0 where the membrane has no compliance above 0, or the method does not project.
///
/// An iteration carries a wave on by about a cell. Measured on a strip of 1 m that hangs by its end (double
/// precision): its elongation is the stated ρ g L²/2Y times 1 + C²/n, to within a third, for 20 to 10⁴ N/m, 8
/// and 16 cells across a width of 0.25 m, and 1 to 64 substeps × 1 to 40 iterations:
///
///   C²/n                 0.035 0.14  0.22  0.56  0.89  1.4   2.2   3.6   5.6   14    57    360   1420   5690
///   elongation / stated  1.00  0.99  0.96  1.16  1.39  2.1   2.9   4.1   6.9   15    61    390   1510   6050
double excess_stretch(const BuiltScene& scene);

/// Whether tethers would make the membrane's error larger. With tethers cloth does not stretch at all, an
/// error of the whole stated stretch; without tethers the error is C²/n times the stated stretch.
bool membrane_needs_no_tethers(const BuiltScene& scene);

}  // namespace bendlab
