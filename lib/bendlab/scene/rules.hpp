// Rules of a scene: which settings may be combined, and which settings follow from other settings.
#pragma once

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Settles a scene: sets missing values of /mesh/rows, /solver/substeps and /solver/iterations.
void settle(Scene& scene);

/// Appends a problem for each generator setting in the config `given`, if the config also has a mesh file.
void check_stated(const Json& given, const Scene& scene, ConfigProblems& problems);

/// Appends a problem for valid settings of a settled scene that contradict each other.
void check_scene(const Scene& scene, ConfigProblems& problems);

/// Appends a problem for each setting out of range. Only a scene that was made in C++ may have such settings.
void check_ranges(const Scene& scene, ConfigProblems& problems);

/// Appends a problem for each unread setting that differs from its default.
void check_unread(const Scene& scene, ConfigProblems& problems);

/// The substeps and iterations of a settled scene's solver; 1 if the method does not read the setting.
int substeps_of(const Solver& solver);
int iterations_of(const Solver& solver);

}  // namespace bendlab
