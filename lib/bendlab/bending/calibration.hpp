// Physical stiffness: from what the sheet is to resist to the softness of each constraint, on the mesh at hand.
//
// Bent to a cylinder of curvature κ along a direction d, a sheet has the energy per area
//
//     ½ B κ²    where hinges, arcs or springs that push resist (moment B κ per width), B in N m,
//     ¼ C κ⁴    where springs at rest do (moment C κ³), C in N m³.
//
// Each constraint's energy is known in advance (unit_bend.hpp), and with which moment it resists at each place of its
// line. calibrate() finds stiffnesses with which every vertex has its area's share, in all directions: as far as springs
// that end at free edges, denser springs around pins and the mesh's own directions allow. Triangles with all corners
// pinned do not bend, and a constraint that reaches among them sees as much less of the curvature.
//
// What it does not know: that a sheet may bend otherwise than to a cylinder between its vertices. On irregular meshes
// hinges let it, and are about a tenth softer than asked; a spring averages the curvature over its length.
#pragma once

#include <optional>

#include "bendlab/bending/model.hpp"

namespace bendlab {

struct CalibrationTarget {
  std::optional<double> flexural_rigidity = {};    ///< B, N m
  std::optional<double> quartic_coefficient = {};  ///< C, N m³
  std::optional<double> at_curvature = {};  ///< κ0, 1/m: gives C = B/κ0², so that the moment at κ0 is B κ0
};

/// Sets the softness of every constraint so that the sheet meets the target at a compliance of 1. Adds facts: what the
/// model's own stiffnesses were multiplied by, how evenly the energy is spread, what the membrane resists by itself.
/// Throws std::invalid_argument where the target is not of the kind that the constraints need, and for springs in a
/// rest shape that is not flat or in which they are not at rest.
void calibrate(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
               const CalibrationTarget& target);

}  // namespace bendlab
