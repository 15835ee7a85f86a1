// Rules of a scene: which settings go together, and which settings follow from others.
#pragma once

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Fills in absent settings that follow from other settings: rows of a lattice, substeps and iterations.
void settle(Scene& scene);

/// Appends a problem for each setting of a generator that a config states beside a mesh file.
void check_stated(const Json& given, const Scene& scene, ConfigProblems& problems);

/// Appends a problem for settings of a settled scene that contradict each other. Each setting by itself is
/// valid.
void check_scene(const Scene& scene, ConfigProblems& problems);

/// Appends a problem for each setting out of its range: a scene that was made in C++ may have such settings.
void check_ranges(const Scene& scene, ConfigProblems& problems);

/// Appends a problem for each unread setting that differs from its default.
void check_unread(const Scene& scene, ConfigProblems& problems);

/// The substeps and iterations of a settled scene's solver; 1 if the method does not read the setting.
int substeps_of(const Solver& solver);
int iterations_of(const Solver& solver);

}  // namespace bendlab
