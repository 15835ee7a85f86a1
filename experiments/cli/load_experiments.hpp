// The configs that a command was given.
#pragma once

#include <vector>

#include "experiments/cli/commands.hpp"

namespace bendlab {

/// All of them, or one ConfigsError with the problems of all.
std::vector<Experiment> load_experiments(const ConfigArguments& configs);

}  // namespace bendlab
