// What goes together in a scene, and what follows from what.
#pragma once

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Fills in what is absent and follows from other settings: rows of a lattice, substeps and iterations.
void settle(Scene& scene);

/// Appends what a config states and cannot mean: settings of a generator beside a mesh file.
void check_stated(const Json& given, const Scene& scene, ConfigProblems& problems);

/// Appends what does not go together in a settled scene. Each setting by itself is right.
void check_scene(const Scene& scene, ConfigProblems& problems);

/// Appends settings out of their range, as a scene from C++ may have them.
void check_ranges(const Scene& scene, ConfigProblems& problems);

/// Appends settings that differ from their defaults although nothing reads them.
void check_unread(const Scene& scene, ConfigProblems& problems);

/// The method's substeps and iterations, those of a settled scene; 1 where it reads no such number.
int substeps_of(const Solver& solver);
int iterations_of(const Solver& solver);

}  // namespace bendlab
