#include "experiments/config/settings_by_pointer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "bendlab/scene/pointers.hpp"
#include "experiments/config/config_tables.hpp"

namespace bendlab {
namespace {

// The settings of the effect in an entry of `effects`; empty if the effect's type is unknown.
std::span<const Field> effect_table(const Json& entry) {
  if (!entry.is_object() || !entry.contains("type") || !entry["type"].is_string()) return {};
  const EffectKind* effect = find_effect(entry["type"].get_ref<const std::string&>());
  return effect == nullptr ? std::span<const Field>() : effect->settings.fields;
}

std::string_view last_part(std::string_view pointer) {
  return pointer.substr(pointer.rfind('/') + 1);
}

// "; did you mean '/solver/dt'?", for the first pointer in `known` that ends in `key`; "" if no pointer does.
std::string same_key_suggestion(std::string_view key, const std::vector<std::string>& known) {
  const auto found = std::ranges::find(known, key, last_part);
  return found == known.end() ? "" : fmt::format("; did you mean '{}'?", *found);
}

}  // namespace

std::vector<std::string> known_pointers(const Json& settings) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& container, const std::string_view name) {
    known.push_back(child_pointer(container, name));
  };
  for (const Section& section : config_sections()) {
    if (!section.pointer.empty()) known.push_back(section.pointer);
    for (const SettingRow& row : section.rows) add(section.pointer, row.field.name);
  }
  known.push_back("/effects");
  if (const Json* effects = value_at(settings, "/effects"); effects != nullptr && effects->is_array())
    for (std::size_t i = 0; i < effects->size(); ++i) {
      const std::string entry = fmt::format("/effects/{}", i);
      known.push_back(entry);
      for (const Field& field : effect_table((*effects)[i])) add(entry, field.name);
      add(entry, effect_type_row().field.name);
    }
  // Name and description do not affect a run, so nothing may sweep them.
  std::erase_if(known,
                [](const std::string& pointer) { return pointer == "/name" || pointer == "/description"; });
  return known;
}

std::map<std::string, Json> flattened(const Json& object, const std::string& pointer) {
  std::map<std::string, Json> flat;
  for (const auto& [key, value] : object.items())
    if (const std::string place = child_pointer(pointer, key); value.is_object())
      flat.merge(flattened(value, place));
    else
      flat[place] = value;
  return flat;
}

const Field* find_setting(const Json& settings, std::string_view pointer) {
  const std::string parent(pointer.substr(0, pointer.rfind('/')));
  const std::string_view name = last_part(pointer);
  if (const Section* section = find_section(parent)) {
    const auto row = std::ranges::find_if(
        section->rows, [&](const SettingRow& candidate) { return candidate.field.name == name; });
    return row == section->rows.end() ? nullptr : &row->field;
  }
  if (!parent.starts_with("/effects/")) return nullptr;
  if (name == effect_type_row().field.name) return &effect_type_row().field;
  const Json* entry = value_at(settings, parent);
  if (entry == nullptr) return nullptr;
  const std::span<const Field> table = effect_table(*entry);
  const auto found = std::ranges::find(table, name, &Field::name);
  return found == table.end() ? nullptr : &*found;
}

std::string unknown_pointer_text(std::string_view pointer, const std::vector<std::string>& known) {
  if (pointer == "/name" || pointer == "/description") return "this does not affect the runs";
  const bool in_an_entry =
      pointer.starts_with("/effects/") && std::ranges::none_of(known, [&](const std::string& place) {
        return place.starts_with("/effects/") && lies_within(pointer, place.substr(0, place.find('/', 9)));
      });
  if (in_an_entry)
    return fmt::format(
        "there is no setting '{}': the config's list /effects has no such entry; add the entry to the list "
        "before you set or sweep its values",
        pointer);
  std::string near = suggestion(pointer, known);
  if (near.empty()) near = same_key_suggestion(last_part(pointer), known);
  return fmt::format("there is no setting '{}'{} ('bendlab schema' lists every setting)", pointer, near);
}

}  // namespace bendlab
