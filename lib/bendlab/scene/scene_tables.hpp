// Every setting of a scene, row by row: what parses configs, writes them and prints the reference.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// A struct of the scene: its pointer in a config, what it is for, and its rows.
struct Part {
  std::string_view pointer, meaning;
  FieldTable table;
  const void* (*in)(const Scene& scene);  ///< where it is
};

/// "/mesh", "/pins", "/material", "/material/strain", "/bending", "/solver" and "/initial". What chooses a
/// member of a family, and that one's own settings, are not in their tables.
std::span<const Part> scene_parts();

/// The scene's own settings: "/duration".
const FieldTable& scene_table();

/// A row of the reference: a setting and its default.
struct SettingRow {
  Field field;
  Value usual;  ///< `std::monostate`: none
};

/// A JSON object of a config, with all settings that it may have.
struct Section {
  std::string pointer;  ///< "" for the top level, "/mesh", "/material/strain", …
  std::string meaning;
  std::vector<SettingRow> rows;
};

/// The sections of a scene, parents before children, in the order of the reference: the parts, with settings
/// of methods in "/solver", and "/bending/<model>" for each registered bending model that has settings.
std::span<const Section> scene_sections();

/// The `type` of an entry of `effects`; its other settings are the effect's own.
const SettingRow& effect_type_row();

/// The choices of the setting `field.depends_on` with which a scene reads the setting.
std::vector<std::string_view> choices_that_read(const Field& field);

/// The rows of a table with their defaults.
std::vector<SettingRow> rows_of(const FieldTable& table);

}  // namespace bendlab
