// What the solver made of the stiffness that a run states: the numbers of its summary, and the warning.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/constraints/effective_stiffness.hpp"

namespace bendlab {

/// Numbers of the summary, each where it has a meaning; effective_stiffness.cpp has the list.
std::map<std::string, double> effective_stiffness_summary(const EffectiveStiffness& stiffness, int substeps);

/// About how many substeps give 90 % where `substeps` give the share `share`, in (0, 1): 1 / share - 1 falls
/// as a power of the substeps, measured on strips of every model (configs/stiffness/effective.json), and this
/// takes a slow one.
double substeps_for_90_percent(double share, int substeps);

inline constexpr const char* soft_solver_code = "soft_solver";

/// The warning for a run with less than half of a stiffness that it was told, with the numbers; nothing for
/// others.
std::optional<std::string> soft_solver_warning(const std::map<std::string, double>& summary);

}  // namespace bendlab
