// Reads a config: checks strict JSON against the tables of settings, fills in defaults, expands sweeps.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/strict_json.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/run_config.hpp"
#include "experiments/config/sweep.hpp"

namespace bendlab {

struct Experiment {
  std::string name, description;
  std::filesystem::path source;  ///< the config's file, empty if it came from text
  /// The runs of the sweep in order, last axis fastest, or the runs of its cover. Equal runs appear once.
  std::vector<RunConfig> runs;
  std::vector<Axis> axes;  ///< the sweep
  Covered cover;
  std::vector<Expectation> expectations;
  /// Verdicts that do not make the command fail. They do not affect the runs.
  std::vector<std::string> allow;
  Json settings;  ///< as written, with overrides, without `sweep`, `cover`, `expect`, `because`
  std::vector<std::string> overrides;

  bool allows(RunStatus status) const;
};

/// Reads a config, checks it, and expands its sweep. `overrides` are "/json/pointer=value" texts (the value
/// is JSON, else plain text); an override of a swept pointer replaces the axis. Throws ConfigError with every
/// problem found, also if the file cannot be read.
Experiment load_experiment(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same from a text. Mesh files are then relative to the working directory.
Experiment parse_experiment(std::string_view text, std::string_view source_name,
                            std::span<const std::string> overrides = {});

/// The same from the text that the config file `source` had. Mesh files are relative to the folder of
/// `source`.
Experiment parse_config(std::string_view text, const std::filesystem::path& source,
                        std::span<const std::string> overrides = {});

/// The experiment of one run whose resolved settings a run file holds. Here a reference may be the run
/// itself, because the reference may differ from other runs of the sweep. Throws ConfigError.
Experiment experiment_of(const Json& resolved, std::string_view source_name);

}  // namespace bendlab
