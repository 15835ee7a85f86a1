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
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/advise/front.hpp"
#include "experiments/config/config.hpp"

namespace bendlab {

/// Compliance of a membrane that hardly stretches, m/N: that of the stated cloth where its membrane has none.
inline constexpr double stiff_membrane = 1e-5;

/// What an error is: of the settled pose, of the motion, or against the reference of the config's own
/// /accuracy.
enum class ErrorOf { rest, motion, own };

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
  const Variant& own_variant() const { return own_; }

  /// In that method, with the recommended remedies (configs/recommended.json): tethers where something is
  /// pinned, and shear measured by its angle.
  Variant recommended_variant(std::string_view method = "pbd", bool softened = false) const;

  /// The same model with each variant that differs in one thing; these methods may be chosen.
  std::vector<Setting> neighbours(const Setting& setting, const std::vector<std::string>& methods) const;

  /// `own` if the config has an /accuracy; `rest` if nothing but loads and damping acts on a pinned cloth
  /// that starts at rest; else `motion`.
  ErrorOf natural_error() const;

  /// The /accuracy section of its runs; `start_from_end` for scenes with many equilibria.
  Json accuracy(ErrorOf what, bool start_from_end = false) const;

  /// Substeps of the reference of a motion: as many as about a minute of projections allows, at least 64 and
  /// at most 1024. Its error is measured against one with half as many.
  int reference_substeps() const;

  /// Root mean square of the speed of the cloth that has this kinetic energy (J), in sizes of the mesh per
  /// second.
  double speed(double kinetic_energy) const;

  /// The scene's run with that setting. Throws ConfigError if the model cannot be this cloth.
  RunConfig run_with(const Setting& setting, const Json& accuracy) const;

  /// The same for so many times its duration, whether it comes to rest before or not.
  RunConfig longer_run_with(const Setting& setting, const Json& accuracy, double times) const;

  /// The changes that give the config that setting: "/json/pointer=value" each. What the config says already
  /// is left out, but for model, work, precision and membrane.
  std::vector<std::string> changes(const Setting& setting) const;

  /// The config with that setting, without /accuracy and without expectations of other settings, to be kept
  /// in `folder`.
  Json written(const Setting& setting, const std::filesystem::path& folder) const;

 private:
  RunConfig run_with(const Setting& setting, const Json& accuracy,
                     const std::vector<std::string>& further) const;
  std::vector<std::string> rest_changes() const;
  std::vector<std::string> motion_changes() const;
  /// A reference is the same whatever the variant of the run.
  std::vector<std::string> own_changes() const;
  bool may_tether() const;
  VariantChoices choices(const std::string& model, const std::vector<std::string>& methods) const;
  Json effects_with(bool tethers) const;

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  RunConfig scene_;
  Json written_effects_;        ///< as the config has them, or the default ones
  bool effects_swept_ = false;  ///< an axis points into the list
  bool rigidity_is_default_ = false;
  std::string name_, reference_model_;
  Variant own_;
};

}  // namespace bendlab
