// The scene for which `bendlab advise` finds settings, the runs of this scene, and the reference for errors.
//
// The reference simulates the cloth that the config states. The reference bends like a sheet of hinges with
// the stated flexural rigidity. Hinges can't represent a quartic cloth, for which the reference has the
// config's springs. For errors of the motion the reference takes many substeps. For errors of the pose at
// rest the equilibrium solver computes the reference. An equilibrium leaves out effects that do not change
// the pose at rest (tethers, bounds on the strain, damping). If the config states no compliance of the
// membrane, the membrane of an equilibrium hardly stretches (stiff_membrane).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/advise/trial.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Compliance of a membrane that hardly stretches, m/N: for an equilibrium whose config states no compliance.
inline constexpr double stiff_membrane = 1e-5;

/// `advise` tries no mesh with fewer cells along the width than this, but the config's own mesh may have
/// fewer.
inline constexpr int fewest_cells = 4;

/// Which error counts: of the pose at rest, of the motion, or against the reference in the config's
/// /accuracy.
enum class ErrorOf { rest, motion, own };

/// Describes the reference that the errors of all settings are measured against.
struct Reference {
  ErrorOf of = ErrorOf::rest;
  bool start_from_end = false;  ///< if there are many equilibria: the search starts at a run's end
  int cells = 0;                ///< 0: the config's own mesh
  int substeps = 0;             ///< of a motion; a run with half as many shows the reference's own error
};

class Question {
 public:
  /// Throws ConfigError if the config is wrong, has a sweep, or states no cloth (k and compliance state no
  /// cloth).
  Question(std::filesystem::path file, std::vector<std::string> overrides);

  const RunConfig& scene() const { return scene_; }
  const std::string& name() const { return name_; }
  const std::string& reference_model() const { return reference_model_; }
  /// Whether the config states no rigidity; the cloth then has the default, a light cotton.
  bool rigidity_is_default() const { return rigidity_is_default_; }

  /// The setting that the config states.
  Setting own_setting() const;

  /// The config's number of cells; 0 if another number of cells would change the scene. Cells may vary on a
  /// flat generated sheet if pins and effects name no vertex by its index.
  int cells_that_may_vary() const;

  /// `own` for a config with /accuracy. `rest` for a pinned cloth that starts at rest, with only loads and
  /// damping. `motion` for all other scenes.
  ErrorOf natural_error() const;

  /// The section /accuracy of a config whose runs are compared with `reference`.
  Json accuracy(const Reference& reference) const;

  /// One run of the scene with `setting`; /duration is multiplied by `times`. Throws ConfigError if the
  /// model cannot represent this cloth.
  Experiment experiment_with(const Setting& setting, const Json& accuracy, double times = 1) const;

  /// The changes that give the config this setting, in the form "/json/pointer=value".
  std::vector<std::string> changes(const Setting& setting) const;

  /// The config with this setting, to be written into `folder`. Leaves out /accuracy, and expectations that
  /// hold only for some settings (`where`).
  Json written(const Setting& setting, const std::filesystem::path& folder) const;

 private:
  std::vector<std::string> overrides_with(const Setting& setting) const;

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  RunConfig scene_;
  Json own_solver_;  ///< /solver, as the config states it
  bool rigidity_is_default_ = false;
  std::string name_, reference_model_;
};

/// The first registered method that projects constraints, which computes references of a motion.
Method method_that_projects();

}  // namespace bendlab
