// How much of the stated stiffness the solver gives a run: the numbers of its summary, and the warning.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/constraints/effective_stiffness.hpp"

namespace bendlab {

/// Numbers of the summary, those that have a meaning in this run; effective_stiffness.cpp lists them.
std::map<std::string, double> effective_stiffness_summary(const EffectiveStiffness& stiffness, int substeps);

/// About how many substeps give 90 % if `substeps` give the share `share`, in (0, 1): 1 / share - 1 falls as
/// a power of the substeps. Strips of every model were measured (configs/stiffness/effective.json); this
/// uses a small exponent of those found.
double substeps_for_90_percent(double share, int substeps);

/// The least share that the estimate knows: below 0.01 strips had up to twice what it said, and for a cloth
/// that shakes it says 0 whatever a strip of it measures.
inline constexpr double least_known_share = 0.01;

/// "48 %", or "< 1 %" below what the estimate knows.
std::string share_text(double share);

struct SoftSolver {
  std::string message;
  double share = 1;  ///< the smallest of the shares that the message names
};

/// The warning for a run with less than half of a stated stiffness; nothing for other runs.
std::optional<SoftSolver> soft_solver_warning(const std::map<std::string, double>& summary);

}  // namespace bendlab
