// The settings of one run, typed: what everything that builds, runs and names a run reads.
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

/// One point of a sweep: every value there, only the chosen model's settings kept. The settings are read once
/// and never change; copies share them.
class RunConfig {
 public:
  /// Without settings: a place for a run to be assigned to.
  RunConfig();
  /// Files are relative to `folder`, the config's folder; it is empty if the config came from text.
  explicit RunConfig(RunSettings settings, const std::filesystem::path& folder = {});

  const RunSettings& settings() const;
  const Scene& scene() const { return settings().scene; }
  const Json& resolved() const;  ///< canonical: equal runs have equal text; holds no name and no description
  const std::filesystem::path& folder() const { return scene().folder; }
  std::filesystem::path mesh_file() const;  ///< a path from here; empty: the mesh is generated

  /// A run that follows from this one's settings: make() is called once for each `name`, copies included, and
  /// what it returned or threw (a ConfigError) is kept. Any thread may ask.
  std::optional<RunConfig> derived(const std::string& name,
                                   const std::function<std::optional<RunConfig>()>& make) const;

  /// This run's place on the sweep: pointer, value. An axis that this run does not depend on is left out (a
  /// setting of another bending model, for example).
  std::vector<std::pair<std::string, Json>> point;
  /// The id of the run at whose end this one starts (a reference with /accuracy/start_from_end); empty: none.
  std::string starts_at_end_of;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

/// The run of canonical settings, of a run file for example. Throws std::invalid_argument for a value that is
/// unknown, as it may be in a run file of another version.
RunConfig stored_run(const Json& resolved, const std::filesystem::path& folder = {});

/// A file that a run reads: the setting that names it, the name there, and the path from here.
struct NamedFile {
  std::string pointer, name;
  std::filesystem::path path;
  bool operator==(const NamedFile&) const = default;
};
/// /mesh/file, and effects' files.
std::vector<NamedFile> input_files(const RunConfig& config);

/// Its place on the sweep: {pointer: value}.
Json point_json(const RunConfig& config);

/// The part of a resolved config that decides the result: canonical text without /solver/threads (any number
/// of threads gives the same bits).
std::string identity_text(const Json& resolved);

}  // namespace bendlab
