// The share of the stated stiffness that the solver gives a run: the metrics of its summary, and the warning.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/constraints/effective_stiffness.hpp"

namespace bendlab {

/// Metrics of the summary that have a meaning in this run; effective_stiffness.cpp lists them.
std::map<std::string, double> effective_stiffness_summary(const EffectiveStiffness& stiffness, int substeps);

/// About how many substeps give 90 % if `substeps` give the share `share`, in (0, 1): 1 / share - 1 falls as
/// a power of the substeps. The exponent was measured with strips of every model
/// (configs/stiffness/effective.json). This function uses a small exponent of the measured range.
double substeps_for_90_percent(double share, int substeps);

/// The smallest share for which the estimate is reliable. Below 0.01, strips had up to twice the estimated
/// share. For a cloth that shakes, the estimate is 0, whatever a strip of that cloth measures.
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
