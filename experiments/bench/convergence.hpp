// Compares the strain error that sweeps in coloured order leave with the strain error in mesh order.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace bendlab {

struct ConvergenceScene {
  std::string_view name, config;  ///< config as JSON text
};

/// A square that hangs from a corner, a strip from its top edge, an irregular square from two corners.
std::span<const ConvergenceScene> convergence_scenes();

/// Edges along the long side of each scene.
inline constexpr int convergence_cells = 32;

/// Strain error, the mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|), after one step of `sweeps` sweeps.
struct ConvergenceError {
  int sweeps = 0;
  double colour = 0, mesh = 0;
  double from_pins = 0, to_pins = 0;  ///< one constraint after another, sorted by edges to a pin
  double colour_from_pins = 0;        ///< by colour; the colours are found in the order from_pins
  /// The fewest sweeps after which `colour` leaves no more error than `mesh`; 0: more than four times (sweeps
  /// + convergence_cells).
  int sweeps_to_match = 0;
};

/// Every order does one step in double precision from the same state: positions and velocities of the scene
/// after 0.5 s.
std::vector<ConvergenceError> convergence_errors(const ConvergenceScene& scene, std::span<const int> sweeps);

}  // namespace bendlab
