// Initial::after: a scene starts where an earlier scene ends. The earlier scene is the same scene with other
// settings, a coarser mesh for example.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// How many steps of Solver::dt a run of Scene::duration takes; a part of a step counts as a whole step.
std::int64_t step_count(const Scene& scene);

/// The earlier scene, at whose end `scene` starts: `scene` with the changes of Initial::after. Nothing if
/// there are no changes. Throws ConfigError with everything that is wrong in the changed settings.
std::optional<Scene> earlier_scene(const Scene& scene);

/// Simulates earlier_scene(), if there is one, until it settles, its duration is over or `stop` is set. Then
/// moves the free vertices of `built` to where the earlier scene ends; they start at rest. Between two meshes
/// of the same flat sheet the pose is interpolated linearly. Throws std::runtime_error if the earlier scene
/// diverges, and ConfigError if the meshes differ and are not meshes of the same flat sheet.
void start_after(const Scene& scene, BuiltScene& built, const std::atomic<bool>* stop = nullptr);

/// Where another run ended, on that run's mesh. Both members are references.
struct StartingPose {
  const RestMesh& rest;
  const Positions& positions;  ///< #V by 3, m
};

/// Moves the free vertices of `scene` to that pose, interpolated as above. Throws ConfigError with `pointer`,
/// the setting that asks for the pose, if the meshes differ and are not meshes of the same flat sheet.
void start_from(BuiltScene& scene, const StartingPose& start, const std::string& pointer);

}  // namespace bendlab
