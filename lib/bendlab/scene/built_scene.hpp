// Builds what a solver needs from a scene: mesh, pins, masses, constraints, effects. Brings together the
// folders of the library, most of which do not include each other.
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

/// The mesh can't be simulated (empty, non-manifold, …). The text lists the first bad elements. Exit code 4.
class MeshError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BuiltScene {
  RestMesh rest;
  std::vector<std::string> mesh_notes{};  ///< warnings: what was done about problems of the mesh
  Pins pins{};
  std::vector<BendingFact> bending_facts;
  std::optional<PushBound> push{};  ///< for springs that push: how large a push the solver can simulate
  int springs_beyond_ring_1 = 0;    ///< distance constraints that are not edges of the mesh
  SimulationInput input;
  std::vector<Effect> effects;
  Precision precision = Precision::single_precision;
  Vector3 down = -Vector3::UnitZ();  ///< direction of gravity; -z where there is none
  std::filesystem::path folder;      ///< folder of the scene
};

/// The rest mesh that a scene describes: generated, read from a file, or given in C++; then scaled. Throws
/// MeshError if /mesh/bad_triangles refuses the mesh, and MeshFileError if the file can't be read.
AcceptedMesh rest_mesh_of(const Mesh& mesh, const std::filesystem::path& folder);

/// Builds a scene after settle() (rules.hpp). Throws like rest_mesh_of(), and ConfigError for wrong settings.
BuiltScene build_scene(const Scene& scene);

/// The name of an effect's passes: the type of the effect, with a number if several effects have that type.
std::string pass_name(const std::vector<Effect>& effects, std::size_t index);

/// Indices in scene.effects of the effects that do nothing, because of their settings or for lack of a pass.
std::vector<std::size_t> idle_effects(const BuiltScene& scene);

/// Whether an effect of the scene moves vertices directly, as tethers and obstacles do.
bool moves_vertices(const BuiltScene& scene);

/// A simulation of the scene, in the precision that the scene sets.
std::unique_ptr<Simulation> simulation_of(const BuiltScene& scene);

}  // namespace bendlab
