#include "experiments/config/pointers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "bendlab/effects/effect.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/nearest_name.hpp"

namespace bendlab {
namespace {

using Pointer = Json::json_pointer;

// The index that a pointer's part stands for in a list of `size` entries, or nothing.
std::optional<std::size_t> list_index(std::string_view part, std::size_t size) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool canonical =
      error == std::errc() && end == part.data() + part.size() && (part.size() == 1 || part[0] != '0');
  return canonical && index < size ? std::optional(index) : std::nullopt;
}

Json* place_at(Json& document, const Pointer& pointer) {
  if (pointer.empty()) return &document;
  Json* parent = place_at(document, pointer.parent_pointer());
  if (parent == nullptr) return nullptr;
  if (parent->is_array()) {
    const auto index = list_index(pointer.back(), parent->size());
    return index ? &(*parent)[*index] : nullptr;
  }
  if (!parent->is_object() && !parent->is_null()) return nullptr;
  return &(*parent)[pointer.back()];
}

// The table of the effect in an entry of `effects`; empty where its type is not known.
std::span<const Parameter> effect_table(const Json& entry) {
  if (!entry.is_object() || !entry.contains("type") || !entry["type"].is_string()) return {};
  const Effect* effect = find_effect(entry["type"].get_ref<const std::string&>());
  return effect == nullptr ? std::span<const Parameter>() : effect->parameters;
}

const Parameter* find_row(std::span<const Parameter> table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &Parameter::name);
  return found == table.end() ? nullptr : &*found;
}

std::string_view last_part(std::string_view pointer) {
  return pointer.substr(pointer.rfind('/') + 1);
}

}  // namespace

std::string child_pointer(std::string_view parent, std::string_view key) {
  std::string pointer(parent);  // RFC 6901; for every setting of thousands of runs
  pointer += '/';
  for (const char c : key)
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  return pointer;
}

bool lies_within(std::string_view pointer, std::string_view container) {
  return pointer.starts_with(container) &&
         (pointer.size() == container.size() || pointer[container.size()] == '/');
}

const Json* value_at(const Json& document, const std::string& pointer) {
  const Pointer parsed(pointer);
  return document.contains(parsed) ? &document.at(parsed) : nullptr;
}

bool set_at(Json& document, const std::string& pointer, Json value) {
  Json* place = place_at(document, Pointer(pointer));
  if (place != nullptr) *place = std::move(value);
  return place != nullptr;
}

std::vector<std::string> known_pointers(const Json& settings) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& container, std::span<const Parameter> table) {
    if (!container.empty()) known.push_back(container);
    for (const Parameter& row : table) known.push_back(child_pointer(container, row.name));
  };
  for (const ConfigSection& section : config_sections())
    add(std::string(section.pointer), section.parameters);
  known.push_back("/effects");
  if (const Json* effects = value_at(settings, "/effects"); effects != nullptr && effects->is_array())
    for (std::size_t i = 0; i < effects->size(); ++i) {
      add(fmt::format("/effects/{}", i), effect_table((*effects)[i]));
      known.push_back(fmt::format("/effects/{}/type", i));
    }
  // The name and the description say nothing about the physics.
  std::erase_if(known,
                [](const std::string& pointer) { return pointer == "/name" || pointer == "/description"; });
  return known;
}

const Parameter* find_parameter(const Json& settings, std::string_view pointer) {
  const std::string parent(pointer.substr(0, pointer.rfind('/')));
  const std::string_view name = last_part(pointer);
  if (const ConfigSection* section = find_section(parent)) return find_row(section->parameters, name);
  if (!parent.starts_with("/effects/")) return nullptr;
  if (name == effect_type_parameter().name) return &effect_type_parameter();
  const Json* entry = value_at(settings, parent);
  return entry == nullptr ? nullptr : find_row(effect_table(*entry), name);
}

std::string same_key_suggestion(std::string_view key, const std::vector<std::string>& known) {
  const auto found = std::ranges::find(known, key, last_part);
  return found == known.end() ? "" : fmt::format("; did you mean '{}'?", *found);
}

std::string unknown_pointer_text(std::string_view pointer, const std::vector<std::string>& known) {
  if (pointer == "/name" || pointer == "/description") return "it has no influence on a run";
  const bool in_an_entry =
      pointer.starts_with("/effects/") && std::ranges::none_of(known, [&](const std::string& place) {
        return place.starts_with("/effects/") && lies_within(pointer, place.substr(0, place.find('/', 9)));
      });
  if (in_an_entry)
    return fmt::format(
        "there is no setting '{}': the config's list of effects has no such entry; write the "
        "list /effects in the config to set or sweep a value of an entry",
        pointer);
  std::string near = suggestion(pointer, known);
  if (near.empty()) near = same_key_suggestion(last_part(pointer), known);
  return fmt::format("there is no setting '{}'{} ('bendlab schema' lists every setting)", pointer, near);
}

}  // namespace bendlab
