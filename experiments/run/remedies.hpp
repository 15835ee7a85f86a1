// What helps a run that broke a bound or diverged, according to its method (MethodKind::remedies).
#pragma once

#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/run/broken_bound.hpp"

namespace bendlab {

/// What helped in trials with the likely cause, with numbers; empty if nothing did, or if the scene has all
/// of it already. For a cloth that diverged: Bound::finite.
std::string remedies_for(Bound bound, const BuiltScene& scene);

}  // namespace bendlab
