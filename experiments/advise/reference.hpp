// What the errors of settings are measured against.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiments/advise/runs.hpp"

namespace bendlab {

struct KnownReference : Reference {
  Json accuracy;  ///< the section /accuracy that the errors come from
  /// Its own error, in sizes of the mesh.
  std::optional<double> gap = std::nullopt;
  double strain = 0;        ///< rms of its Green strain: the stated membrane may stretch
  double stretch = 1;       ///< largest stretch of a triangle
  double still_moving = 0;  ///< for errors at rest: the cloth's rms speed at the end, sizes per second
  Setting probe;            ///< which setting was compared with it first
  Measured probed;
};

/// Fewer cells than that are no mesh of the scene.
inline constexpr int fewest_cells = 4;

/// Runs it; `error_of`: nothing for Question::natural_error(). What would take more than a quarter of the
/// time is made coarser, before it is begun and if it turns out so. Throws std::runtime_error if there is
/// none, or none in time. Incomplete if the runs have an exit code.
KnownReference choose_reference(const Question& question, Runs& runs, std::optional<ErrorOf> error_of,
                                const std::function<void(const std::string&)>& tell);

/// Whether errors mean anything: the reference is not torn apart, and is known to within largest_error.
bool reference_tells(const KnownReference& reference);

}  // namespace bendlab
