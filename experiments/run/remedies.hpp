// Changes of settings that helped in tests, for a warning or for a run that failed. A new remedy is a row of
// the table in remedies.cpp.
#pragma once

#include <string>
#include <string_view>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/run/broken_bound.hpp"

namespace bendlab {

/// The remedies for the warning `code` that the scene does not have yet. Empty if none is known.
std::string remedies_for(std::string_view code, const BuiltScene& scene);

/// The remedies for a run that broke a bound. For a run that diverged: Bound::finite.
std::string remedies_for(Bound bound, const BuiltScene& scene);

}  // namespace bendlab
