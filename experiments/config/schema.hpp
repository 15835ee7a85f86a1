// The reference: every section, setting, bending model and effect, from the tables that parse configs.
#pragma once

#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// The config reference for a terminal.
std::string schema_text();

/// The same as JSON Schema (draft 2020-12), units as "x-unit": for editors and other programs.
Json schema_json();

/// The registered bending models: name, what is joined to what, source, limits, settings with defaults.
std::string models_text();
Json models_json();

/// {name: label} of the bending models, in the order of the registry.
Json model_labels_json();

/// The registered solver methods: name, what a step does, source, limits, settings with defaults, shared
/// settings read.
std::string methods_text();
Json methods_json();

/// The registered effects: name, what it does, source, settings with defaults.
std::string effects_text();
Json effects_json();

}  // namespace bendlab
