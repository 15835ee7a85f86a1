// From a few measured settings of a model to others: how its error falls with the work, and what a step
// costs.
#pragma once

#include <optional>
#include <span>

namespace bendlab {

/// error = factor · work^-exponent
struct PowerLaw {
  double factor = 0, exponent = 0;
  double at(double work) const;
};

struct Worked {
  double work = 0;  ///< any unit: projections, or substeps × iterations
  double error = 0;
};

/// Least squares through ln error over ln work, `measured` by rising work. Beyond the last point the error is
/// not taken to fall faster than it did before: the law passes through that point, with the smaller slope of
/// the fit and of the last section. Nothing for fewer than three points, errors that are not positive or
/// do not fall, or scatter by more than a quarter about the line.
std::optional<PowerLaw> fit_power_law(std::span<const Worked> measured);

/// CPU seconds per frame of a model.
struct StepCost {
  double per_substep = 0, per_iteration = 0;
  double at(int substeps, int iterations) const {
    return substeps * (per_substep + iterations * per_iteration);
  }
};

struct Timed {
  int substeps = 1, iterations = 1;
  double cpu_s = 0;
};

/// Least squares, neither part below 0. If all points have the same number of iterations, the whole cost
/// counts as that of iterations. Nothing without points.
std::optional<StepCost> fit_step_cost(std::span<const Timed> measured);

}  // namespace bendlab
