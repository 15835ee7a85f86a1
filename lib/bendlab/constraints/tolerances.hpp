// Limits beyond which an element has no useful direction for a correction. All limits are ratios to the
// element's rest state, so they do not depend on the unit of the mesh.
#pragma once

#include <limits>

namespace bendlab {

/// If the ratio of a length to its rest value is below this limit, the length is only a rounding error and
/// has no direction. The element has collapsed.
template <class Real>
inline constexpr Real collapsed_ratio = 16 * std::numeric_limits<Real>::epsilon();

/// sin² of the smallest angle between warp and weft, 0.06 degrees, at which normalised shear is corrected. At
/// larger angles the published projection overshoots by up to 1 / sin = 1000 element sizes, which is part of
/// the failure that the paper describes. Float and double have the same limit (float rounds 1 - cos² by
/// 2·10⁻⁷), so that float and double show the same failure.
template <class Real>
inline constexpr Real parallel_sine_squared = Real(1e-6);

/// The largest S_11 S_22 at which StrainForm::green opens parallel warp and weft along the rest shape. If
/// S_11 S_22 is larger, the triangle is stretched and |S_12| is large. With the gradient of the rest shape,
/// so large a value would move the triangle much too far.
template <class Real>
inline constexpr Real open_product = 4;

/// The least ratio of Σ w|∇C|² over the free corners to max w · Σ|∇C|² over all corners: 64 ε of the whole
/// gradient, squared. If the ratio is smaller, the gradient of the free corners is only a rounding error, and
/// the constraint does not act. The gradient is so small if moving a free corner does not change C, for
/// example if the only free corner is one end of a hinge's edge and both triangles have a right angle at the
/// other end. In this example C / |∇C|, a quotient of rounding errors, is a random move.
template <class Real>
inline constexpr Real least_lever =
    Real(64 * 64) * std::numeric_limits<Real>::epsilon() * std::numeric_limits<Real>::epsilon();

/// No projection moves a corner farther than this many sizes of its constraint. The size is the longest
/// distance between corners, at rest or now. Regular constraints need less: a hinge of equilateral triangles
/// that opens by π moves a corner by 1.1 edges. Longer moves are meaningless, because a projection is a
/// linear step.
inline constexpr int largest_move = 2;

/// largest_move for the published shear, whose formula overshoots by up to 1 / sin (see
/// parallel_sine_squared).
inline constexpr int largest_published_move = 1000;

/// An element is corrected only if the square of its ratio to the rest value is below this limit. An element
/// above the limit (in float, a billion times its rest value) is overgrown: the powers that projections
/// compute would overflow.
template <class Real>
inline constexpr Real overgrown_square = sizeof(Real) == 4 ? Real(1e18) : Real(1e150);

}  // namespace bendlab
