// Programs that bring bending models, effects, solver methods and measures of their own: their code is not
// among our sources.
#pragma once

#include <string>

#include "experiments/config/run_config.hpp"

namespace bendlab {

/// For a run with something that this program added, or possibly with a measure that it added: 16 hex digits
/// over the program's file, so that a program that was changed makes other runs. For any other run empty.
std::string own_code_hash(const RunConfig& config);

}  // namespace bendlab
