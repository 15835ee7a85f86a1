// Documentation from the tables that parse configs: every section, setting, bending model, method and effect.
#pragma once

#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// All settings of a config, for a terminal.
std::string schema_text();

/// All settings of a config as JSON Schema (draft 2020-12), for editors and other programs. Units are in
/// "x-unit". "x-models" and "x-methods" have the properties of models and methods that figures need.
Json schema_json();

/// The registered bending models: name, which vertices the model joins, source, limits, settings with
/// defaults.
std::string models_text();
Json models_json();

/// {name: {"label", "made_of", "prestressed"}} of the bending models, in the order of the registry, for
/// figures. Stored in run files, in sweep files and in the schema ("x-models").
Json model_traits_json();

/// The registered solver methods: name, what a step does, source, limits, settings with defaults, and the
/// shared settings that the method reads.
std::string methods_text();
Json methods_json();

/// {name: {setting: default}} of the solver methods, in the order of the registry: the method's own settings
/// that have choices. Stored in the same files as model_traits_json(); "x-methods" in the schema.
Json method_traits_json();

/// The registered effects: name, what it does, source, settings with defaults.
std::string effects_text();
Json effects_json();

}  // namespace bendlab
