// The tables of all settings of a scene. Their rows parse configs, write configs, and print the reference of
// settings.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// A struct of the scene: its pointer in a config, its meaning, and its rows.
struct Part {
  std::string_view pointer, meaning;
  FieldTable table;
  const void* (*in)(const Scene& scene);  ///< the struct in a scene
};

/// "/mesh", "/pins", "/material", "/material/strain", "/bending", "/solver" and "/initial". The tables do not
/// hold the settings that choose a bending model or a method, nor the own settings of models and methods.
std::span<const Part> scene_parts();

/// The scene's own settings: "/duration".
const FieldTable& scene_table();

/// A row of the reference: a setting and its default.
struct SettingRow {
  Field field;
  Value usual;  ///< `std::monostate`: no default
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

/// The choices of the setting `field.depends_on` with which a scene reads the setting `field`.
std::vector<std::string_view> choices_that_read(const Field& field);

/// The rows of a table with their defaults.
std::vector<SettingRow> rows_of(const FieldTable& table);

}  // namespace bendlab
