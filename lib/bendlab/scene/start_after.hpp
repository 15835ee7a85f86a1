// Initial::after: a scene starts at the end of an earlier scene, which may have a coarser mesh.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// The number of steps in a run: Scene::duration divided by Solver::dt, rounded up.
std::int64_t step_count(const Scene& scene);

/// The earlier scene: `scene` with the changes of Initial::after; nothing if Initial::after is not set.
/// Throws ConfigError with all problems of the changed settings.
std::optional<Scene> earlier_scene(const Scene& scene);

/// Simulates the earlier scene, if there is one, until further steps would change nothing, its duration is
/// over, or `stop` is set. Then moves the free vertices of `built` to that scene's final pose, with velocity
/// 0. Between two meshes of the same flat sheet, the pose is interpolated linearly. Throws std::runtime_error
/// if the earlier scene diverges, and ConfigError if the meshes differ and are not meshes of the same flat
/// sheet.
void start_after(const Scene& scene, BuiltScene& built, const std::atomic<bool>* stop = nullptr);

/// The final pose of another run, and the mesh of that run. Both members are references.
struct StartingPose {
  const RestMesh& rest;
  const Positions& positions;  ///< #V by 3, m
};

/// Moves the free vertices of `scene` to the pose `start`, interpolated as in start_after(). The
/// mesh of `start` must be the mesh of `scene`, or both must be meshes of the same flat sheet. Otherwise
/// throws a ConfigError for the setting with the JSON pointer `pointer`.
void start_from(BuiltScene& scene, const StartingPose& start, const std::string& pointer);

}  // namespace bendlab
