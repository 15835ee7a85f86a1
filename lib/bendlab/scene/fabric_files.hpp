// Reads measurements of textile laboratories: bending curves of Kawabata's KES-FB2, bending lengths of ASTM
// D1388, and material files of ARCSim.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// What a measurement says of the bending of a fabric in one direction.
struct BendingMeasurement {
  double rigidity = 0;  ///< B, N m
  double friction = 0;  ///< HB, N
};

/// A cycle of KES-FB2: two columns of numbers, the curvature in 1/cm and the moment per width in gf cm/cm,
/// for example from 0 to 2.5, to -2.5 and back. Lines before the first number are titles. B is the
/// slope between 0.5 and 1.5 /cm, the mean of both sides and of bending and unbending; 2HB is the difference
/// of the moments of bending and unbending at 1 /cm, the mean of both sides. Throws std::invalid_argument if
/// the file has no such curve.
BendingMeasurement kes_bending(const std::filesystem::path& file);

/// The bending length c of a direction: half of the overhang at 41.5 degrees. The file has lines with the
/// direction (warp, weft, bias) and the overhang in mm. B = W c³ g with the mass per area W.
struct BendingLengths {
  std::string direction;
  double length = 0;       ///< c, m: the mean
  double uncertainty = 0;  ///< standard uncertainty of the mean, m
  std::size_t specimens = 0;
};
std::vector<BendingLengths> astm_bending_lengths(const std::filesystem::path& file);

/// Converts a material file of ARCSim to settings of a config: density and rigidity. The file has the
/// bending stiffness k of hinges for edges at 0, 45 and 90 degrees to the warp, at five curvatures. Hinges of
/// the energy k l² θ² / 8 (a0 + a1), edge l and areas a, give a sheet of equilateral triangles B = k/4.
Json arcsim_settings(const std::filesystem::path& file);

}  // namespace bendlab
