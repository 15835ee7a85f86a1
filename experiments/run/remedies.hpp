// What helps a run that broke a bound or diverged: from trying it, not from belief. The trials stand in
// remedies.cpp.
#pragma once

#include <string>

#include "experiments/run/plausibility.hpp"

namespace bendlab {

/// What helped in the trials of the likely cause, with numbers; empty where nothing did, or the scene has it
/// all.
std::string remedies_for(Bound bound, const Scene& scene);

/// The same for a cloth that diverged.
std::string remedies_for_divergence(const Scene& scene);

}  // namespace bendlab
