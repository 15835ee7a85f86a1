// The shape of triangles: seven metrics, and numbers of bad triangles. Fast enough for every frame of a run.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Limits from which on a triangle counts as bad.
struct QualityThresholds {
  double needle_ratio = 4;  ///< longest to shortest edge, 1 or more: this ratio and larger ratios are bad
  double cap_angle = 160;   ///< degrees, 90 to 180: this angle and larger angles are bad
  double small_angle = 10;  ///< degrees, 0 to 60: smaller angles are bad
};

struct QualityMeasure {
  std::string_view name, unit, meaning;
};

/// The shape metrics, in the order of MeshQuality::measures. Formulas: Verdict library reference manual,
/// SAND2007-1751. With edges a, b, c and area A:
///   edge_ratio     longest / shortest edge
///   aspect_ratio   longest edge · (a + b + c) / (4√3 A)
///   radius_ratio   circumradius / (2 inradius) = abc (a + b + c) / (16 A²)
///   shape          4√3 A / (a² + b² + c²), 0 to 1
///   minimum_angle, maximum_angle in degrees
///   condition      κ₂ of Q weighted by the equilateral triangle: x + √(x² - 1) with x = 1 / shape
/// All but the angles are 1 for an equilateral triangle.
std::span<const QualityMeasure> quality_measures();

/// Summary of a shape metric over all triangles. A percentile is the value with the nearest rank; it is not
/// interpolated, because values may be infinite. A triangle without area has shape 0, angles 0 and 180, and
/// infinity in the other metrics except edge_ratio. If a position is not finite, edge_ratio is infinite, too.
struct MeasureSummary {
  double minimum, percentile_1, median, percentile_99, maximum;
};

struct MeshQuality {
  std::array<MeasureSummary, 7> measures{};  ///< all 0 if there are no triangles
  int needles = 0;       ///< longest edge >= needle_ratio · shortest (CGAL's is_needle_triangle_face)
  int caps = 0;          ///< an angle >= cap_angle and no edge of length 0 (CGAL's is_cap_triangle_face)
  int collinear = 0;     ///< the three points are collinear by CGAL's exact predicate
  int non_finite = 0;    ///< a coordinate, or a difference of two coordinates, is not finite
  int small_angles = 0;  ///< an angle < small_angle
  int degenerate_triangles = 0;  ///< needle, cap, collinear or not finite; each triangle counts once
};

/// `triangles` index into `positions`. Throws nothing: positions may be non-finite.
MeshQuality measure_quality(const Positions& positions, const Triangles& triangles,
                            const QualityThresholds& thresholds = {});

}  // namespace bendlab
