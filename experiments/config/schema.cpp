#include "experiments/config/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/defaults.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"

namespace bendlab {
namespace {

constexpr std::size_t text_width = 100;

// Words of `text` in lines of at most text_width characters, each line after `indent` spaces.
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

// Two lines per setting: name, unit, default and what is allowed; then the meaning.
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

void add_range(Json& schema, const SettingRow& row) {
  if (std::isfinite(row.field.minimum))
    schema[row.field.above ? "exclusiveMinimum" : "minimum"] = row.field.minimum;
  if (std::isfinite(row.field.maximum)) schema["maximum"] = row.field.maximum;
}

// Schema of one value of the setting, or of one entry where it is a list.
Json entry_schema(const SettingRow& row, const char* type) {
  Json schema = Json::object();
  schema["type"] = type;
  if (!row.field.choices.empty()) schema["enum"] = row.field.choices;
  if (row.field.type != FieldType::boolean && row.field.type != FieldType::text &&
      row.field.type != FieldType::texts)
    add_range(schema, row);
  return schema;
}

Json list_schema(const SettingRow& row, const char* entry_type) {
  Json schema = Json::object();
  schema["type"] = "array";
  schema["items"] = entry_schema(row, entry_type);
  if (row.field.length != 0) {
    schema["minItems"] = row.field.length;
    schema["maxItems"] = row.field.length;
  }
  return schema;
}

Json value_schema(const SettingRow& row) {
  switch (row.field.type) {
    case FieldType::boolean:
      return entry_schema(row, "boolean");
    case FieldType::integer:
      return entry_schema(row, "integer");
    case FieldType::number:
      return entry_schema(row, "number");
    case FieldType::text:
      return entry_schema(row, "string");
    case FieldType::integers:
      return list_schema(row, "integer");
    case FieldType::numbers:
      return list_schema(row, "number");
    case FieldType::texts:
      return list_schema(row, "string");
  }
  throw std::logic_error("value_schema: unknown type");
}

Json setting_schema(const SettingRow& row) {
  Json schema = value_schema(row);
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
  Json schema = Json::object();
  schema["type"] = "object";
  schema["description"] = meaning;
  schema["additionalProperties"] = false;
  schema["properties"] = Json::object();
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
  Json schema = Json::object();
  schema["type"] = "array";
  schema["items"]["oneOf"] = std::move(kinds);
  schema["default"] = default_effects(Json::object());
  return schema;
}

Json sweep_schema() {
  Json list = Json::object(), all = Json::object(), schema = Json::object();
  list["type"] = "array";
  list["minItems"] = 1;
  all["const"] = "all";
  schema["type"] = "object";
  schema["additionalProperties"]["oneOf"] = Json::array({std::move(list), std::move(all)});
  return schema;
}

Json because_schema() {
  Json schema = Json::object();
  schema["type"] = "object";
  schema["additionalProperties"]["type"] = "string";
  return schema;
}

Json cover_schema() {
  Json strength = value_schema(rows_of(cover_table()).front());
  Json schema = Json::object();
  schema["oneOf"] =
      Json::array({std::move(strength), object_schema("Strength and seed", rows_of(cover_table()))});
  return schema;
}

Json expect_schema() {
  Json entry = object_schema("One bound; min, max or both", rows_of(expectation_table()));
  entry["properties"]["where"]["type"] = "object";
  entry["properties"]["where"]["description"] = expectation_where_meaning();
  Json schema = Json::object();
  schema["type"] = "array";
  schema["items"] = std::move(entry);
  return schema;
}

Json list_schema(std::string_view name) {
  if (name == "effects") return effects_schema();
  if (name == "cover") return cover_schema();
  if (name == "because") return because_schema();
  return name == "sweep" ? sweep_schema() : expect_schema();
}

// Name, then labelled lines; empty ones are left out.
std::string entry_text(std::string_view name, std::string_view summary, std::string_view source,
                       std::string_view limits, std::string_view compliance,
                       const std::vector<SettingRow>& parameters) {
  std::string text = fmt::format("{}\n{}", name, wrapped(summary, 2));
  if (!source.empty()) text += wrapped(fmt::format("Source: {}", source), 2);
  if (!limits.empty()) text += wrapped(fmt::format("Limits: {}", limits), 2);
  if (!compliance.empty()) text += wrapped(fmt::format("Compliance: {}", compliance), 2);
  return text + (parameters.empty() ? "  No settings\n" : rows_text(parameters));
}

}  // namespace

std::string schema_text() {
  std::string text =
      "A config is one JSON object, in SI units. A setting's pointer is that of its section and its name: "
      "/mesh/cells.\nAn optional setting may also be null, which means the same as leaving it out.\n";
  for (const Section& section : config_sections())
    text += fmt::format("\n{}\n{}{}", section.pointer.empty() ? "(top level)" : section.pointer,
                        wrapped(section.meaning, 2), rows_text(section.rows));
  for (const ConfigList& list : config_lists()) {
    text += fmt::format("\n/{}\n{}", list.name, wrapped(list.meaning, 2));
    if (list.name == "cover") text += rows_text(rows_of(cover_table()));
    if (list.name == "expect")
      text += rows_text(rows_of(expectation_table())) + wrapped("where: optional; an object", 2) +
              wrapped(expectation_where_meaning(), 6);
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
  schema["properties"]["$schema"]["type"] = "string";
  schema["properties"]["$schema"]["description"] =
      "Where an editor finds this schema; does not affect the runs";
  for (const ConfigList& list : config_lists()) {
    Json entry = list_schema(list.name);
    entry["description"] = list.meaning;
    schema["properties"][std::string(list.name)] = std::move(entry);
  }
  return schema;
}

std::string models_text() {
  std::string text;
  for (const BendingKind* model : bending_models())
    text += (text.empty() ? "" : "\n") + entry_text(model->name, model->summary, model->source, model->limits,
                                                    model->compliance, rows_of(model->settings));
  return text;
}

Json model_labels_json() {
  Json labels = Json::object();
  for (const BendingKind* model : bending_models()) labels[std::string(model->name)] = model->label;
  return labels;
}

Json models_json() {
  Json json = Json::array();
  for (const BendingKind* model : bending_models()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = model->name;
    entry["label"] = model->label;
    entry["summary"] = model->summary;
    entry["source"] = model->source;
    entry["limits"] = model->limits;
    entry["compliance"] = model->compliance;
    entry["parameters"] = rows_json(rows_of(model->settings));
  }
  return json;
}

namespace {

// The shared settings of /solver that it reads, and its own defaults for them.
std::vector<std::pair<std::string_view, int>> shared_settings(const MethodKind& method) {
  std::vector<std::pair<std::string_view, int>> shared = {{"dt", 0}};
  if (method.default_substeps > 0) shared.emplace_back("substeps", method.default_substeps);
  if (method.default_iterations > 0) shared.emplace_back("iterations", method.default_iterations);
  if (method.make_float != nullptr) shared.emplace_back("precision", 0);
  shared.emplace_back("threads", 0);
  return shared;
}

// "dt, substeps (default 1), …"
std::string shared_text(const MethodKind& method) {
  std::string text;
  for (const auto& [name, usual] : shared_settings(method))
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", name,
                        usual > 0 ? fmt::format(" (default {})", usual) : "");
  return text;
}

// What the method does with each effect that acts among projections.
std::string taken_effects(const MethodKind& method) {
  std::vector<std::string_view> refused, idle;
  for (const EffectKind* effect : effects())
    if (!method.takes_effect(effect->needs_projection, effect->acts_in_iterations))
      (effect->helps_projection ? idle : refused).push_back(effect->name);
  if (refused.empty() && idle.empty()) return "Takes every effect";
  return fmt::format("Refuses the effects {}{}", fmt::join(refused, ", "),
                     idle.empty() ? "" : fmt::format("; {}: nothing to do", fmt::join(idle, ", ")));
}

}  // namespace

std::string methods_text() {
  std::string text;
  for (const MethodKind* method : methods())
    text += (text.empty() ? "" : "\n") +
            entry_text(method->name, method->summary, method->source, method->limits, "",
                       rows_of(method->settings)) +
            wrapped(fmt::format("Also reads from /solver: {}", shared_text(*method)), 2) +
            wrapped(taken_effects(*method), 2);
  return text;
}

Json methods_json() {
  Json json = Json::array();
  for (const MethodKind* method : methods()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = method->name;
    entry["summary"] = method->summary;
    entry["source"] = method->source;
    entry["limits"] = method->limits;
    for (const auto& [name, usual] : shared_settings(*method)) entry["shared"].push_back(name);
    Json& taken = entry["effects"] = Json::object();
    for (const EffectKind* effect : effects())
      taken[std::string(effect->name)] =
          method->takes_effect(effect->needs_projection, effect->acts_in_iterations) ? "takes"
          : effect->helps_projection                                                 ? "nothing to do"
                                                                                     : "refuses";
    entry["parameters"] = rows_json(rows_of(method->settings));
  }
  return json;
}

std::string effects_text() {
  std::string text;
  for (const EffectKind* effect : effects())
    text += (text.empty() ? "" : "\n") +
            entry_text(effect->name, effect->summary, effect->source, "", "", rows_of(effect->settings));
  return text;
}

Json effects_json() {
  Json json = Json::array();
  for (const EffectKind* effect : effects()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = effect->name;
    entry["summary"] = effect->summary;
    entry["source"] = effect->source;
    entry["parameters"] = rows_json(rows_of(effect->settings));
  }
  return json;
}

}  // namespace bendlab
