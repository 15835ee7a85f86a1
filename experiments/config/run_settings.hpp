// The settings of a run: a scene, and what to measure and record.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/mesh/quality.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

struct OutputSettings {
  double frames_per_second = 30;
  bool constraints = false;  ///< whether the run file lists every constraint
  std::vector<std::string> measures;
};

/// How a reference's pose is moved onto a run's pose before the two are compared.
enum class AlignBy { none, vertical, rigid };
inline constexpr std::array<std::string_view, 3> align_by_names = {"none", "vertical", "rigid"};

/// Which errors of the run are measured. A list of changes, "/json/pointer=value", turns the run into a
/// reference.
struct Accuracy {
  std::optional<std::vector<std::string>> solver, solver_coarser, physical, physical_coarser;
  bool start_from_end = false;
  AlignBy align = AlignBy::none;
  bool over_time = false;

  bool compares() const { return solver || physical; }
};

struct RunSettings {
  std::string name, description;
  std::vector<std::string> allow;
  std::string defaults = "recommended";
  double settled_speed = 0;  ///< m/s; 0: the run never ends early
  Scene scene;
  OutputSettings output;
  Accuracy accuracy;
  QualityThresholds quality;
};

}  // namespace bendlab
