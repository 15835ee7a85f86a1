#include "experiments/config/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/defaults.hpp"
#include "experiments/config/nearest_name.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/rules.hpp"

namespace bendlab {
namespace {

// Reads values of one row. Functions return nothing, and report it, where the JSON type or the range is
// wrong.
class Reader {
 public:
  Reader(const Parameter& row, ConfigProblems& problems) : row_(row), problems_(problems) {}

  std::optional<Value> read(const Json& given, const std::string& pointer) {
    if (given.is_null() && row_.default_value.kind == Default::Kind::none && !row_.required)
      return std::monostate{};
    switch (row_.type) {
      case ParameterType::boolean:
        return read_boolean(given, pointer);
      case ParameterType::integer:
        return read_integer(given, pointer);
      case ParameterType::number:
        return read_number(given, pointer);
      case ParameterType::text:
        return read_text(given, pointer);
      case ParameterType::numbers:
        return read_list<double>(given, pointer, ParameterType::number);
      case ParameterType::texts:
        return read_list<std::string>(given, pointer, ParameterType::text);
    }
    throw std::logic_error("read_value: unknown type");
  }

 private:
  std::nullopt_t wrong(const Json& given, const std::string& pointer, const std::string& hint = "") {
    const std::string unit = row_.unit.empty() || row_.unit == "1" ? "" : fmt::format(" (in {})", row_.unit);
    problems_.push_back({pointer, fmt::format("expected {}{}, got {}{}", expected_text(row_), unit,
                                              given_text(given), hint)});
    return std::nullopt;
  }

  bool in_range(double value) const {
    return std::isfinite(value) && (row_.above ? value > row_.minimum : value >= row_.minimum) &&
           value <= row_.maximum;
  }

  std::optional<Value> read_boolean(const Json& given, const std::string& pointer) {
    if (!given.is_boolean()) return wrong(given, pointer);
    return given.get<bool>();
  }

  std::optional<Value> read_number(const Json& given, const std::string& pointer) {
    if (!given.is_number() || !in_range(given.get<double>())) return wrong(given, pointer);
    return given.get<double>() + 0.0;  // -0 and 0 are the same setting
  }

  std::optional<Value> read_integer(const Json& given, const std::string& pointer) {
    constexpr double largest = 9007199254740992;  // 2⁵³: below it a double counts in ones
    if (!given.is_number()) return wrong(given, pointer);
    const double value = given.get<double>();
    if (!in_range(value) || std::abs(value) >= largest || value != std::floor(value))
      return wrong(given, pointer);
    return static_cast<std::int64_t>(value);
  }

  std::optional<Value> read_text(const Json& given, const std::string& pointer) {
    if (!given.is_string()) return wrong(given, pointer);
    std::string value = given.get<std::string>();
    const bool must_say_something = row_.choices.empty() && row_.default_value.kind == Default::Kind::none;
    if (must_say_something && value.empty()) return wrong(given, pointer, "; it must not be empty");
    if (!row_.choices.empty() && std::ranges::find(row_.choices, value) == row_.choices.end())
      return wrong(given, pointer, suggestion(value, row_.choices));
    return value;
  }

  template <class Entry>
  std::optional<Value> read_list(const Json& given, const std::string& pointer, ParameterType entry_type) {
    if (!given.is_array() || (row_.length != 0 && given.size() != row_.length)) return wrong(given, pointer);
    Parameter entry_row = row_;
    entry_row.type = entry_type;
    entry_row.required = true;  // no null among the entries
    Reader reader(entry_row, problems_);
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < given.size(); ++i)
      if (std::optional<Value> entry = reader.read(given[i], child_pointer(pointer, std::to_string(i))))
        entries.push_back(std::get<Entry>(*std::move(entry)));
    return entries.size() == given.size() ? std::optional<Value>(std::move(entries)) : std::nullopt;
  }

  const Parameter& row_;
  ConfigProblems& problems_;
};

const std::vector<std::string>& every_pointer() {
  static const std::vector<std::string> pointers = known_pointers(Json::object());
  return pointers;
}

void report_unknown_key(const std::string& key, const std::string& pointer,
                        std::span<const std::string_view> allowed, ConfigProblems& problems) {
  std::string near = suggestion(key, allowed);
  if (near.empty()) near = same_key_suggestion(key, every_pointer());
  const std::string list = allowed.empty() ? "nothing" : fmt::format("{}", fmt::join(allowed, ", "));
  problems.push_back(
      {child_pointer(pointer, key), fmt::format("there is no setting '{}' here{} Allowed here: {}", key,
                                                near.empty() ? "." : near, list)});
}

bool is_object(const Json& given, const std::string& pointer, ConfigProblems& problems) {
  if (!given.is_object()) problems.push_back({pointer, "expected an object {…}, got " + given_text(given)});
  return given.is_object();
}

// The settings of a section that states none, if none has to be stated: a config states few sections, and a
// sweep is thousands of configs.
const Json* unstated(const ConfigSection& section) {
  static const std::map<std::string_view, Json> all = [] {
    std::map<std::string_view, Json> sections;
    for (const ConfigSection& each : config_sections()) {
      ConfigProblems missing;
      Json defaults = read_settings(Json::object(), std::string(each.pointer), each.parameters, {}, missing);
      if (missing.empty()) sections.emplace(each.pointer, std::move(defaults));
    }
    return sections;
  }();
  const auto found = all.find(section.pointer);
  return found == all.end() ? nullptr : &found->second;
}

Json read_section(const Json& given, const ConfigSection& section, ConfigProblems& problems) {
  static const Json nothing = Json::object();
  const std::string pointer(section.pointer);
  const Json& object = is_object(given, pointer, problems) ? given : nothing;
  const std::vector<const ConfigSection*> children = child_sections(pointer);
  std::vector<std::string_view> keys;
  for (const ConfigSection* child : children) keys.push_back(section_key(*child));
  if (pointer.empty())
    for (const ConfigList& list : config_lists()) keys.push_back(list.name);
  const Json* const defaults = object.empty() ? unstated(section) : nullptr;
  Json canonical =
      defaults != nullptr ? *defaults : read_settings(object, pointer, section.parameters, keys, problems);
  for (const ConfigSection* child : children) {
    const std::string key(section_key(*child));
    const auto found = object.find(key);
    const bool of_another_model = pointer == "/bending" && canonical["model"] != key;
    if (found == object.end() && of_another_model) continue;
    canonical[key] = read_section(found != object.end() ? *found : nothing, *child, problems);
  }
  return canonical;
}

// One entry of `effects`; null where its type is not known.
Json read_effect(const Json& given, const std::string& pointer, ConfigProblems& problems) {
  if (!is_object(given, pointer, problems)) return nullptr;
  const Parameter& type = effect_type_parameter();
  const std::string type_pointer = child_pointer(pointer, type.name);
  if (!given.contains(type.name)) {
    problems.push_back({type_pointer, "is missing: expected " + expected_text(type)});
    return nullptr;
  }
  const std::optional<Value> name = read_value(type, given[std::string(type.name)], type_pointer, problems);
  if (!name) return nullptr;
  Json canonical = Json::object();
  canonical[std::string(type.name)] = json_of(*name);
  const Effect* effect = find_effect(std::get<std::string>(*name));
  canonical.update(read_settings(given, pointer, effect->parameters, std::array{type.name}, problems));
  return canonical;
}

Json read_effects(const Json& given, ConfigProblems& problems) {
  Json canonical = Json::array();
  if (!given.is_array()) {
    problems.push_back({"/effects", "expected a list of objects {\"type\": …}, got " + given_text(given)});
    return canonical;
  }
  constexpr std::size_t most = 1000;
  if (given.size() > most) {
    problems.push_back(
        {"/effects", fmt::format("has {} entries, and at most {} are read", given.size(), most)});
    return canonical;
  }
  std::vector<std::pair<Json, std::string>> seen;  // type, pointer
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string pointer = fmt::format("/effects/{}", i);
    Json effect = read_effect(given[i], pointer, problems);
    if (effect.is_null()) continue;
    const auto same = std::ranges::find(seen, effect["type"], &std::pair<Json, std::string>::first);
    if (same != seen.end() && !find_effect(effect["type"].get<std::string>())->repeatable)
      problems.push_back({pointer, fmt::format("effect {} is there already at {}; list each type once",
                                               effect["type"].dump(), same->second)});
    seen.emplace_back(effect["type"], pointer);
    canonical.push_back(std::move(effect));
  }
  return canonical;
}

}  // namespace

std::optional<Value> read_value(const Parameter& row, const Json& given, const std::string& pointer,
                                ConfigProblems& problems) {
  return Reader(row, problems).read(given, pointer);
}

Json json_of(const Value& value) {
  return std::visit(
      [](const auto& typed) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(typed)>, std::monostate>)
          return nullptr;
        else
          return typed;
      },
      value);
}

Json read_settings(const Json& given, const std::string& pointer, std::span<const Parameter> table,
                   std::span<const std::string_view> other_keys, ConfigProblems& problems) {
  std::vector<std::string_view> allowed = names_of(table);
  allowed.insert(allowed.end(), other_keys.begin(), other_keys.end());
  for (const auto& [key, value] : given.items())
    if (std::ranges::find(allowed, key) == allowed.end()) report_unknown_key(key, pointer, allowed, problems);

  Json canonical = Json::object();
  for (const Parameter& row : table) {
    const std::string key(row.name);
    std::optional<Value> value;
    if (const auto found = given.find(key); found != given.end())
      value = read_value(row, *found, child_pointer(pointer, key), problems);
    else if (row.required)
      problems.push_back(
          {child_pointer(pointer, key), fmt::format("is missing: expected {}", expected_text(row))});
    Json json = json_of(value ? *value : default_of(row));
    if (!json.is_null()) canonical[key] = std::move(json);
  }
  return canonical;
}

ParameterValues values_of(const Json& canonical, std::span<const Parameter> table) {
  ParameterValues values(table);
  ConfigProblems problems;
  for (const Parameter& row : table)
    if (const std::string key(row.name); canonical.contains(key)) {
      std::optional<Value> value = read_value(row, canonical[key], key, problems);
      if (!value) throw std::invalid_argument(fmt::format("{}: {}", key, problems.front().message));
      values.set(row.name, *std::move(value));
    }
  return values;
}

Json resolve(const Json& settings, ConfigProblems& problems) {
  const Json filled = with_defaults(settings, problems);
  Json canonical = read_section(filled, *find_section(""), problems);
  canonical["effects"] = read_effects(filled["effects"], problems);
  apply_rules(filled, canonical, problems);
  for (const char* name : {"name", "description", "allow", "defaults"}) canonical.erase(name);
  return canonical;
}

}  // namespace bendlab
