// What holds between settings: which need each other, which exclude each other, and which have no part in the
// result.
#pragma once

#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// Takes from `canonical`, whose values are each right by themselves, what has no part in the result, and
/// reports what does not go together. `given` is what somebody wrote.
void apply_rules(const Json& given, Json& canonical, ConfigProblems& problems);

}  // namespace bendlab
