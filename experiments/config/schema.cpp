#include "experiments/config/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/defaults.hpp"
#include "experiments/config/resolve.hpp"

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

std::string default_text(const Parameter& row) {
  if (row.required) return "required";
  const Json value = json_of(default_of(row));
  return value.is_null() ? "optional" : "default " + value.dump();
}

std::string unit_text(const Parameter& row) {
  return row.unit.empty() || row.unit == "1" ? "" : fmt::format(" [{}]", row.unit);
}

// Two lines per setting: name, unit, default and what is allowed; then the meaning.
std::string rows_text(std::span<const Parameter> table) {
  std::string text;
  for (const Parameter& row : table) {
    text += wrapped(
        fmt::format("{}{}: {}; {}", row.name, unit_text(row), default_text(row), expected_text(row)), 2);
    text += wrapped(row.meaning, 6);
  }
  return text;
}

Json row_json(const Parameter& row) {
  Json json = Json::object();
  json["name"] = row.name;
  json["expected"] = expected_text(row);
  if (!row.unit.empty()) json["unit"] = row.unit;
  json["default"] = json_of(default_of(row));
  json["required"] = row.required;
  json["meaning"] = row.meaning;
  return json;
}

Json rows_json(std::span<const Parameter> table) {
  Json json = Json::array();
  for (const Parameter& row : table) json.push_back(row_json(row));
  return json;
}

void add_range(Json& schema, const Parameter& row) {
  if (std::isfinite(row.minimum)) schema[row.above ? "exclusiveMinimum" : "minimum"] = row.minimum;
  if (std::isfinite(row.maximum)) schema["maximum"] = row.maximum;
}

// Schema of one value of the setting, or of one entry where it is a list.
Json entry_schema(const Parameter& row, const char* type) {
  Json schema = Json::object();
  schema["type"] = type;
  if (!row.choices.empty()) schema["enum"] = row.choices;
  if (row.type == ParameterType::integer || row.type == ParameterType::number ||
      row.type == ParameterType::numbers)
    add_range(schema, row);
  return schema;
}

Json list_schema(const Parameter& row, const char* entry_type) {
  Json schema = Json::object();
  schema["type"] = "array";
  schema["items"] = entry_schema(row, entry_type);
  if (row.length != 0) {
    schema["minItems"] = row.length;
    schema["maxItems"] = row.length;
  }
  return schema;
}

Json value_schema(const Parameter& row) {
  switch (row.type) {
    case ParameterType::boolean:
      return entry_schema(row, "boolean");
    case ParameterType::integer:
      return entry_schema(row, "integer");
    case ParameterType::number:
      return entry_schema(row, "number");
    case ParameterType::text:
      return entry_schema(row, "string");
    case ParameterType::numbers:
      return list_schema(row, "number");
    case ParameterType::texts:
      return list_schema(row, "string");
  }
  throw std::logic_error("value_schema: unknown type");
}

Json setting_schema(const Parameter& row) {
  Json schema = value_schema(row);
  const Json default_value = json_of(default_of(row));
  if (!default_value.is_null()) schema["default"] = default_value;
  if (default_value.is_null() && !row.required) {
    schema["type"] = Json::array({schema["type"], "null"});
    if (schema.contains("enum")) schema["enum"].push_back(nullptr);
  }
  schema["description"] = row.meaning;
  if (!row.unit.empty()) schema["x-unit"] = row.unit;
  return schema;
}

Json object_schema(std::string_view meaning, std::span<const Parameter> table) {
  Json schema = Json::object();
  schema["type"] = "object";
  schema["description"] = meaning;
  schema["additionalProperties"] = false;
  schema["properties"] = Json::object();
  Json required = Json::array();
  for (const Parameter& row : table) {
    schema["properties"][std::string(row.name)] = setting_schema(row);
    if (row.required) required.push_back(row.name);
  }
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json section_schema(const ConfigSection& section) {
  Json schema = object_schema(section.meaning, section.parameters);
  for (const ConfigSection* child : child_sections(section.pointer))
    schema["properties"][std::string(section_key(*child))] = section_schema(*child);
  return schema;
}

Json effect_schema(const Effect& effect) {
  Json schema = object_schema(effect.summary, effect.parameters);
  const std::string key(effect_type_parameter().name);
  schema["properties"][key]["const"] = effect.name;
  schema["required"].push_back(key);
  return schema;
}

Json effects_schema() {
  Json kinds = Json::array();
  for (const Effect* effect : effects()) kinds.push_back(effect_schema(*effect));
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
  Json strength = value_schema(cover_parameters()[0]);
  Json schema = Json::object();
  schema["oneOf"] =
      Json::array({std::move(strength), object_schema("Strength and seed", cover_parameters())});
  return schema;
}

Json expect_schema() {
  Json entry = object_schema("One bound; min, max or both", expectation_parameters());
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
                       std::span<const Parameter> parameters) {
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
  for (const ConfigSection& section : config_sections())
    text += fmt::format("\n{}\n{}{}", section.pointer.empty() ? "(top level)" : section.pointer,
                        wrapped(section.meaning, 2), rows_text(section.parameters));
  for (const ConfigList& list : config_lists()) {
    text += fmt::format("\n/{}\n{}", list.name, wrapped(list.meaning, 2));
    if (list.name == "cover") text += rows_text(cover_parameters());
    if (list.name == "expect")
      text += rows_text(expectation_parameters()) + wrapped("where: optional; an object", 2) +
              wrapped(expectation_where_meaning(), 6);
  }
  for (const Effect* effect : effects())
    text += fmt::format("\nan entry of /effects with \"type\": \"{}\"\n{}{}", effect->name,
                        wrapped(effect->summary, 2), rows_text(effect->parameters));
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
  for (const BendingModel* model : bending_models())
    text += (text.empty() ? "" : "\n") + entry_text(model->name, model->summary, model->source, model->limits,
                                                    model->compliance, model->parameters);
  return text;
}

Json model_labels_json() {
  Json labels = Json::object();
  for (const BendingModel* model : bending_models()) labels[std::string(model->name)] = model->label;
  return labels;
}

Json models_json() {
  Json json = Json::array();
  for (const BendingModel* model : bending_models()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = model->name;
    entry["label"] = model->label;
    entry["summary"] = model->summary;
    entry["source"] = model->source;
    entry["limits"] = model->limits;
    entry["compliance"] = model->compliance;
    entry["parameters"] = rows_json(model->parameters);
  }
  return json;
}

namespace {

// The shared settings of /solver that it reads.
std::vector<std::string_view> shared_settings(const Method& method) {
  std::vector<std::string_view> shared;
  for (const std::string_view name : names_of(find_section("/solver")->parameters))
    if (method.reads(name) &&
        std::ranges::find(method.parameters, name, &Parameter::name) == method.parameters.end())
      shared.push_back(name);
  return shared;
}

// "dt, substeps (default 1), …": the defaults that are the method's own.
std::string shared_text(const Method& method) {
  std::string text;
  for (const std::string_view name : shared_settings(method)) {
    const int own = name == "substeps"     ? method.default_substeps
                    : name == "iterations" ? method.default_iterations
                                           : 0;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", name,
                        own > 0 ? fmt::format(" (default {})", own) : "");
  }
  return text;
}

// What the method does with each effect that acts among projections.
std::string taken_effects(const Method& method) {
  std::vector<std::string_view> refused, idle;
  for (const Effect* effect : effects())
    if (!method.takes_effect(effect->name, effect->needs_projection))
      (effect->helps_projection ? idle : refused).push_back(effect->name);
  if (refused.empty() && idle.empty()) return "Takes every effect";
  return fmt::format("Refuses the effects {}{}", fmt::join(refused, ", "),
                     idle.empty() ? "" : fmt::format("; {}: nothing to do", fmt::join(idle, ", ")));
}

}  // namespace

std::string methods_text() {
  std::string text;
  for (const Method* method : methods())
    text +=
        (text.empty() ? "" : "\n") +
        entry_text(method->name, method->summary, method->source, method->limits, "", method->parameters) +
        wrapped(fmt::format("Also reads from /solver: {}", shared_text(*method)), 2) +
        wrapped(taken_effects(*method), 2);
  return text;
}

Json methods_json() {
  Json json = Json::array();
  for (const Method* method : methods()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = method->name;
    entry["summary"] = method->summary;
    entry["source"] = method->source;
    entry["limits"] = method->limits;
    entry["shared"] = shared_settings(*method);
    Json& taken = entry["effects"] = Json::object();
    for (const Effect* effect : effects())
      taken[std::string(effect->name)] = method->takes_effect(effect->name, effect->needs_projection)
                                             ? "takes"
                                         : effect->helps_projection ? "nothing to do"
                                                                    : "refuses";
    entry["parameters"] = rows_json(method->parameters);
  }
  return json;
}

std::string effects_text() {
  std::string text;
  for (const Effect* effect : effects())
    text += (text.empty() ? "" : "\n") +
            entry_text(effect->name, effect->summary, effect->source, "", "", effect->parameters);
  return text;
}

Json effects_json() {
  Json json = Json::array();
  for (const Effect* effect : effects()) {
    Json& entry = json.emplace_back(Json::object());
    entry["name"] = effect->name;
    entry["summary"] = effect->summary;
    entry["source"] = effect->source;
    entry["parameters"] = rows_json(effect->parameters);
  }
  return json;
}

}  // namespace bendlab
