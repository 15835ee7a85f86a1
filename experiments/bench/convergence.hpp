// Compares the strain errors after rounds over the constraints (sweeps) by colour and in mesh order.
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

/// Number of edges along the long side of each scene's cloth.
inline constexpr int convergence_cells = 32;

/// The strain error that each order leaves after one step of `sweeps` sweeps: the mean over triangles of
/// max(|σ₁ - 1|, |σ₂ - 1|).
struct ConvergenceError {
  int sweeps = 0;
  double colour = 0, mesh = 0;
  double from_pins = 0, to_pins = 0;  ///< one constraint after another, sorted by edges to a pin
  double colour_from_pins = 0;        ///< by colour; the colours are found in the order from_pins
  /// The number of sweeps that `colour` needs for the error that `mesh` leaves after `sweeps`; 0: more than 4
  /// (sweeps + convergence_cells).
  int sweeps_to_match = 0;
};

/// Every order does one step in double precision from the same state: positions and velocities of the scene
/// after 0.5 s.
std::vector<ConvergenceError> convergence_errors(const ConvergenceScene& scene, std::span<const int> sweeps);

}  // namespace bendlab
