// Springs that push in the flat sheet, and a solver that can't hold them.
//
// Springs of length L with the forces f put the tension T = Σ f L / 2A (N/m) on the membrane. A membrane
// that is projected n times per substep h resists like one with a stiffness of about n m / h², m a vertex's
// mass, whatever stiffness was stated. So the sheet grows by
//
//     G = T h² / (n m)           if the springs keep pushing,
//     1 / (1/excess + 1/G)       because their excess bounds it.
//
// If that is more than a few percent, vertices are thrown over their neighbours. Calibration gives the flat
// sheet the same push for every excess, but springs with a smaller excess stop pushing sooner. So the excess
// is lowered until the growth is bounded. The moment is then linear up to a smaller curvature only; an
// unconverged sheet does not show that.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// 1; gravity stretches a sheet by more at such substeps. Measured with an excess of 1: a sheet that would
/// grow by 0.06 or more may be torn apart; up to 0.05 none was.
inline constexpr double tolerated_growth = 0.04;

/// How far springs that push would stretch the sheet, and the excess that keeps this small.
struct PushBound {
  double tension = 0;       ///< T, N/m
  double growth = 0;        ///< G, relative
  double stated = 0;        ///< the largest excess of a spring
  double taken = 0;         ///< the same after bound_push()
  double length = 0;        ///< of the longest spring, m
  double expected = 0;      ///< relative growth of the sheet with the stated excess
  int substeps_factor = 1;  ///< how many times as many substeps hold the stated excess
};

/// N/m: the tension T with which springs that push stretch the rest shape, at this compliance; 0 if none
/// pushes.
double push_tension(const DistanceConstraints& springs, const RestMesh& rest, double compliance);

/// Why a membrane of this compliance (m/N) gives way to that tension, and what helps; nothing if it holds it.
std::optional<std::string> push_on_membrane_warning(double tension, double compliance);

/// Lowers the excess of all springs until the growth is at most `tolerated_growth`, with the same push in the
/// rest shape; changes no bit if it is already. `springs` are calibrated (forces at a compliance of 1),
/// `mass` is #V in kg, `substep` in s, `projections` those of each constraint in a substep. Returns nothing
/// if no spring pushes.
std::optional<PushBound> bound_push(DistanceConstraints& springs, const RestMesh& rest,
                                    std::span<const double> mass, double substep, int projections);

/// For the run's summary.
std::vector<BendingFact> facts_of(const PushBound& bound);

/// The warning before the run, with numbers and what helps; nothing if the stated excess was kept.
std::optional<std::string> push_warning(const PushBound& bound);

}  // namespace bendlab
