// Which substeps, iterations and precisions of a solver method are tried. A method climbs one of substeps and
// iterations, by what its error falls with; the other is raised where that pays.
//
//                climbs        rungs                 between     the other
//   pbd          substeps      1 2 4 8 … 256         3 6 … 192   iterations 1 2 4 10
//   quasi_newton iterations    1 2 3 5 10 20                     substeps 1 2 4
//   newton       iterations    1 2 4 20                          substeps 1 2 4 8 16
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/advise/front.hpp"

namespace bendlab {

/// The methods that advice is given on. The others are there to be compared with.
inline constexpr std::array<std::string_view, 3> advised_methods = {"pbd", "quasi_newton", "newton"};

struct Ladder {
  bool climbs_iterations;          ///< else substeps
  std::span<const int> rungs;      ///< from the coarsest on
  std::span<const int> between;    ///< tried where the rungs beside them leave it open
  std::span<const int> alongside;  ///< of the other one, from the fewest on
  bool in_single;                  ///< else in double precision only

  int rung(const Setting& setting) const;
  int other(const Setting& setting) const;
  Setting with_rung(Setting setting, int rung) const;
  Setting with_other(Setting setting, int other) const;

  /// The setting so many rungs below, or nothing.
  std::optional<Setting> below(const Setting& setting, int rungs_below) const;
  /// How many rungs are below it.
  int height(const Setting& setting) const;
  bool is_between(const Setting& setting) const;
  /// Whether it is in the better of two precisions.
  bool is_precise(const Setting& setting) const { return in_single && setting.double_precision; }
  /// Whether it is of the way up that every kind is tried on.
  bool on_main_way(const Setting& setting) const;

  /// What a kind's settings differ in, without the rung.
  std::vector<Setting> ways(const Setting& kind) const;
  /// Rungs and those between, from the coarsest on.
  std::vector<int> all_rungs() const;
};

/// Of one of advised_methods.
const Ladder& ladder_of(const Setting& setting);

/// The same kind on its lowest rung.
Setting coarsest(const Setting& setting);

}  // namespace bendlab
