// The scene for which advice is asked: the cloth that it states, the reference for errors, and the runs.
//
// The reference is the cloth that the config states. Hinges are calibrated to its flexural rigidity; a
// quartic cloth, which hinges can't represent, has the config's own springs. The membrane is that of the
// config if it has a compliance, else a membrane that hardly stretches (stiff_membrane). The equilibrium
// solver finds the pose at rest, and many substeps find the motion. An equilibrium leaves out effects that
// help a solver but do nothing to the stated cloth at rest (tethers, bounds on the strain, damping).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/advise/trial.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Compliance of a membrane that hardly stretches, m/N. The stated cloth has it if its membrane has no
/// compliance.
inline constexpr double stiff_membrane = 1e-5;

/// The fewest cells that a mesh of a scene may have.
inline constexpr int fewest_cells = 4;

/// The kind of error: of the settled pose, of the motion, or against the reference of the config's own
/// /accuracy.
enum class ErrorOf { rest, motion, own };

/// The reference that errors are measured against. It is the same for every setting.
struct Reference {
  ErrorOf of = ErrorOf::rest;
  bool start_from_end = false;  ///< for many equilibria: the one near each run's end
  int cells = 0;                ///< 0: the config's own mesh
  int substeps = 0;             ///< of a motion; half as many show the reference's own error
};

class Question {
 public:
  /// Throws ConfigError if the config is wrong, has a sweep, or states no cloth (k and compliance state no
  /// cloth).
  Question(std::filesystem::path file, std::vector<std::string> overrides);

  const RunConfig& scene() const { return scene_; }
  const std::string& name() const { return name_; }
  const std::string& reference_model() const { return reference_model_; }
  /// Whether the config states no rigidity, so that the cloth is a light cotton.
  bool rigidity_is_default() const { return rigidity_is_default_; }

  /// The setting that the config itself has.
  Setting own_setting() const;

  /// The number of cells if it may vary, else 0. It may vary if another number gives the same scene on
  /// another mesh: for a generated flat sheet whose vertices are named by place.
  int cells_that_may_vary() const;

  /// `own` if the config has an /accuracy; `rest` if a pinned cloth starts at rest, and only loads and
  /// damping act on it; else `motion`.
  ErrorOf natural_error() const;

  /// The section /accuracy of runs that are compared with `reference`.
  Json accuracy(const Reference& reference) const;

  /// One run of the scene with `setting`, `times` as long. Throws ConfigError if the model cannot represent
  /// this cloth.
  Experiment experiment_with(const Setting& setting, const Json& accuracy, double times = 1) const;

  /// The changes that give the config this setting, in the form "/json/pointer=value".
  std::vector<std::string> changes(const Setting& setting) const;

  /// The config with this setting, to be written into `folder`. Leaves out /accuracy, and expectations of
  /// other settings.
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

/// The first method that projects constraints. References of a motion use it.
Method method_that_projects();

}  // namespace bendlab
