// Limits beyond which an element has no useful direction for a correction. All are ratios to the element's
// rest state, so they do not depend on the mesh's units.
#pragma once

#include <limits>

namespace bendlab {

/// Below this ratio to its rest value a length is rounding and has no direction.
template <class Real>
inline constexpr Real collapsed_ratio = 16 * std::numeric_limits<Real>::epsilon();

/// sin² of the angle between warp and weft below which normalised shear is not corrected: 0.06 degrees. Above
/// it the published projection overshoots by up to 1 / sin = 1000 element sizes, which is part of the failure
/// that the paper describes. Both precisions have the same limit (float rounds 1 - cos² by 2·10⁻⁷), so that
/// both fail alike.
template <class Real>
inline constexpr Real parallel_sine_squared = Real(1e-6);

/// The largest S_11 S_22 at which StrainForm::green opens parallel warp and weft along the rest shape. Above
/// it |S_12| is the value of a stretched triangle, and with the rest shape's gradient such a value would
/// throw the triangle.
template <class Real>
inline constexpr Real open_product = 4;

/// The least Σ w|∇C|² over the free corners as a share of max w · Σ|∇C|² over all corners: 64 ε of the whole
/// gradient, squared. Below it the gradient is rounding, and the constraint does not act. That happens if a
/// corner's lever vanishes by geometry, for example if the only free corner is one end of a hinge's edge and
/// both triangles have their right angle at the other end. C / |∇C| is then rounding over rounding and would
/// throw the corner anywhere.
template <class Real>
inline constexpr Real least_lever =
    Real(64 * 64) * std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon();

/// No projection moves a corner farther than this many sizes of its constraint. The size is the longest
/// distance between its corners, at rest or now, whichever is longer. Regular constraints stay below it: a
/// hinge of equilateral triangles that opens by π moves by 1.1 edges. Beyond it the linear step of a
/// projection is meaningless.
inline constexpr int largest_move = 2;

/// The same limit for the published shear, whose formula overshoots by up to 1 / sin (see
/// parallel_sine_squared).
inline constexpr int largest_published_move = 1000;

/// An element is corrected only if the square of its ratio to the rest value is below this limit. Beyond it
/// (a billion times the rest value in float) the powers that projections compute would overflow.
template <class Real>
inline constexpr Real overgrown_square = sizeof(Real) == 4 ? Real(1e18) : Real(1e150);

}  // namespace bendlab
