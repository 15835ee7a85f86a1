// The poses of runs, and the errors between two runs.
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
  std::vector<double> energy;    ///< #F, total energy, J; or empty
};

/// How two trajectories are compared.
struct Comparing {
  AlignBy align = AlignBy::none;
  Vector3 centre = Vector3::Zero(), down = -Vector3::UnitZ();  ///< axis of AlignBy::vertical
  bool over_time = false;     ///< compare frames at the same times; else the last frames
  bool inextensible = false;  ///< compare the strain with zero, instead of the reference's strain
  double energy_scale = 0;    ///< J; 0: do not compare energies
};

/// The errors that accuracy.cpp lists, without their prefix: `rms`, `largest`, `hausdorff`, `strain`; with
/// Comparing::over_time also `frames`, `energy` and the worst errors. Throws std::invalid_argument if the
/// meshes don't match, or no two frames have the same time.
std::map<std::string, double> errors_between(const Trajectory& run, const Trajectory& reference,
                                             const Comparing& comparing);

/// Three functions that read frames from a run's file: the last frame, all frames, or all frames with their
/// energies in the run's scene. All throw RunFileError.
Trajectory read_last_pose(const std::filesystem::path& file);
Trajectory read_motion(const std::filesystem::path& file);
Trajectory read_motion(const std::filesystem::path& file, const BuiltScene& scene);

}  // namespace bendlab
