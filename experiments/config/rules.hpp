// Rules between settings: which need each other, which exclude each other, which do not affect the result.
#pragma once

#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// Removes settings that do not affect the result from `canonical`, whose values are each valid alone.
/// Reports settings that do not go together, and names what replaced those of earlier versions. `given`: the
/// config as it was written.
void apply_rules(const Json& given, Json& canonical, ConfigProblems& problems);

}  // namespace bendlab
