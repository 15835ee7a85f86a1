// How much too far a membrane stretches if it is simulated by projections.
#pragma once

namespace bendlab {

struct BuiltScene;

/// The Courant number C of a membrane: the number of cells that a stretching wave crosses in a substep. The
/// wave has the speed √(Y/ρ), with the stiffness Y = 1 / compliance (N/m) and the mass ρ per area. The
/// compliance must be above 0.
double courant_number(const BuiltScene& scene);

/// C²/n, where n is the number of projections per substep. A projected membrane stretches about 1 + C²/n
/// times as far as its stiffness allows. 0 if no compliance above 0 is stated, or if the method does not
/// project.
///
/// The reason is that a wave moves by about a cell in each iteration. Tested with a strip of L = 1 m that
/// hangs by its end (double precision, 20 to 10⁴ N/m, 8 and 16 cells across a width of 0.25 m, 1 to 64
/// substeps × 1 to 40 iterations): its elongation is the stated ρ g L²/2Y times 1 + C²/n, to within a third.
///
///   C²/n                 0.035 0.14  0.22  0.56  0.89  1.4   2.2   3.6   5.6   14    57    360   1420   5690
///   elongation / stated  1.00  0.99  0.96  1.16  1.39  2.1   2.9   4.1   6.9   15    61    390   1510   6050
double excess_stretch(const BuiltScene& scene);

/// Whether the membrane's error would be larger with tethers. With tethers the cloth does not stretch, so the
/// error is the whole stated stretch. Without tethers the error is C²/n times the stated stretch.
bool membrane_needs_no_tethers(const BuiltScene& scene);

}  // namespace bendlab
