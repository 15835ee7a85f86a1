// A bound on the excess length of springs that push in the flat sheet. Some solvers cannot balance the push.
//
// Springs of length L with the forces f put the tension T = Σ f L / 2A (N/m) on the membrane. A membrane
// that is projected n times per substep h resists as if its stiffness were about n m / h², where m is the
// mass of a vertex, whatever stiffness was stated. So the sheet grows by
//
//     G = T h² / (n m)           if the springs keep pushing,
//     1 / (1/excess + 1/G)       because the springs stop pushing once the sheet has grown by their excess.
//
// If the growth is more than a few percent, vertices jump over their neighbours. Calibration gives the flat
// sheet the same push for every excess, but springs with a smaller excess stop pushing sooner. So the excess
// is lowered until the growth is bounded. The moment is then linear only up to a smaller curvature, but a
// sheet that has not converged does not show the difference.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// Largest accepted relative growth of a sheet. If a run has so few substeps that the bound matters, gravity
/// alone stretches the sheet by more. Measured with an excess of 1: sheets with an estimated growth of 0.06
/// or more may be torn apart; sheets with an estimated growth of up to 0.05 were not.
inline constexpr double tolerated_growth = 0.04;

/// How far springs that push would stretch the sheet, and the excess that keeps this stretch small.
struct PushBound {
  double tension = 0;       ///< T, N/m
  double growth = 0;        ///< G, relative
  double stated = 0;        ///< the largest excess of a spring
  double taken = 0;         ///< the largest excess after bound_push()
  double length = 0;        ///< of the longest spring that pushes, m
  double expected = 0;      ///< relative growth of the sheet with the stated excess
  int substeps_factor = 1;  ///< factor on the substeps with which the solver can use the stated excess
};

/// N/m: the tension T with which springs that push stretch the rest shape, at this compliance; 0 if no spring
/// pushes.
double push_tension(const DistanceConstraints& springs, const RestMesh& rest, double compliance);

/// A warning if a membrane of this compliance (m/N) gives way to this tension (N/m), with a remedy. Nothing
/// if the membrane resists the tension.
std::optional<std::string> push_on_membrane_warning(double tension, double compliance);

/// Lowers the excess of all springs until the growth is at most `tolerated_growth`, without a change of the
/// springs' push in the rest shape. Changes nothing if the growth is already small enough. `springs` are
/// calibrated (forces at a compliance of 1), `mass` is #V in kg, `substep` is in s, `projections` is how
/// often a substep projects each constraint. Returns nothing if no spring pushes.
std::optional<PushBound> bound_push(DistanceConstraints& springs, const RestMesh& rest,
                                    std::span<const double> mass, double substep, int projections);

/// Facts for the run's summary.
std::vector<BendingFact> facts_of(const PushBound& bound);

/// A warning to print before the run, with numbers and a remedy. Nothing if the excess was not lowered.
std::optional<std::string> push_warning(const PushBound& bound);

}  // namespace bendlab
