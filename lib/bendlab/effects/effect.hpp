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
#include "bendlab/parameters/family.hpp"
#include "bendlab/parameters/field.hpp"

namespace bendlab {

/// What an effect gets from its scene.
struct EffectInput {
  const RestMesh& rest;
  const Pins& pins;
  std::span<const int> permutation;  ///< #V, the index of each vertex in State's arrays; empty: its own

  bool contacts_used = false;         ///< an effect or the method uses them: obstacles fill State::contacts
  std::filesystem::path folder = {};  ///< files are relative to it

  std::size_t permuted(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return permutation.empty() ? v : static_cast<std::size_t>(permutation[v]);
  }
};

/// What an obstacle's surface is made from.
struct SurfaceInput {
  std::filesystem::path folder;       ///< files are relative to it
  const std::string* file = nullptr;  ///< the bytes of the obstacle's file, instead of reading it
  Vector3 centre = Vector3::Zero();   ///< of the cloth's rest box, m
  double size = 1;                    ///< of the cloth's rest box, m
};

/// How an obstacle moves: with a velocity, and a spin about an axis through a point that moves along.
struct SteadyMotion {
  Vector3 velocity = Vector3::Zero();  ///< m/s
  Vector3 pivot = Vector3::Zero();     ///< m, in the world at time 0
  Vector3 axis = Vector3::UnitZ();     ///< unit
  double spin = 0;                     ///< rad/s

  bool rests() const { return velocity.isZero(0) && spin == 0; }
};

/// What a doubt about settings is seen by.
struct DoubtInput {
  const RestMesh& rest;
  double density;     ///< kg/m², mean
  double gravity;     ///< m/s²
  double substep;     ///< s
  int substeps;       ///< of a time step
  std::string where;  ///< "/effects/2 (wind)"
};

/// Settings that will not do what their author means, for a warning.
struct Doubt {
  std::string text;   ///< with a remedy
  double size = 0;    ///< the larger the worse; 0: it has none
  std::string shown;  ///< the size in words
};

struct EffectKind;
/// An effect with its settings: `Effect wind = Wind{.velocity = {0, 3, 0}};`
using Effect = Chosen<EffectKind>;

/// A member of the family: its traits, and what it does. Functions take the effect's settings.
struct EffectKind {
  std::string_view name;
  std::string_view summary;
  std::string_view source;  ///< paper and equation
  FieldTable settings;

  /// Its passes act on projected constraints or between projections: only for solver methods that project.
  bool needs_projection = false;
  bool helps_projection = false;    ///< needs it, and has no other purpose: in other methods it does nothing
  bool acts_in_iterations = false;  ///< implicit methods take it, as part of each iteration, nevertheless
  bool uses_contacts = false;       ///< reads State::contacts, at Stage::contact
  bool repeatable = false;          ///< a scene may list it more than once
  /// Its force depends on velocities: it acts first, on those that the last substep ended with, wherever the
  /// scene lists it. Behind gravity it would see a speed g h of cloth that rests.
  bool acts_first = false;
  bool needs_pins = false;      ///< does nothing where no vertex is pinned
  bool moves_pins = false;      ///< prescribes where pinned vertices are
  bool keeps_momentum = false;  ///< linear, but for what a uniform acceleration adds
  bool keeps_angular_momentum = false;
  bool damps = false;          ///< takes energy, and has no other purpose: at rest it does nothing
  bool bounds_strain = false;  ///< holds the cloth together, and at rest may carry what its membrane carries
  bool force_follows_pose = false;  ///< at rest, too: an equilibrium cannot be found without it
  double vertex_seconds = 3e-9;     ///< of CPU, of a vertex and substep, about

  /// The effect's passes for one scene, for each precision.
  std::vector<Pass<float>> (*compile_float)(const void* settings, const EffectInput&) = nullptr;
  std::vector<Pass<double>> (*compile_double)(const void* settings, const EffectInput&) = nullptr;
  /// Whether the effect provably changes nothing with these settings, for any motion of the cloth; null:
  /// never known.
  bool (*idle)(const void* settings) = nullptr;
  /// Whether it does work on the cloth, besides a uniform acceleration; null: never, or only as an obstacle
  /// that moves.
  bool (*drives)(const void* settings) = nullptr;
  /// The uniform acceleration that it adds, m/s²; null: none.
  Vector3 (*acceleration)(const void* settings) = nullptr;
  /// The largest force on a cloth of that area (m²), N; null: it has none, or a bound is not known.
  double (*largest_force)(const void* settings, double area) = nullptr;
  /// How it moves, of an obstacle: a body that cloth may lie on. Null: it is none.
  SteadyMotion (*motion)(const void* settings) = nullptr;
  /// The obstacle's surface at time 0, normals outward; null: it is none.
  TriangleMesh (*surface)(const void* settings, const SurfaceInput&) = nullptr;
  /// What is doubtful about these settings in this scene; null: nothing ever is.
  std::optional<Doubt> (*doubt)(const void* settings, const DoubtInput&) = nullptr;
  /// Of an added one: tells versions of its code apart, in run ids. Empty: the program's file does.
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

/// The passes of an effect in a scene. Throws std::invalid_argument for settings that do not go together, or
/// not with the scene.
template <class Real>
std::vector<Pass<Real>> passes_of(const Effect& effect, const EffectInput& input) {
  return effect.kind().compile<Real>()(effect.settings(), input);
}

/// Whether an effect does work on the cloth, besides a uniform acceleration.
inline bool does_work(const Effect& effect) {
  const EffectKind& kind = effect.kind();
  return (kind.drives != nullptr && kind.drives(effect.settings())) ||
         (kind.is_obstacle() && !kind.motion(effect.settings()).rests());
}

/// Every registered effect: those of effects.hpp, then those that the program added.
std::span<const EffectKind* const> effects();

/// The effect of that name, or nullptr.
const EffectKind* find_effect(std::string_view name);

/// Adds an effect of the program's own. See Registry::add().
void register_effect(const EffectKind& kind);
void register_effect(const EffectKind&&) = delete;
/// Takes one out that was added. Scenes that have it keep it.
void remove_effect(std::string_view name);

/// The effects that the program added.
std::span<const EffectKind* const> added_effects();

}  // namespace bendlab
