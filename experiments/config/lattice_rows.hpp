// Which way the rows of an equilateral lattice run where a config does not say.
#pragma once

#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// States /mesh/rows in the settings of a run that has an equilateral mesh and pins whole sides by name, so
/// that edges lie along these sides. A side that zigzags holds the sheet beyond it: each vertex there is
/// joined to three that are pinned or held already, so that a stiff membrane bends only as far as it
/// stretches. Measured on a strip of 0.11 m, B = 2·10⁻⁵ N m, 12 cells: 2.1 times as stiff with 10⁴ N/m, 1.15
/// times with 10² N/m; with edges along its clamp 0.96 and 0.94 times.
void state_rows(Json& settings);

}  // namespace bendlab
