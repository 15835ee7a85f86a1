// Settings that may be advised, and trials: settings that were run, with their results. A trial is fit if
// its strain, stretch and error are small enough to advise its setting.
#pragma once

#include <compare>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/run/warning.hpp"

namespace bendlab {

/// A bending model, a solver with its work (substeps and iterations), and a mesh. The cloth, its pins and the
/// effects on it stay as in the config.
struct Setting {
  std::string model, method;
  std::string solver = "{}";  ///< further settings of the method, as JSON
  int substeps = 1, iterations = 1;
  int cells = 0;  ///< /mesh/cells; 0: the config's own mesh

  auto operator<=>(const Setting&) const = default;
};

/// Settings that differ only in their work.
struct SettingKind {
  Setting setting;                         ///< with any work
  std::vector<std::pair<int, int>> works;  ///< substeps and iterations to be tried
};

/// The kinds of settings that were the best of a measured scene (fronts.def), for the config's own mesh.
const std::vector<SettingKind>& measured_fronts();

/// "levels 12", "membrane auto, integrator bdf2".
std::string solver_text(const Setting& setting);

/// "dihedral, pbd (levels 12), 8 substeps, 1 iteration, 24 cells".
std::string setting_text(const Setting& setting);

/// The demand of the user: either a largest error or a largest time.
struct Demand {
  std::optional<double> error;  ///< in sizes of the mesh
  std::optional<double> cpu_s;  ///< CPU seconds per frame of 1/60 s of simulated time
};

/// "5%" or "0.05" → 0.05. Throws std::invalid_argument if the value is not between 0 and 1.
double parse_error(const std::string& text);

/// "2ms", "0.002s", "500us" or "2min" → seconds. Throws std::invalid_argument if the unit is missing or the
/// number is not above 0.
double parse_duration(const std::string& text);

/// 0.0512 → "5.1" and "5.1 %".
std::string percent_number(double share);
std::string percent_text(double share);

/// A setting that was run, and the results.
struct Trial {
  Setting setting;
  /// Rms distance from the reference, in sizes of the mesh; infinite: not compared.
  double error = std::numeric_limits<double>::infinity();
  double cpu_s = 0;          ///< CPU seconds of the steps, per frame
  double strain = 0;         ///< rms of the Green strain
  double more_strain = 0;    ///< the strain less that of the reference, at least 0
  double stretch = 1;        ///< the largest of a triangle, over that of the reference, at least 1
  double speed = 0;          ///< rms at the end, sizes per second
  bool implausible = false;  ///< the run broke a bound that its scene cannot break
  bool unfinished = false;   ///< the run was stopped, and nothing else is known
  bool failed = false, diverged = false;
  std::string why{};  ///< why the run failed or has no error
  std::vector<Warning> warnings{};
};

/// Limit of Trial::error for a setting that is advised. The points of a square lie 0.29 sizes (rms) from
/// its middle. A sheet that is crumpled into this middle has the error 0.29, and 0.2 is most of that error.
inline constexpr double largest_error = 0.2;

/// Limit of Trial::more_strain. Woven cloth stretches by less than a tenth when it is worn (Provot 1995 and
/// Bridson 2003 limit their springs to a tenth).
inline constexpr double largest_strain = 0.1;

/// Limit of Trial::stretch. Woven cloth tears at 1.05 to 1.4, and a triangle at a pin shows a tear as a
/// spike.
inline constexpr double largest_stretch = 1.5;

/// Why the setting of a trial is never advised, whatever the demand: the first of "implausible", "strain",
/// "stretch" and "error" that applies. Empty if the trial is fit.
std::string_view unfit(const Trial& trial);

/// The error of a fit trial. For an unfit trial, largest_error times the largest ratio (at least 1) of
/// strain, stretch and error to their limits. So a search demands more work until a trial is fit.
double judged_error(const Trial& trial);

/// For a demanded error, the time times max(1, error / demanded error). For a demanded time, the error
/// times max(1, time / demanded time). Less is better.
double score(const Trial& trial, const Demand& demand);

/// Whether a trial is fit, and as accurate or as fast as demanded.
bool meets(const Trial& trial, const Demand& demand);

/// The fastest trial that meets a demanded error, or the most accurate trial that meets a demanded time. If
/// no fit trial meets the demand, the fit trial that comes nearest to the demand. If no trial is fit, the
/// trial that exceeds its limits least, preferably within the demanded time.
std::optional<Trial> choice_of(std::span<const Trial> trials, const Demand& demand);

/// The fit trials that are more accurate than every faster fit trial, the fastest first. Of equal trials
/// the first is taken.
std::vector<Trial> front_of(std::span<const Trial> trials);

/// A front with fewer trials: the first trial, then each trial that is a tenth more accurate than the last
/// one taken, and the front's last trial.
std::vector<Trial> thinned(std::span<const Trial> front);

}  // namespace bendlab
