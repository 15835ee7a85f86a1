// Reads a config: parses strict JSON, checks settings against tables, fills in defaults, expands sweeps.
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
  /// Verdicts that do not make the command fail. Does not affect the runs.
  std::vector<std::string> allow;
  Json settings;  ///< as written, with overrides, without `sweep`, `cover`, `expect`, `because`
  std::vector<std::string> overrides;

  bool allows(RunStatus status) const;
};

/// Reads a config, checks it, and expands its sweep. `overrides` are "/json/pointer=value" texts, see
/// overrides.hpp. Throws ConfigError with every problem found, also if the file cannot be read.
Experiment load_experiment(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Reads, checks and expands a config from its text. Mesh files are then relative to the working directory.
Experiment parse_experiment(std::string_view text, std::string_view source_name,
                            std::span<const std::string> overrides = {});

/// Reads, checks and expands an earlier text of the config file `source`. Mesh files are relative to its
/// folder.
Experiment parse_config(std::string_view text, const std::filesystem::path& source,
                        std::span<const std::string> overrides = {});

/// The experiment of one run, from the resolved settings in a run file. This run may be its own reference:
/// only a sweep in which every run is its own reference is a mistake. Throws ConfigError.
Experiment experiment_of(const Json& resolved, std::string_view source_name);

}  // namespace bendlab
