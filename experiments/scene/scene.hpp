// From one point of a sweep to a scene: mesh, pins, masses, constraints, effects. Composes the rooms of the
// library, which do not know each other.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/bending/push_bound.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/quality.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/config/config.hpp"
#include "experiments/scene/precision.hpp"

namespace bendlab {

/// A mesh that can't be simulated (empty, non-finite, non-manifold, …), with the first bad places. Exit
/// code 4.
class MeshError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Scene {
  RestMesh rest;
  std::vector<std::string> mesh_notes{};  ///< what was done about a bad mesh
  Pins pins{};
  std::vector<BendingFact> bending_facts;
  std::optional<PushBound> push{};  ///< for springs that push: how much the solver can hold
  int springs_beyond_ring_1 = 0;    ///< distance constraints that are not edges of the mesh
  SimulationInput input;
  std::vector<EffectSettings> effects;
  Precision precision = Precision::single_precision;
  Vector3 down = -Vector3::UnitZ();  ///< direction of gravity; -z where there is none
  QualityThresholds thresholds;
};

/// The rest mesh that a config describes, generated or read, accepted by its policy for bad triangles,
/// scaled. Throws MeshError (refused) and RunFileError (unreadable).
AcceptedMesh rest_mesh_of(const RunConfig& config);

Scene build_scene(const RunConfig& config);

/// The name of an effect's passes in a run: its type, with a number if that is listed more than once.
std::string pass_name(const std::vector<EffectSettings>& effects, std::size_t index);

/// Indices in scene.effects of those that cannot change anything: idle by their settings, or without a pass
/// in this scene.
std::vector<std::size_t> idle_effects(const Scene& scene);

/// Whether an effect of the scene moves vertices itself, besides the constraints.
bool moves_vertices(const Scene& scene);

/// The scene's simulation, in the scene's precision.
std::unique_ptr<Simulation> simulation_of(const Scene& scene);

}  // namespace bendlab
