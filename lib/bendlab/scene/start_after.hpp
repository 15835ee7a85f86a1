// Initial::after: a scene starts where another one ends, which is the same with other settings, a coarser
// mesh for example.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// How many steps of Solver::dt a run of Scene::duration takes; a part of a step counts as one.
std::int64_t step_count(const Scene& scene);

/// The scene at whose end this one starts: itself with the changes of Initial::after; nothing where there are
/// none. Throws ConfigError with what is wrong in the changed settings.
std::optional<Scene> earlier_scene(const Scene& scene);

/// Simulates earlier_scene(), if there is one, until it settles, its duration is over or `stop` is set, and
/// moves the free vertices of `built` to where it ends; they start at rest. Between two meshes of the same
/// flat sheet the pose is interpolated linearly. Throws std::runtime_error if that run diverges, and
/// ConfigError if the meshes differ and are not meshes of the same flat sheet.
void start_after(const Scene& scene, BuiltScene& built, const std::atomic<bool>* stop = nullptr);

/// Where another run ended, on its own mesh; both are kept by reference.
struct StartingPose {
  const RestMesh& rest;
  const Positions& positions;  ///< #V by 3, m
};

/// Moves the free vertices of `scene` there, interpolated as above. Throws ConfigError with `pointer`, the
/// setting that asks for it, if the meshes don't go together.
void start_from(BuiltScene& scene, const StartingPose& start, const std::string& pointer);

}  // namespace bendlab
