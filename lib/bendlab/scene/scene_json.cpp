#include "bendlab/scene/scene_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bendlab/scene/defaults.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/rules.hpp"
#include "bendlab/scene/scene_tables.hpp"

namespace bendlab {
namespace {

const Json& object_at(const Json& given, std::string_view key, const std::string& pointer,
                      ConfigProblems& problems) {
  static const Json nothing = Json::object();
  const auto entry = given.find(key);
  if (entry == given.end()) return nothing;
  return is_object(*entry, pointer, problems) ? *entry : nothing;
}

// A copy of `before`, changed by the settings in `given`.
template <class Kind>
Chosen<Kind> chosen(const Chosen<Kind>& before, const Json& given, const std::string& pointer,
                    std::span<const std::string_view> other_keys, ConfigProblems& problems) {
  std::shared_ptr<void> settings = before.kind().settings.copy(before.settings());
  read_fields(before.kind().settings, settings.get(), given, pointer, other_keys, problems);
  return {before.kind(), std::move(settings)};
}

// Checks the settings of a bending model that is not chosen: they do nothing, but have to be valid.
template <class Kind>
void check_other(const Kind& kind, const Json& given, const std::string& pointer, ConfigProblems& problems) {
  const std::shared_ptr<void> settings = kind.settings.copy(kind.settings.defaults());
  read_fields(kind.settings, settings.get(), given, pointer, {}, problems);
}

template <class Kind>
const Kind* named_kind(const SettingRow& row, const Json& given, const std::string& pointer,
                       const Kind* (*find)(std::string_view), ConfigProblems& problems) {
  const auto entry = given.find(row.field.name);
  if (entry == given.end()) return nullptr;
  const std::optional<Value> name =
      read_value(row.field, *entry, child_pointer(pointer, row.field.name), problems);
  return name ? find(std::get<std::string>(*name)) : nullptr;
}

const Section& section_at(std::string_view pointer) {
  return *std::ranges::find(scene_sections(), pointer, &Section::pointer);
}

// The keys of the parts that are objects in this part.
std::vector<std::string_view> keys_of_parts_in(std::string_view pointer) {
  std::vector<std::string_view> keys;
  for (const Part& part : scene_parts())
    if (part.pointer.size() > pointer.size() && part.pointer.starts_with(pointer) &&
        part.pointer[pointer.size()] == '/' &&
        part.pointer.find('/', pointer.size() + 1) == std::string_view::npos)
      keys.push_back(part.pointer.substr(pointer.size() + 1));
  return keys;
}

void read_bending(const Part& part, Bending& bending, const Json& given, ConfigProblems& problems) {
  const std::string pointer(part.pointer);
  const SettingRow& choice = section_at(pointer).rows.front();
  if (const BendingKind* model = named_kind(choice, given, pointer, find_bending_model, problems);
      model != nullptr && model != &bending.model.kind())
    bending.model = BendingModel(*model);
  std::vector<std::string_view> other_keys = keys_of_parts_in(pointer);
  other_keys.push_back(choice.field.name);
  for (const BendingKind* model : bending_models())
    if (!model->settings.fields.empty()) other_keys.push_back(model->name);
  read_fields(part.table, &bending, given, pointer, other_keys, problems);
  for (const BendingKind* model : bending_models()) {
    const auto entry = given.find(model->name);
    if (model->settings.fields.empty() || entry == given.end()) continue;
    const std::string own = child_pointer(pointer, model->name);
    if (!is_object(*entry, own, problems)) continue;
    if (model == &bending.model.kind())
      bending.model = chosen(bending.model, *entry, own, {}, problems);
    else
      check_other(*model, *entry, own, problems);
  }
}

void read_solver(const Part& part, Solver& solver, const Json& given, ConfigProblems& problems) {
  const std::string pointer(part.pointer);
  const std::vector<SettingRow>& rows = section_at(pointer).rows;
  if (const MethodKind* method = named_kind(rows.front(), given, pointer, find_method, problems);
      method != nullptr && method != &solver.method.kind())
    solver.method = Method(*method);
  std::vector<std::string_view> other_keys;
  for (const SettingRow& row : rows)
    if (part.table.find(row.field.name) == nullptr) other_keys.push_back(row.field.name);
  read_fields(part.table, &solver, given, pointer, other_keys, problems);
  // Collects the settings of the chosen method. Settings of other methods are only checked.
  const FieldTable& own = solver.method.kind().settings;
  Json of_own = Json::object();
  for (const SettingRow& row : rows) {
    const auto entry = given.find(row.field.name);
    if (entry == given.end() || row.field.name == rows.front().field.name ||
        part.table.find(row.field.name) != nullptr)
      continue;
    if (own.find(row.field.name) != nullptr)
      of_own[std::string(row.field.name)] = *entry;
    else
      read_value(row.field, *entry, child_pointer(pointer, row.field.name), problems);
  }
  solver.method = chosen(solver.method, of_own, pointer, {}, problems);
}

// Reads an entry of `effects`; returns nothing if the effect's type is not known.
std::optional<Effect> read_effect(const Json& given, const std::string& pointer, ConfigProblems& problems) {
  if (!is_object(given, pointer, problems)) return std::nullopt;
  const SettingRow& type = effect_type_row();
  if (!given.contains(type.field.name)) {
    problems.push_back(
        {child_pointer(pointer, type.field.name), "is missing: expected " + expected_text(type.field)});
    return std::nullopt;
  }
  const EffectKind* const kind = named_kind(type, given, pointer, find_effect, problems);
  if (kind == nullptr) return std::nullopt;
  return chosen(Effect(*kind), given, pointer, std::array{type.field.name}, problems);
}

void read_effects(std::vector<Effect>& effects, const Json& given, ConfigProblems& problems) {
  effects.clear();
  if (!given.is_array()) {
    problems.push_back({"/effects", "expected a list of objects {\"type\": …}, got " + given_text(given)});
    return;
  }
  constexpr std::size_t most = 1000;
  if (given.size() > most) {
    problems.push_back(
        {"/effects", fmt::format("has {} entries, but at most {} are allowed", given.size(), most)});
    return;
  }
  for (std::size_t i = 0; i < given.size(); ++i)
    if (std::optional<Effect> effect = read_effect(given[i], fmt::format("/effects/{}", i), problems))
      effects.push_back(*std::move(effect));
}

template <class Kind>
void write_own(const Chosen<Kind>& member, const Scene& scene, Json& json) {
  write_fields(member.kind().settings, member.settings(), &scene, json);
}

}  // namespace

Scene read_scene(const Json& given, std::span<const std::string_view> other_keys, ConfigProblems& problems) {
  static const Json nothing = Json::object();
  const Json& top = is_object(given, "", problems) ? given : nothing;
  Scene scene = scene_before(top, problems);
  std::vector<std::string_view> keys(other_keys.begin(), other_keys.end());
  keys.insert(keys.end(), {"mesh", "pins", "material", "bending", "solver", "effects", "initial"});
  read_fields(scene_table(), &scene, top, "", keys, problems);
  for (const Part& part : scene_parts()) {
    const std::string pointer(part.pointer);
    const std::size_t slash = pointer.rfind('/');
    const Json* const parent = value_at(top, pointer.substr(0, slash));
    const Json& object = object_at(parent && parent->is_object() ? *parent : nothing,
                                   pointer.substr(slash + 1), pointer, problems);
    void* const owner = const_cast<void*>(part.in(scene));
    if (owner == &scene.bending)
      read_bending(part, scene.bending, object, problems);
    else if (owner == &scene.solver)
      read_solver(part, scene.solver, object, problems);
    else
      read_fields(part.table, owner, object, pointer, keys_of_parts_in(part.pointer), problems);
  }
  if (const auto effects = top.find("effects"); effects != top.end())
    read_effects(scene.effects, *effects, problems);
  settle(scene);
  check_stated(top, scene, problems);
  check_scene(scene, problems);
  return scene;
}

Json to_json(const Scene& scene) {
  Json json = Json::object();
  write_fields(scene_table(), &scene, &scene, json);
  for (const Part& part : scene_parts()) {
    if (part.is_absent != nullptr && part.is_absent(scene)) continue;
    Json& object = json[Json::json_pointer(std::string(part.pointer))];
    object = Json::object();
    const void* const owner = part.in(scene);
    if (owner == &scene.bending) object["model"] = scene.bending.model.name();
    if (owner == &scene.solver) object["method"] = scene.solver.method.name();
    write_fields(part.table, owner, &scene, object);
    if (owner == &scene.solver) write_own(scene.solver.method, scene, object);
    if (owner == &scene.bending && !scene.bending.model.kind().settings.fields.empty()) {
      Json& own = object[std::string(scene.bending.model.name())] = Json::object();
      write_own(scene.bending.model, scene, own);
    }
  }
  json["effects"] = effects_json(scene);
  return json;
}

Json effects_json(const Scene& scene) {
  Json list = Json::array();
  for (const Effect& effect : scene.effects) {
    Json& entry = list.emplace_back(Json::object());
    entry[std::string(effect_type_row().field.name)] = effect.name();
    write_own(effect, scene, entry);
  }
  return list;
}

Json default_effects(const Json& given) {
  ConfigProblems unclear;
  return effects_json(scene_before(given, unclear));
}

}  // namespace bendlab
