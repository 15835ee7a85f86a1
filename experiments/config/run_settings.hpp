// What a run is made from: a scene, and what is measured and recorded of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/mesh/quality.hpp"
#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

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

/// Reads a config without `sweep`, `cover`, `expect` and `because`: everything that is stated, on top of the
/// defaults. Appends every problem; if there are any, the settings are meaningless.
RunSettings read_run(const Json& settings, ConfigProblems& problems);

/// The canonical settings: what decides the run, without name, description, allow and defaults. Equal runs
/// have equal JSON. read_run() of it, with a name, gives the same settings.
Json to_json(const RunSettings& settings);

}  // namespace bendlab
