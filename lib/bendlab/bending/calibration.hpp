// Physical stiffness: from the rigidity of a sheet to the softness of each constraint on a mesh.
//
// Bent to a cylinder of curvature κ along a direction d, a sheet has the energy per area
//
//     ½ B κ²    where hinges, arcs or springs that push resist (moment B κ per width), B in N m,
//     ¼ C κ⁴    where springs at rest do (moment C κ³), C in N m³.
//
// The energy of each constraint in the bent sheet is known in advance (unit_bend.hpp), and also the moment at
// each point of the constraint's line. calibrate() finds stiffnesses for which each vertex has the energy of
// its area, in every direction. Springs that end at free edges, denser springs around pins and the directions
// of the mesh limit the accuracy of this fit. Triangles whose corners are all pinned do not bend; a
// constraint that reaches into such triangles is bent less.
//
// A sheet may bend to a shape that is only near a cylinder. At large deflections a membrane that hardly
// stretches forces the sheet to the cylinder, and B is the rigidity of the cylinder. At small deflections the
// sheet finds shapes with less energy (sheet_response.hpp), and B is smaller. Hinges on an equilateral
// lattice have the same B at all deflections. On other meshes the target says at which deflections B holds:
//
//     hinges, all alike          B at small / at large deflections
//     equilateral lattice        1
//     grid, alternating          0.75 in all directions
//     grid, both diagonals       0.74
//     grid, same diagonal        1, but the direction matters: 0.46 to 2.0 times the mean
//     irregular (delaunay)       0.92 to 0.94; 0.97 with Deflection::both
//
// A spring averages the curvature over its length. Springs that push need a membrane that resists their push:
// with a membrane compliance of 10⁻⁷ m/N, strips of 24 cells have 0.70 to 0.84 of the stated B at small
// deflections (1.6 on one diagonal), and 0.92 to 1.31 at large deflections. Arcs of length L push only when
// they are shortened. Below a curvature of about 20 √(B / Y) / L² a membrane of stiffness Y stretches
// instead, and arcs have no linear stiffness.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// At which deflections the sheet has the stated B, for models made of hinges.
enum class Deflection {
  large,  ///< bent to a cylinder, as a stiff membrane makes the sheet bend
  small,  ///< bent so little that the membrane does not matter: all hinges stiffer by one factor
  both,   ///< hinges weighted so that both rigidities differ as little as possible, with B between them
};
inline constexpr std::array<std::string_view, 3> deflection_names = {"large", "small", "both"};

struct CalibrationTarget {
  std::optional<double> flexural_rigidity = {};    ///< B, N m
  std::optional<double> quartic_coefficient = {};  ///< C, N m³
  std::optional<double> at_curvature = {};  ///< κ0, 1/m: C = B/κ0², so that the moment at κ0 is B κ0
  Deflection deflection = Deflection::large;
  /// How B depends on the direction; its mean is flexural_rigidity. Null: B is the same in all directions.
  const DirectedSheet* directed = nullptr;
  /// #T: factors on B and C by place; empty: the same everywhere.
  std::span<const double> factor = {};
};

/// Sets the softness of every constraint so that the sheet meets the target at a compliance of 1. Adds facts
/// (metrics of the model) about the factor on the model's own stiffnesses, the evenness of the energy, and
/// the bending resistance of the membrane itself. For hinges in a flat rest shape, facts also say which share
/// of B the sheet has at small and at large deflections.
///
/// Throws std::invalid_argument if the target does not fit the kind of constraints. For springs, also throws
/// if the rest shape is not flat, or if a spring is not at rest in the rest shape. A target with the
/// deflection `small` or `both` needs hinges, a flat rest shape and enough vertices inside the sheet;
/// otherwise calibrate() throws, too. If B depends on the direction, such a target also needs a warp that has
/// the same direction everywhere.
void calibrate(BendingConstraints& constraints, const RestMesh& rest, const Pins& pins,
               const CalibrationTarget& target);

}  // namespace bendlab
