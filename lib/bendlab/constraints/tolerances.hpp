// When an element has no direction left to be corrected along. All are ratios to the element's rest state, so
// they do not depend on the mesh's units.
#pragma once

#include <limits>

namespace bendlab {

/// Below this ratio to its rest value a length is rounding noise and has no direction.
template <class Real>
inline constexpr Real collapsed_ratio = 16 * std::numeric_limits<Real>::epsilon();

/// sin² of the angle between warp and weft below which normalised shear is not corrected: 0.06 degrees from
/// parallel. Above it the published projection overshoots by up to 1 / sin = 1000 element sizes, which is
/// part of the failure that the paper describes. The same for both precisions (float's rounding of 1 - cos²
/// is 2·10⁻⁷), so that both fail alike.
template <class Real>
inline constexpr Real parallel_sine_squared = Real(1e-6);

/// S_11 S_22 up to which plain shear of parallel warp and weft opens along its rest shape. Above it the
/// value, |S_12|, is that of a stretched triangle, and the rest shape's gradient would throw it by as much.
template <class Real>
inline constexpr Real open_product = 4;

/// Σ w|∇C|² over the free corners, as a share of max w · Σ|∇C|² over all, below which a gradient is rounding
/// noise and the constraint does not act: 64 ε of the whole gradient, squared. A corner gets there whose
/// lever vanishes by geometry (the only free end of a hinge's edge, where both triangles have their right
/// angle at the other end): C / |∇C| is then noise over noise, and would throw it anywhere.
template <class Real>
inline constexpr Real least_lever =
    Real(64 * 64) * std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon();

/// No projection moves a corner farther than this many sizes of its constraint (the longest distance between
/// its corners, at rest or now, whichever is longer). Regular constraints stay below it (a hinge of
/// equilateral triangles that opens by π moves by 1.1 edges); above it the linear step of a projection says
/// nothing about the constraint.
inline constexpr int largest_move = 2;

/// The same of the published shear, whose own formula overshoots by up to 1 / sin: see parallel_sine_squared.
inline constexpr int largest_published_move = 1000;

/// Above this square of its ratio to its rest value an element is not corrected: a billion times too large in
/// float, and the powers of it that projections take would overflow.
template <class Real>
inline constexpr Real overgrown_square = sizeof(Real) == 4 ? Real(1e18) : Real(1e150);

}  // namespace bendlab
