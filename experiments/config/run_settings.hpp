// What a run is made from: a scene, and what is measured and recorded of it.
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
  bool constraints = false;  ///< the run file lists every one
  std::vector<std::string> measures;
};

/// How a reference's pose is brought over a run's before they are compared.
enum class AlignBy { none, vertical, rigid };
inline constexpr std::array<std::string_view, 3> align_by_names = {"none", "vertical", "rigid"};

/// Errors of the run. Lists of changes, "/json/pointer=value", turn the run into a reference.
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
