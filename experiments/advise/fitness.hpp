// Whether a setting may be advised at all, whatever was asked for: it gives the pose of the cloth, and a
// stretch that cloth can have.
#pragma once

#include <array>
#include <string_view>

namespace bendlab {

/// In sizes of the mesh, rms. The points of a square lie 0.29 sizes (rms) from its middle: a sheet that is
/// crumpled to a point there has that error, and 0.2 is most of it.
inline constexpr double largest_error = 0.2;

/// Rms of the Green strain beyond the reference's. Woven cloth stretches by less than a tenth as it is worn
/// (Provot 1995 and Bridson 2003 limit their springs to it).
inline constexpr double largest_strain = 0.1;

/// Stretch of any triangle, over the largest of the reference. Woven cloth tears at 1.05 to 1.4, and a
/// triangle at a pin shows a tear as a spike.
inline constexpr double largest_stretch = 1.5;

/// Rms of the Green strain of the reference itself. 0.5 is a stretch of 1.41, which an elastic knit has when
/// it is pulled, and no cloth under its own weight. Beyond it the reference is torn apart, or its units are
/// not metres and kilograms.
inline constexpr double largest_reference_strain = 0.5;

/// How the cloth of a run is stretched, compared with its reference.
struct Strained {
  double rms = 0;            ///< of the Green strain, less that of the reference, at least 0
  double largest = 1;        ///< stretch of a triangle, over that of the reference, at least 1
  bool implausible = false;  ///< the run broke a bound that its scene cannot break

  friend bool operator==(const Strained&, const Strained&) = default;
};

enum class Unfit { no, implausible, strain, stretch, error };
inline constexpr std::array<std::string_view, 5> unfit_names = {"", "implausible", "strain", "stretch",
                                                                "error"};
constexpr std::string_view name_of(Unfit why) {
  return unfit_names[static_cast<std::size_t>(why)];
}

/// The first reason why a setting with this error (sizes; infinite if it was not compared) is not advised.
Unfit unfit(double error, const Strained& strained);

/// By which factor the worst of error, strain and stretch is beyond its limit; at most 1 where it is fit.
double beyond_limits(double error, const Strained& strained);

/// Its error; of what is unfit at least the largest that is fit, times what it is beyond its limits: so that
/// more work is worth it until it is fit.
double judged_error(double error, const Strained& strained);

}  // namespace bendlab
