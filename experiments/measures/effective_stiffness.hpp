// The share of the stated stiffness that the solver gives the cloth: metrics of a run, and a warning.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/constraints/effective_stiffness.hpp"

namespace bendlab {

/// The metrics of the measure effective_stiffness that have a meaning in this run.
std::map<std::string, double> effective_stiffness_summary(const EffectiveStiffness& stiffness, int substeps);

/// Estimates how many substeps give 90 % of the stiffness if `substeps` give the share `share`, in (0, 1).
/// The value 1 / share - 1 falls as a power of the substeps. Exponents were measured with strips of every
/// model (configs/stiffness/effective.json). The estimate uses one of the smaller exponents.
double substeps_for_90_percent(double share, int substeps);

/// The smallest share for which the estimate is reliable. Strips with a smaller estimate had up to twice the
/// estimated share. For a cloth that shakes, the estimate is 0, even if a strip of the cloth has a larger
/// share.
inline constexpr double least_known_share = 0.01;

/// "48 %", or "< 1 %" below the smallest reliable share.
std::string share_text(double share);

struct SoftSolver {
  std::string message;
  double share = 1;  ///< the smallest of the shares that the message names
};

/// The warning for a run with less than half of a stated stiffness; nothing for other runs.
std::optional<SoftSolver> soft_solver_warning(const std::map<std::string, double>& summary);

}  // namespace bendlab
