// Remedies for a run that broke a bound or diverged, from the run's method (MethodKind::remedies).
#pragma once

#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/run/broken_bound.hpp"

namespace bendlab {

/// Remedies that helped in tests, with numbers. Empty if nothing helped, or if the scene already has all
/// remedies. For a run that diverged: Bound::finite.
std::string remedies_for(Bound bound, const BuiltScene& scene);

}  // namespace bendlab
