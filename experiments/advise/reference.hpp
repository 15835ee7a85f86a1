// The reference that the errors of settings are measured against.
#pragma once

#include <optional>

#include "experiments/advise/runs.hpp"

namespace bendlab {

/// Limit of the rms Green strain of the reference. A strain of 0.5 is a stretch of 1.41: a pulled elastic
/// knit stretches so much, but no cloth under its own weight. Above the limit the reference is torn apart,
/// or the units are not metres and kilograms.
inline constexpr double largest_reference_strain = 0.5;

struct KnownReference : Reference {
  Json accuracy{};              ///< the section /accuracy that the errors come from
  std::optional<double> gap{};  ///< the reference's own error, in sizes of the mesh
  double strain = 0;            ///< rms of its Green strain: the stated membrane may stretch
  double stretch = 1;           ///< largest stretch of a triangle
  double cpu_s = 0;             ///< CPU time that it took
  double still_moving = 0;      ///< for errors at rest: the cloth's rms speed at the end, sizes per second
  Setting probe{};              ///< the setting that was compared with it first

  /// Whether errors mean anything: the reference is not torn apart, and its own error is at most
  /// largest_error.
  bool tells() const { return strain <= largest_reference_strain && gap.value_or(0) <= largest_error; }
};

/// Runs the reference for errors of the kind `error_of` (absent: Question::natural_error()). Chooses a
/// coarser reference if a finer one took too long, or would, judging by the time of the coarsest. Throws
/// std::runtime_error if the scene has no reference, or if none is complete in time. If `runs` has an exit
/// code, the result is incomplete.
KnownReference choose_reference(const Question& question, Runs& runs, std::optional<ErrorOf> error_of);

}  // namespace bendlab
