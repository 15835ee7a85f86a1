// The scene that advice is asked for: which cloth it states, what a run's error is measured against, and the
// runs.
//
// The cloth is the one of the config: hinges calibrated to its flexural rigidity (of a quartic cloth, which
// hinges can't be, the config's own springs), with its membrane where that has a compliance, else one that
// hardly stretches (stiff_membrane). Its pose at rest is found by the equilibrium solver, its motion by many
// substeps. Effects that help a solver and do nothing to the stated cloth at rest (tethers, bounds on the
// strain, damping) are left out of an equilibrium.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/advise/trial.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Compliance of a membrane that hardly stretches, m/N: that of the stated cloth where its membrane has none.
inline constexpr double stiff_membrane = 1e-5;

/// Fewer cells than that are no mesh of a scene.
inline constexpr int fewest_cells = 4;

/// What an error is: of the settled pose, of the motion, or against the reference of the config's own
/// /accuracy.
enum class ErrorOf { rest, motion, own };

/// The reference that errors are measured against. It is the same for every setting.
struct Reference {
  ErrorOf of = ErrorOf::rest;
  bool start_from_end = false;  ///< for scenes with many equilibria: beside each run's end
  int cells = 0;                ///< 0: the config's own mesh
  int substeps = 0;             ///< of a motion; the error of the reference is measured against half as many
};

class Question {
 public:
  /// Throws ConfigError if the config is wrong, sweeps, or states no cloth, as with k and compliance.
  Question(std::filesystem::path file, std::vector<std::string> overrides);

  const RunConfig& scene() const { return scene_; }
  const std::string& name() const { return name_; }
  const std::string& reference_model() const { return reference_model_; }
  /// Whether the config states none, so that the cloth is a light cotton.
  bool rigidity_is_default() const { return rigidity_is_default_; }

  /// What the config itself says.
  Setting own_setting() const;

  /// Whether another number of cells gives the same scene on another mesh: of a generated flat sheet whose
  /// vertices are named by place. That number, or 0.
  int cells_that_may_vary() const;

  /// `own` if the config has an /accuracy; `rest` if nothing but loads and damping acts on a pinned cloth
  /// that starts at rest; else `motion`.
  ErrorOf natural_error() const;

  /// The /accuracy section of its runs.
  Json accuracy(const Reference& reference) const;

  /// One run of the scene with that setting, `times` as long. Throws ConfigError if the model cannot be this
  /// cloth.
  Experiment experiment_with(const Setting& setting, const Json& accuracy, double times = 1) const;

  /// The changes that give the config that setting: "/json/pointer=value" each.
  std::vector<std::string> changes(const Setting& setting) const;

  /// The config with that setting, without /accuracy and without expectations of other settings, to be kept
  /// in `folder`.
  Json written(const Setting& setting, const std::filesystem::path& folder) const;

 private:
  std::vector<std::string> overrides_with(const Setting& setting) const;

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  RunConfig scene_;
  Json own_solver_;  ///< as the config states it
  bool rigidity_is_default_ = false;
  std::string name_, reference_model_;
};

/// The first method that projects constraints: of references in motion.
Method method_that_projects();

}  // namespace bendlab
