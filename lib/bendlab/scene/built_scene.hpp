// Builds what a solver needs from a scene: mesh, pins, masses, constraints, effects. This joins the folders
// of the library, which do not know each other.
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
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/scene/precision.hpp"
#include "bendlab/scene/scene.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// A mesh that can't be simulated (empty, non-finite, non-manifold, …), with the first bad places. Exit
/// code 4.
class MeshError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BuiltScene {
  RestMesh rest;
  std::vector<std::string> mesh_notes{};  ///< what was done about a bad mesh
  Pins pins{};
  std::vector<BendingFact> bending_facts;
  std::optional<PushBound> push{};  ///< for springs that push: how large a push the solver can hold
  int springs_beyond_ring_1 = 0;    ///< distance constraints that are not edges of the mesh
  SimulationInput input;
  std::vector<Effect> effects;
  Precision precision = Precision::single_precision;
  Vector3 down = -Vector3::UnitZ();  ///< direction of gravity; -z where there is none
  std::filesystem::path folder;      ///< folder of the scene
};

/// The rest mesh that a scene describes: generated, read from a file or given, accepted by the policy for bad
/// triangles, and scaled. Throws MeshError (refused) and MeshFileError (unreadable).
AcceptedMesh rest_mesh_of(const Mesh& mesh, const std::filesystem::path& folder);

/// Builds a settled scene (rules.hpp). Throws MeshError, MeshFileError, and ConfigError for settings that
/// contradict each other.
BuiltScene build_scene(const Scene& scene);

/// The name of an effect's passes in a run: its type, with a number if the type is listed more than once.
std::string pass_name(const std::vector<Effect>& effects, std::size_t index);

/// Indices in scene.effects of the effects that cannot change anything: idle by their settings, or without a
/// pass in this scene.
std::vector<std::size_t> idle_effects(const BuiltScene& scene);

/// Whether an effect of the scene moves vertices itself, besides the constraints.
bool moves_vertices(const BuiltScene& scene);

/// The scene's simulation, in the scene's precision.
std::unique_ptr<Simulation> simulation_of(const BuiltScene& scene);

}  // namespace bendlab
