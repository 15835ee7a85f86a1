// A config: strict JSON read against the tables of settings, defaults filled in, sweeps expanded.
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
  /// The sweep expanded in order, last axis fastest, or covered; equal points appear once.
  std::vector<RunConfig> runs;
  std::vector<Axis> axes;  ///< the sweep
  Covered cover;
  std::vector<Expectation> expectations;
  /// Statuses that do not make the exit code a failure. They do not change what a run is.
  std::vector<std::string> allow;
  Json settings;  ///< as written, with overrides, without `sweep` and `expect`
  std::vector<std::string> overrides;

  bool allows(RunStatus status) const;
};

/// Reads, checks and expands. `overrides` are "/json/pointer=value" texts (value as JSON, else as plain
/// text); on a swept pointer an override replaces that axis. Throws ConfigError with every problem found; a
/// file that cannot be read is one too.
Experiment load_experiment(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same from text; a mesh file is then relative to the working directory.
Experiment parse_experiment(std::string_view text, std::string_view source_name,
                            std::span<const std::string> overrides = {});

/// The same from the text that a config's file had; a mesh file is relative to that file's folder.
Experiment parse_config(std::string_view text, const std::filesystem::path& source,
                        std::span<const std::string> overrides = {});

/// The experiment of one run whose resolved settings a run file holds. A reference may be the run itself here:
/// it may differ from other runs of the sweep that the run belongs to. Throws ConfigError.
Experiment experiment_of(const Json& resolved, std::string_view source_name);

}  // namespace bendlab
