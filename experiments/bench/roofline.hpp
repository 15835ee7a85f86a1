// The roofline: the least time that a projection can take on this machine (Williams, Waterman & Patterson
// 2009, with a bandwidth for every cache and the memory, as in Yang et al. 2020).
//
//   time ≥ max( flops / peak,
//               (streamed + corners) / bandwidth of the first-level cache,
//               (streamed + points)  / bandwidth of the cache or memory that holds the whole scene )
//
// with all sizes in bytes per constraint. Streamed: the indices of the constraint, 4 bytes each, and its rest
// data. Corners: position and inverse mass (four scalars, read and written) of each corner that is not in a
// register already. These are all corners of a triangle, but only one corner of a spring, because successive
// springs share the other corner. Points: the same four scalars of every vertex, loaded once per round over
// the constraints (even the best order has to load them), divided by the number of constraints. The bandwidth
// is that of a triad a = b + s c on arrays of the same total size. The peak is that of independent
// multiply-adds in registers. This process measures bandwidth and peak on one thread.
//
// Flops are counted in the kernels' formulas: an addition, multiplication, division or square root is one
// flop. The comments below list the parts of each formula, with the flops of a part in parentheses.
#pragma once

#include <cstddef>

namespace bendlab {

/// The cost of one constraint of a kind.
struct ConstraintCost {
  int corners = 0;  ///< that are not in a register already, see above
  int rest_scalars = 0;
  double flops = 0;
  int moved_scalars = 8;  ///< per corner: four are read and written; forces read four more
};

/// Flops: d (3), |d| (6), Σw (1), k (l0 - l) / (l Σw) (4), two corrections (14).
inline constexpr ConstraintCost distance_cost{.corners = 1, .rest_scalars = 1, .flops = 28};

/// Flops of warp, and again of weft: edges (6), f (9), |f| (6), error (1), Σ w|∇C|² (10), step (2), three
/// corrections (24). Flops of shear: edges (6), f1 and f2 (18), three products (15), inverse and test (5), a1
/// and a2 (16), gradients (18), Σ w|∇C|² (23), step (2), corrections (21).
inline constexpr ConstraintCost strain_cost{.corners = 3, .rest_scalars = 4, .flops = 240};

/// Flops: five scaled differences (30), normals (18), |e|², |n1|², |n2|² (15), sine and cosine (12), arc
/// tangent (20), wrap (3), reciprocals (6), gradients (60), Σ w|∇C|² (24), step (3), four corrections (28).
inline constexpr ConstraintCost hinge_cost{.corners = 4, .rest_scalars = 2, .flops = 219};

/// Flops: Kx (24), |Kx| (6), gradients (16), Σ w|∇C|² (24), step (4), four corrections (28).
inline constexpr ConstraintCost quadratic_cost{.corners = 4, .rest_scalars = 6, .flops = 102};

/// A triangle without directors. Flops: edges, normal and area (21); at each of three edges (429): vectors
/// and lengths (17), direction inwards (12), feet (15), the neighbour's normal (21), sine and cosine (10),
/// arc tangent (20), measure (26), turn and its gradient (22); U u and its length (23), weights (12),
/// gradients (126), Σ w|∇C|² (36), step (4), six corrections (42).
inline constexpr ConstraintCost face_cost{.corners = 6, .rest_scalars = 13, .flops = 693};

/// A triangle with directors. Flops: face_cost (693), three directors with their angles (6), gradients (9),
/// Σ w|∇C|² (6) and corrections (6).
inline constexpr ConstraintCost mid_edge_cost{.corners = 9, .rest_scalars = 16, .flops = 720};

/// A vertex and its ring, 13 corners with the padding. Flops: Kx (72), |Kx| (6), gradients (52), Σ w|∇C|²
/// (78), step (4), corrections (91).
inline constexpr ConstraintCost laplacian_cost{.corners = 13, .rest_scalars = 15, .flops = 303};

/// With k. Flops: d and |d| (9), C (1), ∇C (3), Σ w|∇C|² (12), step (2), two corrections (14).
inline constexpr ConstraintCost arc_cost{.corners = 2, .rest_scalars = 1, .flops = 41};

/// With a compliance, in float. Flops: arc_cost (41), load and shares (25), first guess (20), two series of 8
/// terms (28), three Newton steps, each with both series again (16 + 28), last step (20). The kernel also
/// reads α and λ, and writes λ.
inline constexpr ConstraintCost compliant_arc_cost{.corners = 2, .rest_scalars = 4, .flops = 266};

/// Elastic forces. Flops of warp, and again of weft: f (9), |f| (6), multiplier (6), three forces (22). Flops
/// of shear, by the angle: products (17), inverse and normal (16), arc tangent (20), a1 and a2 (16),
/// gradients (18), multiplier (6), forces (21). Edges and α (12).
inline constexpr ConstraintCost strain_force_cost{
    .corners = 3, .rest_scalars = 4, .flops = 212, .moved_scalars = 12};

/// Elastic forces. Flops: the part of hinge_cost up to the gradients (164), multiplier (2), four forces (24).
/// Each hinge has its own α.
inline constexpr ConstraintCost hinge_force_cost{
    .corners = 4, .rest_scalars = 3, .flops = 190, .moved_scalars = 12};

/// Bytes of indices and rest data of one constraint.
std::size_t streamed_bytes(const ConstraintCost& cost, std::size_t scalar_bytes);

/// Least seconds per constraint. `scalar_bytes`: 4 or 8; `scene_bytes`: all bytes that a round over all
/// constraints reads.
double roofline_seconds(const ConstraintCost& cost, std::size_t scalar_bytes, double points_per_constraint,
                        std::size_t scene_bytes);

/// Least seconds of a forward and a backward solve for x, y and z, with a sparse triangular factor of
/// `entries` entries. Each entry is read twice, and multiplies three numbers each time.
double solve_roofline_seconds(std::size_t entries, std::size_t scalar_bytes);

/// Bytes per second of a triad on arrays of `bytes` in total, measured once per size.
double triad_bandwidth(std::size_t bytes);

/// Floating-point operations per second; scalar_bytes 4 or 8. Measured once.
double peak_flops(std::size_t scalar_bytes);

}  // namespace bendlab
