// Settings with their error and time, which of them are worth having, and the one that fits a demand.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiments/advise/demand.hpp"
#include "experiments/advise/fitness.hpp"
#include "experiments/advise/setting.hpp"

namespace bendlab {

struct Rated {
  Setting setting;
  double error = 0;  ///< in sizes of the mesh; infinite: not compared
  double cpu_s = 0;  ///< per frame
  Strained strained{};
};

Unfit unfit(const Rated& point);

/// How far it is from what is demanded, 1 times its error or time if it is not: less is better.
double score(const Rated& point, const Demand& demand);

/// The fit points that no other fit one beats in both error and time, the fastest first. Ties go to the
/// first.
std::vector<Rated> front_of(std::span<const Rated> points);

/// Of a front the points that are a tenth more accurate than the one before them, and the last.
std::vector<Rated> thinned(std::span<const Rated> front);

/// The fastest fit point whose error is at most the demanded one, or the most accurate fit one whose time is.
std::optional<Rated> chosen(std::span<const Rated> points, const Demand& demand);

/// If no point meets the demand, the one that comes nearest: the most accurate fit one, or the fastest fit
/// one. If none is fit, the one that is least beyond the limits, preferably within the demanded time.
std::optional<Rated> nearest(std::span<const Rated> points, const Demand& demand);

}  // namespace bendlab
