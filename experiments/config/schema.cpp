#include "experiments/config/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/scene_json.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/sweep.hpp"

namespace bendlab {
namespace {

constexpr std::size_t text_width = 100;

// `text` in lines of at most text_width characters, each indented by `indent` spaces.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result, line;
  const auto end_line = [&] {
    if (!line.empty()) result += std::string(indent, ' ') + line + '\n';
    line.clear();
  };
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (!line.empty() && indent + line.size() + 1 + word.size() > text_width) end_line();
    line += (line.empty() ? "" : " ") + std::string(word);
  }
  end_line();
  return result;
}

std::string default_text(const SettingRow& row) {
  if (row.field.required) return "required";
  const Json value = json_of(row.usual);
  return value.is_null() ? "optional" : "default " + value.dump();
}

std::string unit_text(const SettingRow& row) {
  return row.field.unit.empty() || row.field.unit == "1" ? "" : fmt::format(" [{}]", row.field.unit);
}

// Two lines per setting: first name, unit, default and allowed values, then the meaning.
std::string rows_text(const std::vector<SettingRow>& table) {
  std::string text;
  for (const SettingRow& row : table) {
    text += wrapped(fmt::format("{}{}: {}; {}", row.field.name, unit_text(row), default_text(row),
                                expected_text(row.field)),
                    2);
    text += wrapped(row.field.meaning, 6);
  }
  return text;
}

Json row_json(const SettingRow& row) {
  Json json = Json::object();
  json["name"] = row.field.name;
  json["expected"] = expected_text(row.field);
  if (!row.field.unit.empty()) json["unit"] = row.field.unit;
  json["default"] = json_of(row.usual);
  json["required"] = row.field.required;
  json["meaning"] = row.field.meaning;
  return json;
}

Json rows_json(const std::vector<SettingRow>& table) {
  Json json = Json::array();
  for (const SettingRow& row : table) json.push_back(row_json(row));
  return json;
}

// Schema of the setting's value, without its default.
Json value_schema(const Field& field) {
  constexpr std::array types = {"boolean", "integer", "number", "string",
                                "integer", "number",  "string"};  // as FieldType; for lists, of an entry
  Json entry = {{"type", types.at(static_cast<std::size_t>(field.type))}};
  if (!field.choices.empty()) entry["enum"] = field.choices;
  if (std::isfinite(field.minimum)) entry[field.above ? "exclusiveMinimum" : "minimum"] = field.minimum;
  if (std::isfinite(field.maximum)) entry["maximum"] = field.maximum;
  if (field.type < FieldType::integers) return entry;
  Json list = {{"type", "array"}, {"items", std::move(entry)}};
  if (field.length != 0) list.update({{"minItems", field.length}, {"maxItems", field.length}});
  return list;
}

Json setting_schema(const SettingRow& row) {
  Json schema = value_schema(row.field);
  const Json default_value = json_of(row.usual);
  if (!default_value.is_null()) schema["default"] = default_value;
  if (row.field.optional) {
    schema["type"] = Json::array({schema["type"], "null"});
    if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  }
  schema["description"] = row.field.meaning;
  if (!row.field.unit.empty()) schema["x-unit"] = row.field.unit;
  return schema;
}

Json object_schema(std::string_view meaning, const std::vector<SettingRow>& table) {
  Json schema = {{"type", "object"},
                 {"description", meaning},
                 {"additionalProperties", false},
                 {"properties", Json::object()}};
  Json required = Json::array();
  for (const SettingRow& row : table) {
    schema["properties"][std::string(row.field.name)] = setting_schema(row);
    if (row.field.required) required.push_back(row.field.name);
  }
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json section_schema(const Section& section) {
  Json schema = object_schema(section.meaning, section.rows);
  for (const Section* child : child_sections(section.pointer))
    schema["properties"][std::string(section_key(*child))] = section_schema(*child);
  return schema;
}

Json effect_schema(const EffectKind& effect) {
  Json schema = object_schema(effect.summary, rows_of(effect.settings));
  const std::string key(effect_type_row().field.name);
  schema["properties"][key]["const"] = effect.name;
  schema["required"].push_back(key);
  return schema;
}

Json effects_schema() {
  Json kinds = Json::array();
  for (const EffectKind* effect : effects()) kinds.push_back(effect_schema(*effect));
  return {{"type", "array"}, {"items", {{"oneOf", kinds}}}, {"default", default_effects(Json::object())}};
}

Json sweep_schema() {
  const Json list = {{"type", "array"}, {"minItems", 1}}, all = {{"const", "all"}};
  return {{"type", "object"}, {"additionalProperties", {{"oneOf", Json::array({list, all})}}}};
}

Json because_schema() {
  return {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}};
}

Json cover_schema() {
  return {{"oneOf", Json::array({value_schema(cover_table().fields.front()),
                                 object_schema("Strength and seed", rows_of(cover_table()))})}};
}

Json expect_schema() {
  Json entry = object_schema("One bound; min, max or both", rows_of(expectation_table()));
  entry["properties"]["where"] = {{"type", "object"}, {"description", where_meaning}};
  return {{"type", "array"}, {"items", entry}};
}

Json list_schema(std::string_view name) {
  if (name == "effects") return effects_schema();
  if (name == "cover") return cover_schema();
  if (name == "because") return because_schema();
  return name == "sweep" ? sweep_schema() : expect_schema();
}

}  // namespace

std::string schema_text() {
  std::string text =
      "A config is one JSON object, in SI units. The pointer of a setting is the pointer of its section and "
      "the setting's name, such as /mesh/cells.\nAn optional setting may also be null, which means the same "
      "as leaving it out.\n";
  for (const Section& section : config_sections())
    text += fmt::format("\n{}\n{}{}", section.pointer.empty() ? "(top level)" : section.pointer,
                        wrapped(section.meaning, 2), rows_text(section.rows));
  for (const ConfigList& list : config_lists()) {
    text += fmt::format("\n/{}\n{}", list.name, wrapped(list.meaning, 2));
    if (list.name == "cover") text += rows_text(rows_of(cover_table()));
    if (list.name == "expect")
      text += rows_text(rows_of(expectation_table())) + wrapped("where: optional; an object", 2) +
              wrapped(where_meaning, 6);
  }
  for (const EffectKind* effect : effects())
    text += fmt::format("\nan entry of /effects with \"type\": \"{}\"\n{}{}", effect->name,
                        wrapped(effect->summary, 2), rows_text(rows_of(effect->settings)));
  return text;
}

Json schema_json() {
  Json schema = Json::object();
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "bendlab config";
  schema.update(section_schema(*find_section("")));
  schema["properties"]["$schema"] = {
      {"type", "string"}, {"description", "Where an editor finds this schema; does not affect the runs"}};
  for (const ConfigList& list : config_lists()) {
    Json entry = list_schema(list.name);
    entry["description"] = list.meaning;
    schema["properties"][std::string(list.name)] = std::move(entry);
  }
  schema["x-models"] = model_traits_json();
  schema["x-methods"] = method_traits_json();
  return schema;
}

Json model_traits_json() {
  Json traits = Json::object();
  for (const BendingKind* model : bending_models())
    traits[std::string(model->name)] = {
        {"label", model->label}, {"made_of", made_of(*model)}, {"prestressed", model->prestressed}};
  return traits;
}

namespace {

// The shared settings of /solver that the method reads, each with the method's own default (0: no default).
std::vector<std::pair<std::string_view, int>> shared_settings(const MethodKind& method) {
  std::vector<std::pair<std::string_view, int>> shared = {{"dt", 0}};
  if (method.default_substeps > 0) shared.emplace_back("substeps", method.default_substeps);
  if (method.default_iterations > 0) shared.emplace_back("iterations", method.default_iterations);
  if (method.make_float != nullptr) shared.emplace_back("precision", 0);
  shared.emplace_back("threads", 0);
  return shared;
}

bool takes(const MethodKind& method, const EffectKind& effect) {
  return method.takes_effect(effect.needs_projection, effect.acts_in_iterations);
}

// The effects that the method refuses, and the effects that are of no use to the method.
std::string taken_effects(const MethodKind& method) {
  std::vector<std::string_view> refused, without_work;
  for (const EffectKind* effect : effects())
    if (!takes(method, *effect)) (effect->helps_projection ? without_work : refused).push_back(effect->name);
  if (refused.empty() && without_work.empty()) return "Takes every effect";
  return fmt::format(
      "Refuses the effects {}{}", fmt::join(refused, ", "),
      without_work.empty() ? "" : fmt::format("; has nothing to do for {}", fmt::join(without_work, ", ")));
}

// The shared settings that a method reads, "dt, substeps (default 1), …", and the effects that it takes.
std::string more_text(const MethodKind& method) {
  std::vector<std::string> shared;
  for (const auto& [name, usual] : shared_settings(method))
    shared.push_back(usual > 0 ? fmt::format("{} (default {})", name, usual) : std::string(name));
  return wrapped(fmt::format("Also reads from /solver: {}", fmt::join(shared, ", ")), 2) +
         wrapped(taken_effects(method), 2);
}
std::string more_text(const auto&) {
  return "";
}

void add_more(const MethodKind& method, Json& entry) {
  for (const auto& [name, usual] : shared_settings(method)) entry["shared"].push_back(name);
  Json& taken = entry["effects"] = Json::object();
  for (const EffectKind* effect : effects())
    taken[std::string(effect->name)] = takes(method, *effect)     ? "takes"
                                       : effect->helps_projection ? "nothing to do"
                                                                  : "refuses";
}
void add_more(const auto&, Json&) {}

// A text for each kind: the name, then lines with labels. A line without text is left out.
template <class Kind>
std::string kinds_text(std::span<const Kind* const> kinds) {
  std::string text;
  const auto add = [&](const char* label, std::string_view line) {
    if (!line.empty()) text += wrapped(fmt::format("{}: {}", label, line), 2);
  };
  for (const Kind* kind : kinds) {
    text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", kind->name, wrapped(kind->summary, 2));
    add("Source", kind->source);
    if constexpr (requires { kind->limits; }) add("Limits", kind->limits);
    if constexpr (requires { kind->compliance; }) add("Compliance", kind->compliance);
    if constexpr (requires { kind->takes_poisson_ratio; })
      if (kind->takes_poisson_ratio) add("Poisson's ratio", "/material/poisson_ratio");
    text += kind->settings.fields.empty() ? "  No settings\n" : rows_text(rows_of(kind->settings));
    text += more_text(*kind);
  }
  return text;
}

template <class Kind>
Json kinds_json(std::span<const Kind* const> kinds) {
  Json json = Json::array();
  for (const Kind* kind : kinds) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = kind->name;
    if constexpr (std::is_same_v<Kind, BendingKind>)
      entry["label"] = kind->label, entry["made_of"] = made_of(*kind),
      entry["prestressed"] = kind->prestressed;
    entry["summary"] = kind->summary, entry["source"] = kind->source;
    if constexpr (requires { kind->limits; }) entry["limits"] = kind->limits;
    if constexpr (requires { kind->compliance; }) entry["compliance"] = kind->compliance;
    if constexpr (requires { kind->takes_poisson_ratio; })
      entry["takes_poisson_ratio"] = kind->takes_poisson_ratio;
    add_more(*kind, entry);
    entry["settings"] = rows_json(rows_of(kind->settings));
  }
  return json;
}

}  // namespace

std::string models_text() {
  return kinds_text(bending_models());
}
Json models_json() {
  return kinds_json(bending_models());
}
std::string methods_text() {
  return kinds_text(methods());
}
Json methods_json() {
  return kinds_json(methods());
}

Json method_traits_json() {
  Json traits = Json::object();
  for (const MethodKind* method : methods()) {
    Json& defaults = traits[std::string(method->name)] = Json::object();
    for (const SettingRow& row : rows_of(method->settings))
      if (!row.field.choices.empty()) defaults[std::string(row.field.name)] = json_of(row.usual);
  }
  return traits;
}

std::string effects_text() {
  return kinds_text(effects());
}
Json effects_json() {
  return kinds_json(effects());
}

}  // namespace bendlab
