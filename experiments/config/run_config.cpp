#include "experiments/config/run_config.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <stdexcept>
#include <variant>

#include "bendlab/effects/effect.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/resolve.hpp"

namespace bendlab {
namespace {

std::vector<EffectSettings> effects_of(const Json& resolved, const std::filesystem::path& folder) {
  std::vector<EffectSettings> list;
  const Json* const entries = value_at(resolved, "/effects");
  if (entries == nullptr) return list;
  for (const Json& entry : *entries) {
    const std::string type = entry.value("type", "");
    const Effect* const effect = find_effect(type);
    if (effect == nullptr) throw std::invalid_argument(fmt::format("there is no effect '{}'", type));
    ParameterValues values = values_of(entry, effect->parameters);
    if (values.has("file")) values.set("file", (folder / values.text("file")).string());
    list.push_back({type, std::move(values)});
  }
  return list;
}

}  // namespace

struct RunConfig::Settings {
  using Derived = std::variant<std::monostate, RunConfig, ConfigError>;

  Json resolved = Json::object();
  std::filesystem::path folder, mesh_file;
  std::map<std::string_view, std::shared_ptr<const ParameterValues>> sections;
  ParameterValues no_parameters;
  std::vector<EffectSettings> effects;

  std::mutex mutex;  // guards what follows
  std::map<std::string, Derived> derived;
};

RunConfig::RunConfig() : settings_(std::make_shared<Settings>()) {}

RunConfig::RunConfig(Json resolved, const std::filesystem::path& folder, const RunConfig* like)
    : RunConfig() {
  Settings& settings = *settings_;
  settings.resolved = std::move(resolved);
  settings.folder = folder;
  for (const ConfigSection& section : config_sections()) {
    const std::string pointer(section.pointer);
    const Json* const values = value_at(settings.resolved, pointer);
    if (values == nullptr) continue;
    const Json* const alike = like != nullptr ? value_at(like->resolved(), pointer) : nullptr;
    settings.sections[section.pointer] =
        alike != nullptr && *alike == *values
            ? like->settings_->sections.at(section.pointer)
            : std::make_shared<const ParameterValues>(values_of(*values, section.parameters));
  }
  settings.effects = effects_of(settings.resolved, folder);
  if (const Json* file = value_at(settings.resolved, "/mesh/file"))
    settings.mesh_file = folder / file->get<std::string>();
}

const Json& RunConfig::resolved() const {
  return settings_->resolved;
}

const std::filesystem::path& RunConfig::folder() const {
  return settings_->folder;
}

const std::filesystem::path& RunConfig::mesh_file() const {
  return settings_->mesh_file;
}

const ParameterValues& RunConfig::section(std::string_view pointer) const {
  const auto found = settings_->sections.find(pointer);
  if (found == settings_->sections.end())
    throw std::logic_error(fmt::format("a run's config has no section '{}'", pointer));
  return *found->second;
}

const std::string& RunConfig::bending_model() const {
  return section("/bending").text("model");
}

const ParameterValues& RunConfig::bending_parameters() const {
  const auto found = settings_->sections.find("/bending/" + bending_model());
  return found == settings_->sections.end() ? settings_->no_parameters : *found->second;
}

const std::vector<EffectSettings>& RunConfig::effects() const {
  return settings_->effects;
}

std::optional<RunConfig> RunConfig::derived(const std::string& name,
                                            const std::function<std::optional<RunConfig>()>& make) const {
  const std::lock_guard lock(settings_->mutex);
  auto found = settings_->derived.find(name);
  if (found == settings_->derived.end()) {
    Settings::Derived made;
    try {
      if (std::optional<RunConfig> run = make()) made = *std::move(run);
    } catch (const ConfigError& error) {
      made = error;
    }
    found = settings_->derived.emplace(name, std::move(made)).first;
  }
  if (const auto* error = std::get_if<ConfigError>(&found->second)) throw *error;
  const auto* run = std::get_if<RunConfig>(&found->second);
  return run ? std::optional(*run) : std::nullopt;
}

std::vector<std::pair<std::string, std::filesystem::path>> input_files(const RunConfig& config) {
  std::vector<std::pair<std::string, std::filesystem::path>> files;
  if (!config.mesh_file().empty()) files.emplace_back("/mesh/file", config.mesh_file());
  const std::vector<EffectSettings>& effects = config.effects();
  for (std::size_t i = 0; i < effects.size(); ++i)
    if (effects[i].values.has("file"))
      files.emplace_back(fmt::format("/effects/{}/file", i), effects[i].values.text("file"));
  return files;
}

Json point_json(const RunConfig& config) {
  Json point = Json::object();
  for (const auto& [pointer, value] : config.point) point[pointer] = value;
  return point;
}

std::string identity_text(const Json& resolved) {
  std::string text;  // as Json::dump() writes it, without a copy of it all: for thousands of runs
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
