// What helps a run that broke a bound or diverged, according to the trials in remedies.cpp.
#pragma once

#include <string>

#include "experiments/run/broken_bound.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {

/// What helped in trials with the likely cause, with numbers; empty if nothing did, or if the scene has all
/// of it already.
std::string remedies_for(Bound bound, const Scene& scene);

/// The same for a cloth that diverged.
std::string remedies_for_divergence(const Scene& scene);

}  // namespace bendlab
