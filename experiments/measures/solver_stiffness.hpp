// What the solver made of the stiffness that a run states: the numbers of its summary, and the warning.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bendlab/constraints/effective_stiffness.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// Looks at a simulation in the last second of a run, every half second and at its end: less than 1 % of 4 s of 1 × 10.
class SolverStiffnessMeter {
 public:
  explicit SolverStiffnessMeter(double duration) : next_look_(duration - 1) {}

  /// After a step; `is_last`: the run ends here. Cheap where it is too early to look.
  void look(const Simulation& simulation, bool is_last);

  /// Of all looks together: the mean share, weighted by energy.
  const EffectiveStiffness& sum() const { return sum_; }

 private:
  double next_look_;  // s
  EffectiveStiffness sum_;
};

/// Of a run's summary, each where it has a meaning (effective_stiffness.hpp):
///   effective_bending_stiffness        1, the share of the bending stiffness told (physical, or a compliance) that the cloth
///   effective_membrane_stiffness       has, and of the membrane's, in the last simulated second
///   substeps_for_90_percent_bending    1, where that is below a half: about so many substeps of as many iterations give 0.9
///   substeps_for_90_percent_membrane   of it
std::map<std::string, double> solver_stiffness_summary(const EffectiveStiffness& stiffness, int substeps);

/// About how many substeps give 90 % where `substeps` give the share `share`, in (0, 1): 1 / share - 1 falls as a power of
/// the substeps, measured on strips of every model (configs/stiffness/effective.json), and this takes a slow one.
double substeps_for_90_percent(double share, int substeps);

inline constexpr const char* soft_solver_code = "soft_solver";

/// The warning for a run with less than half of a stiffness that it was told, with the numbers; nothing for others.
std::optional<std::string> soft_solver_warning(const std::map<std::string, double>& summary);

}  // namespace bendlab
