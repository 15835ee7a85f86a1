// Errors of a run against references that /accuracy asks for: other runs, made once and kept.
//
//   error_<against>_rms, _largest   how far the points are from the reference's (shape_error.hpp), in sizes of the mesh
//   error_<against>_hausdorff       how far the surfaces are from each other, in sizes
//   error_solver_strain             root mean square of the Green strain's difference to the reference's: 1
//   error_physical_strain           root mean square of the Green strain itself, as the stated cloth has none: 1
//   error_<against>_energy          over time: difference of what the total energy gained since the start, as a share of the
//                                   scene's scale (energy.hpp). k has no elastic energy
//   error_<against>_…_worst         over time: of the worst frame, where the others are means over the frames
//   error_<against>_frames          over time: how many were compared
//   error_<against>_reference_gap   rms of the coarser reference against the finer: an error not much larger is not known
//   error_<against>_unbalanced      of a reference that found no equilibrium: the share of its loads that is left over;
//   error_<against>_coarser_unbalanced   of the coarser one
//
// <against> is solver or physical. The size is that of the rest box. A run that diverged has none of these.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "experiments/config/config.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

/// Poses of one run.
struct Course {
  RestMesh rest;
  std::vector<double> time;      ///< #F, s
  std::vector<Positions> poses;  ///< #F
  std::vector<double> energy;    ///< #F, total, J; or empty
};

/// How two courses are compared.
struct Comparing {
  AlignBy align = AlignBy::none;
  Vector3 centre = Vector3::Zero(), down = -Vector3::UnitZ();  ///< of the vertical
  bool over_time = false;     ///< frames at the same times; else the last of each
  bool inextensible = false;  ///< strain against none instead of the reference's
  double energy_scale = 0;    ///< J; 0: no energy is compared
};

/// The errors above without their prefix: `rms`, `largest`, `hausdorff`, `strain`; over time `frames`, `energy` and the
/// worst ones. Throws std::invalid_argument where the meshes don't go together or no frame has a time in common.
std::map<std::string, double> errors_between(const Course& run, const Course& reference,
                                             const Comparing& comparing);

/// The course of a finished run, from its file: with `scene`, which is the file's, all frames and their energies; else the
/// last frame. Throws RunFileError.
Course read_course(const std::filesystem::path& file, const Scene* scene = nullptr);

/// Watches a run and compares it with its references when it is over.
class Accuracy {
 public:
  /// `config` and `scene` must outlive it; `scene` is as the run starts.
  Accuracy(const RunConfig& config, const Scene& scene);

  bool asked_for() const { return asked_for_; }

  /// Every recorded frame, in order, with its kinetic energy in J.
  void keep(const Frame& frame, double kinetic_energy);

  struct Result {
    std::map<std::string, double> summary;  ///< error_…
    std::vector<std::string> messages;      ///< what is wrong with a reference, with its pointer
    bool stopped = false;                   ///< before all was known
  };
  /// Of the run `id` that ends at `end`: makes the references below `folder` where they are not there yet. Threads that
  /// need the same one wait for the first. Throws RunFileError.
  Result against_references(const std::string& id, const Positions& end, const std::filesystem::path& folder,
                            const std::atomic<bool>* stop) const;

 private:
  std::optional<Course> course_of_reference(const std::string& id, const Positions& end,
                                            const std::filesystem::path& folder,
                                            const std::atomic<bool>* stop, Against against, bool coarser,
                                            Result& result) const;
  Course course_to(const Positions& end) const;
  Comparing comparing(Against against) const;

  const RunConfig& config_;
  const Scene& scene_;
  ParameterValues settings_;
  bool asked_for_, over_time_;
  std::vector<double> time_, kinetic_energy_;  // over time, of each recorded frame, as are
  std::vector<Positions> poses_;
};

}  // namespace bendlab
