// The interface of an effect. A scene lists its effects, and the step plan is compiled from that list. An
// effect that is not listed has no pass and no buffer, and takes no time. A new effect is a struct in
// effects.hpp, one file and one test.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bendlab/constraints/state.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/settings/family.hpp"
#include "bendlab/settings/field.hpp"

namespace bendlab {

/// What an effect gets from its scene.
struct EffectInput {
  const RestMesh& rest;
  const Pins& pins;
  std::span<const int> permutation;  ///< #V: each vertex's index in State's arrays; empty: unchanged

  bool contacts_used = false;         ///< an effect or the method reads State::contacts: obstacles fill it
  std::filesystem::path folder = {};  ///< files are relative to this folder

  std::size_t permuted(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return permutation.empty() ? v : static_cast<std::size_t>(permutation[v]);
  }
};

/// Input of EffectKind::surface.
struct SurfaceInput {
  std::filesystem::path folder;       ///< files are relative to this folder
  const std::string* file = nullptr;  ///< bytes of the obstacle's file; null: the file is read
  Vector3 centre = Vector3::Zero();   ///< centre of the cloth's rest box, m
  double size = 1;                    ///< size of the cloth's rest box, m
};

/// How an obstacle moves: with a velocity, and a spin about an axis. The axis goes through the pivot, which
/// moves with the obstacle.
struct SteadyMotion {
  Vector3 velocity = Vector3::Zero();  ///< m/s
  Vector3 pivot = Vector3::Zero();     ///< m, in the world at time 0
  Vector3 axis = Vector3::UnitZ();     ///< unit
  double spin = 0;                     ///< rad/s

  bool rests() const { return velocity.isZero(0) && spin == 0; }
};

/// What EffectKind::doubt needs to judge an effect's settings.
struct DoubtInput {
  const RestMesh& rest;
  const Pins& pins;
  double density;     ///< kg/m², mean
  double gravity;     ///< m/s²
  double substep;     ///< s; 0: the method has no time
  int substeps;       ///< per time step
  std::string where;  ///< "/effects/2 (wind)"
};

/// A warning about settings whose result may not be what the user wants.
struct Doubt {
  std::string text;   ///< the warning, with a remedy
  double size = 0;    ///< larger is worse; 0: the problem has no size
  std::string shown;  ///< the size in words
};

struct EffectKind;
/// An effect with its settings: `Effect wind = Wind{.velocity = {0, 3, 0}};`
using Effect = Chosen<EffectKind>;

/// A kind of effect: its traits and its functions. The functions take the effect's settings.
struct EffectKind {
  std::string_view name;
  std::string_view summary;
  std::string_view source;  ///< paper and equation
  FieldTable settings;

  /// Passes act on or between projections, so only methods that project can use the effect.
  bool needs_projection = false;
  bool helps_projection = false;    ///< only helps projections: does nothing in methods that do not project
  bool acts_in_iterations = false;  ///< implicit methods can use the effect, too, in each iteration
  bool uses_contacts = false;       ///< reads State::contacts, at Stage::contact
  bool repeatable = false;          ///< a scene may list it more than once
  /// The effect's force depends on velocities. So the effect acts before all other effects, on the velocities
  /// at the end of the last substep; its place in the scene's list does not matter. After gravity, cloth at
  /// rest has the speed g h.
  bool acts_first = false;
  bool needs_pins = false;      ///< does nothing if no vertex is pinned
  bool moves_pins = false;      ///< prescribes where pinned vertices are
  bool keeps_momentum = false;  ///< linear momentum, except for what a uniform acceleration adds
  bool keeps_angular_momentum = false;
  bool damps = false;               ///< only removes energy from the cloth; does nothing at rest
  bool bounds_strain = false;       ///< limits stretch; at rest it may carry loads in place of the membrane
  bool uses_sides = false;          ///< its force depends on which side of each triangle is the front
  bool force_follows_pose = false;  ///< also at rest: an equilibrium depends on the force

  /// The effect's passes for one scene, for each precision.
  std::vector<Pass<float>> (*compile_float)(const void* settings, const EffectInput&) = nullptr;
  std::vector<Pass<double>> (*compile_double)(const void* settings, const EffectInput&) = nullptr;
  /// Whether the effect provably changes nothing with these settings, for any motion; null: not known.
  bool (*idle)(const void* settings) = nullptr;
  /// Whether the effect does work on the cloth, apart from a uniform acceleration; null: the effect does no
  /// work, or is an obstacle that works only by moving.
  bool (*drives)(const void* settings) = nullptr;
  /// The uniform acceleration that the effect adds, m/s²; null: no such acceleration.
  Vector3 (*acceleration)(const void* settings) = nullptr;
  /// The largest force on a cloth of the given area (m²), N; null: no force, or no known bound.
  double (*largest_force)(const void* settings, double area) = nullptr;
  /// The motion of an obstacle (a body that cloth may lie on); null: the effect is not an obstacle.
  SteadyMotion (*motion)(const void* settings) = nullptr;
  /// The obstacle's surface at time 0, normals outward; null: the effect is not an obstacle.
  TriangleMesh (*surface)(const void* settings, const SurfaceInput&) = nullptr;
  /// A warning if these settings are doubtful in this scene; null: the effect has no warnings.
  std::optional<Doubt> (*doubt)(const void* settings, const DoubtInput&) = nullptr;
  /// For an effect that the program added: a text that distinguishes versions of the effect's code in run
  /// ids. Empty: the program's file distinguishes the versions.
  std::string_view code = {};

  bool is_obstacle() const { return motion != nullptr; }

  template <class Real>
  auto compile() const {
    if constexpr (std::is_same_v<Real, float>)
      return compile_float;
    else
      return compile_double;
  }
};

/// The passes of an effect in a scene. Throws std::invalid_argument if settings contradict others or the
/// scene.
template <class Real>
std::vector<Pass<Real>> passes_of(const Effect& effect, const EffectInput& input) {
  return effect.kind().compile<Real>()(effect.settings(), input);
}

/// Whether an effect does work on the cloth, apart from a uniform acceleration.
inline bool does_work(const Effect& effect) {
  const EffectKind& kind = effect.kind();
  return (kind.drives != nullptr && kind.drives(effect.settings())) ||
         (kind.is_obstacle() && !kind.motion(effect.settings()).rests());
}

/// All registered effects: first the effects of effects.hpp, then the effects that the program added.
std::span<const EffectKind* const> effects();

/// The effect with this name, or nullptr.
const EffectKind* find_effect(std::string_view name);

/// Adds an effect that the program defines. See Registry::add().
void register_effect(const EffectKind& kind);
void register_effect(const EffectKind&&) = delete;
/// Removes an effect that the program added. Existing scenes can still use the effect.
void remove_effect(std::string_view name);

/// Only the effects that the program added.
std::span<const EffectKind* const> added_effects();

}  // namespace bendlab
