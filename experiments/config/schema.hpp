// The reference: every section, setting, bending model and effect, from the tables that parse configs.
#pragma once

#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// The config reference for a terminal.
std::string schema_text();

/// The same as JSON Schema (draft 2020-12), units as "x-unit", and what figures ask of models and methods:
/// for editors and other programs.
Json schema_json();

/// The registered bending models: name, what is joined to what, source, limits, settings with defaults.
std::string models_text();
Json models_json();

/// {name: {"label", "made_of", "prestressed"}} of the bending models, in the order of the registry: what
/// figures ask of them. Run files, sweep files and the schema ("x-models") have it.
Json model_traits_json();

/// The registered solver methods: name, what a step does, source, limits, settings with defaults, shared
/// settings read.
std::string methods_text();
Json methods_json();

/// {name: {setting: default}} of the solver methods, in the order of the registry: for those of their own
/// settings that are a choice. Where model_traits_json() is ("x-methods").
Json method_traits_json();

/// The registered effects: name, what it does, source, settings with defaults.
std::string effects_text();
Json effects_json();

}  // namespace bendlab
