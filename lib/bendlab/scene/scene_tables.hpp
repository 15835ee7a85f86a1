// Tables of all settings of a scene, used to read configs, to write configs and to print the reference.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// A struct of the scene: pointer in a config, meaning, and table of settings.
struct Part {
  std::string_view pointer, meaning;
  FieldTable table;
  const void* (*in)(const Scene& scene);            ///< the struct in a scene
  bool (*is_absent)(const Scene& scene) = nullptr;  ///< whether to_json() leaves the part out; null: never
};

/// "/mesh", "/mesh/surface", "/pins", "/material", "/material/strain", "/bending", "/solver", "/initial" and
/// "/initial/surface". The tables leave out the settings that choose a bending model or a method, and the
/// settings of models and methods.
std::span<const Part> scene_parts();

/// The scene's own settings: "/duration".
const FieldTable& scene_table();

/// A row of the printed reference: a setting and the default.
struct SettingRow {
  Field field;
  Value usual;  ///< `std::monostate`: no default
};

/// A JSON object of a config, with all settings that are allowed in that object.
struct Section {
  std::string pointer;  ///< "" for the top level, "/mesh", "/material/strain", …
  std::string meaning;
  std::vector<SettingRow> rows;
};

/// All sections in the order of the printed reference, parents before children: the parts of the scene, and
/// "/bending/<model>" for each registered model with settings. "/solver" has the settings of all methods.
std::span<const Section> scene_sections();

/// The setting `type` of an entry of `effects`; the other settings depend on the type.
const SettingRow& effect_type_row();

/// The values of the setting `field.depends_on` for which a scene reads the setting `field`.
std::vector<std::string_view> choices_that_read(const Field& field);

/// The rows of a table with the default of each setting.
std::vector<SettingRow> rows_of(const FieldTable& table);

}  // namespace bendlab
