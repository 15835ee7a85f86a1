// Why no setting is advised, in sentences for the user.
#pragma once

#include <string>
#include <vector>

#include "experiments/advise/advice.hpp"

namespace bendlab {

/// Whether some setting that was run may be advised for a larger error, or for more time.
bool anything_fit(const Advice& advice);

/// The gravest first; empty if there is a best setting. `time_limit_s` as in AdviceOptions.
std::vector<std::string> why_none(const Advice& advice, const Demand& demand, double time_limit_s);

}  // namespace bendlab
