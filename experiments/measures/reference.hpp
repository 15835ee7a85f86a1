// What `bendlab measures` prints.
#pragma once

#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Every measure: name, what it finds out, when a run has it, what it costs, its numbers with unit and
/// meaning.
std::string measures_text();
Json measures_json();

}  // namespace bendlab
