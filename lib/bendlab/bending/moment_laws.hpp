// Moments that are not linear in the curvature, for the elements of a calibrated model: softening, internal
// friction (hysteresis) and plastic folds. See constraints/moment_law.hpp.
#pragma once

#include <optional>
#include <span>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// Internal friction: M = B κ ± moment. The friction grows linearly over the curvature `slip` after each
/// reversal.
struct Hysteresis {
  double moment = 0;  ///< HB, N (N m per m of width)
  double slip = 0;    ///< 1/m
};

/// Plastic folds: beyond the curvature `yield` the moment grows with `hardening` times B.
struct Plasticity {
  double yield = 0;      ///< 1/m
  double hardening = 0;  ///< in [0, 1)
};

struct MomentTarget {
  double rigidity = 0;  ///< B, N m, with which calibrate() was called
  SofteningLaw softening = {};
  std::optional<Hysteresis> hysteresis = {};
  std::optional<Plasticity> plasticity = {};
  /// #T: factors by place on the rigidity, on Hysteresis::moment and on Plasticity::yield; empty: 1.
  std::span<const double> rigidity_factor = {}, friction_factor = {}, yield_factor = {};
};

/// Gives the elements of a calibrated model nonlinear moments. Hysteresis doubles the elements: each has a
/// copy that resists with friction alone. Throws std::invalid_argument if the model has springs or elements
/// of its own, whose curvature is not known, or if its elements cannot yield.
///
/// Models of triangles have the stated moments in every direction. Hinges have them only in the mean over all
/// directions: softening is right to the order κ², and the moments of friction and of plastic folds are right
/// for curvatures far above the yield. If the rigidity depends on the direction, stated curvatures and
/// moments are those of the mean rigidity. In the direction φ of models of triangles, curvatures are divided,
/// and moments multiplied, by √(D(φ) / mean of D). Hinges have the stated curvatures in all directions, so
/// their moments vary as their rigidity does.
void set_moments(BendingConstraints& constraints, const BendingInput& input, const MomentTarget& target);

}  // namespace bendlab
