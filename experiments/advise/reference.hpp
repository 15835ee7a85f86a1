// What the errors of settings are measured against.
#pragma once

#include <optional>

#include "experiments/advise/runs.hpp"

namespace bendlab {

/// Rms of the Green strain of the reference itself. 0.5 is a stretch of 1.41, which an elastic knit has when
/// it is pulled, and no cloth under its own weight. Beyond it the reference is torn apart, or its units are
/// not metres and kilograms.
inline constexpr double largest_reference_strain = 0.5;

struct KnownReference : Reference {
  Json accuracy{};              ///< the section /accuracy that the errors come from
  std::optional<double> gap{};  ///< its own error, in sizes of the mesh
  double strain = 0;            ///< rms of its Green strain: the stated membrane may stretch
  double stretch = 1;           ///< largest of a triangle
  double still_moving = 0;      ///< for errors at rest: the cloth's rms speed at the end, sizes per second
  Setting probe{};              ///< what was compared with it first

  /// Whether errors mean anything: it is not torn apart, and is known to within largest_error.
  bool tells() const { return strain <= largest_reference_strain && gap.value_or(0) <= largest_error; }
};

/// Runs it; `error_of`: nothing for Question::natural_error(). What would take more than a quarter of the
/// time is made coarser, before it is begun and if it turns out so. Throws std::runtime_error if there is
/// none, or none in time. Incomplete if the runs have an exit code.
KnownReference choose_reference(const Question& question, Runs& runs, std::optional<ErrorOf> error_of);

}  // namespace bendlab
