// Settings with their error and time, which of them are worth having, and the one that fits a demand.
#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/advise/demand.hpp"
#include "experiments/advise/fitness.hpp"
#include "experiments/advise/variant.hpp"

namespace bendlab {

struct Setting {
  std::string model;
  int substeps = 1, iterations = 1;
  bool double_precision = false;
  Variant variant{};

  auto operator<=>(const Setting&) const = default;
};

/// Whether they differ in substeps, iterations and precision only.
inline bool same_kind(const Setting& a, const Setting& b) {
  return a.model == b.model && a.variant == b.variant;
}

struct Rated {
  Setting setting;
  double error = 0;  ///< in sizes of the mesh; infinite: not compared, because its strain is unfit
  double cpu_s = 0;  ///< per frame
  bool predicted = false;
  Strained strained{};
};

Unfit unfit(const Rated& point);

/// Those that may be advised.
std::vector<Rated> fit_ones(std::span<const Rated> points);

/// The fit points that no other fit one beats in both error and time, the fastest first. Of equal ones the
/// first.
std::vector<Rated> front_of(std::span<const Rated> points);

/// The unfit points that are faster than every fit one, and less beyond the limits than all faster ones.
std::vector<Rated> unfit_front_of(std::span<const Rated> points);

/// Of a front the points that are a tenth more accurate than the one before them, and the last.
std::vector<Rated> thinned(std::span<const Rated> front);

/// The fastest fit point whose error is at most the demanded one, or the most accurate fit one whose time is.
std::optional<Rated> chosen(std::span<const Rated> points, const Demand& demand);

/// If no point meets the demand, the one that comes nearest: the most accurate fit one, or the fastest fit
/// one. If none is fit, the one that is least beyond the limits, preferably within the demanded time.
std::optional<Rated> nearest(std::span<const Rated> points, const Demand& demand);

/// "dihedral, pbd, 16 substeps, 1 iteration, single, tethers, angle shear".
std::string setting_text(const Setting& setting);

/// "dihedral (pbd, tethers, angle shear)".
std::string kind_text(const Setting& setting);

}  // namespace bendlab
