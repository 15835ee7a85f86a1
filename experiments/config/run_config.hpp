// The typed settings of one run, read by all code that builds, computes or names a run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bendlab/scene/strict_json.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// One point of a sweep: every setting has a value, and only the chosen model's settings are kept. The
/// settings are read once and never change; copies share them.
class RunConfig {
 public:
  /// Empty; assign a run before use.
  RunConfig();
  /// File names are relative to `folder`, the config's folder. `folder` is empty if the config came from
  /// text.
  explicit RunConfig(RunSettings settings, const std::filesystem::path& folder = {});

  const RunSettings& settings() const;
  const Scene& scene() const { return settings().scene; }
  const Json& resolved() const;  ///< canonical: equal runs have equal text; without name and description
  const std::filesystem::path& folder() const { return scene().folder; }
  std::filesystem::path mesh_file() const;  ///< from the working directory; empty: the mesh is generated

  /// A run that make() derives from this run's settings. make() is called only once per `name`. Its result, a
  /// run or a ConfigError, is stored for this object and all copies. Thread-safe.
  std::optional<RunConfig> derived(const std::string& name,
                                   const std::function<std::optional<RunConfig>()>& make) const;

  /// The swept pointers and their values in this run. An axis that the run does not depend on is left out (a
  /// setting of another bending model, for example).
  std::vector<std::pair<std::string, Json>> point;
  /// For a reference with /accuracy/start_from_end, the id of the run at whose end the reference starts.
  /// Empty for other runs.
  std::string starts_at_end_of;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

/// The run with these canonical settings, for example the settings in a run file. Throws
/// std::invalid_argument for an unknown value, which a run file of another version may have.
RunConfig stored_run(const Json& resolved, const std::filesystem::path& folder = {});

/// A file that a run reads: the pointer of the setting that names the file, the name in the config, and the
/// path from the working directory.
struct NamedFile {
  std::string pointer, name;
  std::filesystem::path path;
  bool operator==(const NamedFile&) const = default;
};
/// The file of /mesh/file and the files of effects.
std::vector<NamedFile> input_files(const RunConfig& config);

/// RunConfig::point as {pointer: value}.
Json point_json(const RunConfig& config);

/// The part of a resolved config that decides the result: canonical text without /solver/threads (any number
/// of threads gives the same bits).
std::string identity_text(const Json& resolved);

}  // namespace bendlab
