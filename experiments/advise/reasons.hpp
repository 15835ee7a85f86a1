// Why no setting is advised: what somebody who asked should know, a sentence each.
#pragma once

#include <string>
#include <vector>

#include "experiments/advise/advice.hpp"

namespace bendlab {

/// Whether errors mean anything: the reference is no ruin, and is known to less than largest_error.
bool reference_tells(const Advice& advice);

/// Whether a setting that was run or predicted may be advised, to somebody who asks for less, or has more
/// time.
bool anything_fit(const Advice& advice);

/// The gravest first; empty where there is a best. `time_limit_s` as in AdviceOptions.
std::vector<std::string> why_none(const Advice& advice, const Demand& demand, double time_limit_s);

}  // namespace bendlab
