#include "experiments/config/run_config.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <stdexcept>
#include <variant>

#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_tables.hpp"
#include "experiments/config/run_json.hpp"

namespace bendlab {

struct RunConfig::Data {
  using Derived = std::variant<std::monostate, RunConfig, ConfigError>;

  RunSettings settings;
  Json resolved = Json::object();

  std::mutex mutex;  // guards what follows
  std::map<std::string, Derived> derived;
};

RunConfig::RunConfig() : data_(std::make_shared<Data>()) {}

RunConfig::RunConfig(RunSettings settings, const std::filesystem::path& folder) : RunConfig() {
  settings.scene.folder = folder;
  data_->resolved = to_json(settings);
  data_->settings = std::move(settings);
}

const RunSettings& RunConfig::settings() const {
  return data_->settings;
}

const Json& RunConfig::resolved() const {
  return data_->resolved;
}

std::filesystem::path RunConfig::mesh_file() const {
  const std::optional<std::string>& file = scene().mesh.file;
  return file ? folder() / *file : std::filesystem::path();
}

RunConfig stored_run(const Json& resolved, const std::filesystem::path& folder) {
  Json settings = resolved;
  settings["name"] = "stored";
  ConfigProblems problems;
  RunSettings run = read_run(settings, problems);
  if (!problems.empty())
    throw std::invalid_argument(fmt::format("{}: {}", problems.front().pointer, problems.front().message));
  return RunConfig(std::move(run), folder);
}

std::optional<RunConfig> RunConfig::derived(const std::string& name,
                                            const std::function<std::optional<RunConfig>()>& make) const {
  const std::lock_guard lock(data_->mutex);
  auto found = data_->derived.find(name);
  if (found == data_->derived.end()) {
    Data::Derived made;
    try {
      if (std::optional<RunConfig> run = make()) made = *std::move(run);
    } catch (const ConfigError& error) {
      made = error;
    }
    found = data_->derived.emplace(name, std::move(made)).first;
  }
  if (const auto* error = std::get_if<ConfigError>(&found->second)) throw *error;
  const auto* run = std::get_if<RunConfig>(&found->second);
  return run ? std::optional(*run) : std::nullopt;
}

std::vector<NamedFile> input_files(const RunConfig& config) {
  std::vector<NamedFile> files;
  const auto add = [&](const FieldTable& table, const void* owner, const std::string& pointer) {
    for (const Field& field : table.fields)
      if (field.names_file)
        if (const Value value = field.of(owner); const auto* const name = std::get_if<std::string>(&value))
          files.push_back({child_pointer(pointer, field.name), *name, config.folder() / *name});
  };
  const Scene& scene = config.scene();
  for (const Part& part : scene_parts()) add(part.table, part.in(scene), std::string(part.pointer));
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    add(scene.effects[i].kind().settings, scene.effects[i].settings(), fmt::format("/effects/{}", i));
  return files;
}

Json point_json(const RunConfig& config) {
  Json point = Json::object();
  for (const auto& [pointer, value] : config.point) point[pointer] = value;
  return point;
}

std::string identity_text(const Json& resolved) {
  std::string text;  // as by Json::dump(), but without copying all settings of thousands of runs
  for (const auto& [key, value] : resolved.items()) {
    text += fmt::format("{}{}:", text.empty() ? '{' : ',', Json(key).dump());
    if (key == "solver") {
      Json solver = value;
      solver.erase("threads");
      text += solver.dump();
    } else {
      text += value.dump();
    }
  }
  return text + "}";
}

}  // namespace bendlab
