// Poses of two runs, and how far they are from each other.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Poses of one run.
struct Trajectory {
  RestMesh rest;
  std::vector<double> time;      ///< #F, s
  std::vector<Positions> poses;  ///< #F
  std::vector<double> energy;    ///< #F, total, J; or empty
};

/// How two trajectories are compared.
struct Comparing {
  AlignBy align = AlignBy::none;
  Vector3 centre = Vector3::Zero(), down = -Vector3::UnitZ();  ///< of the vertical
  bool over_time = false;     ///< frames at the same times; else the last of each
  bool inextensible = false;  ///< strain is compared with zero instead of the reference's
  double energy_scale = 0;    ///< J; 0: no energy is compared
};

/// The errors that accuracy.cpp lists, without their prefix: `rms`, `largest`, `hausdorff`, `strain`; over
/// time `frames`, `energy` and the worst ones, too. Throws std::invalid_argument if the meshes don't go
/// together or no frames have a time in common.
std::map<std::string, double> errors_between(const Trajectory& run, const Trajectory& reference,
                                             const Comparing& comparing);

/// From a run's file: its last frame; all frames; these with their energies, in the run's scene. Throw
/// RunFileError.
Trajectory read_last_pose(const std::filesystem::path& file);
Trajectory read_motion(const std::filesystem::path& file);
Trajectory read_motion(const std::filesystem::path& file, const BuiltScene& scene);

}  // namespace bendlab
