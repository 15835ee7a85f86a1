// Springs that push in the flat sheet, and a solver that can't hold them.
//
// With the forces f, springs of length L put the tension T = Σ f L / 2A (N/m) on the membrane. A membrane
// that is projected n times per substep h resists like one of a stiffness of about n m / h², m a vertex's
// mass, however stiff it was told to be. So the sheet grows by
//
//     G = T h² / (n m)     where the springs keep pushing,     1 / (1/excess + 1/G)     at most by their excess,
//
// and where that is more than a few percent, vertices are thrown over their neighbours. The push in the flat
// sheet is the same for every excess (calibration makes it so): a smaller one lets go sooner. So it is made
// as small as bounds the growth; the moment is then linear up to a smaller curvature, which an unconverged
// sheet does not show.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// 1; below what gravity does to a sheet at such substeps. Measured with an excess of 1: sheets that would
/// grow by 0.06 and more may be torn apart, up to 0.05 none was.
inline constexpr double tolerated_growth = 0.04;

/// What a solver makes of springs that push.
struct PushBound {
  double tension = 0;       ///< T, N/m
  double growth = 0;        ///< G: by how much the solver's own membrane would give way, relative
  double told = 0;          ///< the largest excess of a spring
  double taken = 0;         ///< the same after bound_push()
  double length = 0;        ///< of the longest spring, m
  double expected = 0;      ///< by how much the sheet would grow with the told excess
  int substeps_factor = 1;  ///< how many times as many substeps hold the told excess
};

/// `springs` as calibrated (forces at a compliance of 1), `mass` #V in kg, `substep` in s, `projections` of
/// each constraint in it. Makes the excess of all springs as small as keeps the growth within
/// `tolerated_growth`, at the same push in the rest shape; changes no bit where that holds already. Nothing
/// where no spring pushes.
std::optional<PushBound> bound_push(DistanceConstraints& springs, const RestMesh& rest,
                                    std::span<const double> mass, double substep, int projections);

/// What the run's summary has of it.
std::vector<BendingFact> facts_of(const PushBound& bound);

/// What to tell before the run, with numbers and what helps; nothing where the told excess was kept.
std::optional<std::string> push_warning(const PushBound& bound);

}  // namespace bendlab
