// Settings with their error and time, which of them are worth having, and the one that fits a demand.
#pragma once

#include <compare>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/advise/demand.hpp"

namespace bendlab {

struct Setting {
  std::string model;
  int substeps = 1, iterations = 1;
  bool double_precision = false;

  auto operator<=>(const Setting&) const = default;
};

struct Rated {
  Setting setting;
  double error = 0;  ///< in sizes of the mesh
  double cpu_s = 0;  ///< per frame
  bool predicted = false;
};

/// The points that no other beats in both error and time, the fastest first. Of equal ones the first.
std::vector<Rated> front_of(std::span<const Rated> points);

/// Of a front the points that are a tenth more accurate than the one before them, and the last.
std::vector<Rated> thinned(std::span<const Rated> front);

/// The fastest point whose error is at most the demanded one, or the most accurate whose time is.
std::optional<Rated> chosen(std::span<const Rated> points, const Demand& demand);

/// Without a point that meets the demand, the one that comes nearest: the most accurate, or the fastest.
std::optional<Rated> nearest(std::span<const Rated> points, const Demand& demand);

/// "dihedral, 16 substeps, 1 iteration, single".
std::string setting_text(const Setting& setting);

}  // namespace bendlab
