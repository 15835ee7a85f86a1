// The interface of a bending model: a pure function from the rest mesh to constraints, called once per scene.
// A new model needs a struct in models.hpp, one file in models/, one test and one config. A program that uses
// this library may register further models.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/bending/directed_rigidity.hpp"
#include "bendlab/constraints/directors.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/own_elements.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/settings/family.hpp"
#include "bendlab/settings/field.hpp"

namespace bendlab {

/// A fact that a model reports in the summary of a run (for example, its LOD levels m and n).
struct BendingFact {
  std::string name;
  double value = 0;
  std::string meaning;
  std::string unit = "1";
};

struct BendingConstraints {
  DistanceConstraints distance;
  ElementLists elements;
  OwnElements own;      ///< evaluated by a function that the model provides
  Directors directors;  ///< unknowns besides the vertices; the elements name director d as point #V + d
  std::vector<BendingFact> facts;
};

struct BendingInput {
  const RestMesh& rest;
  const Pins& pins;
  double poisson_ratio = 0;  ///< of the sheet, for models with takes_poisson_ratio
  bool is_flat = false;      ///< whether the sheet is unbent when it is flat, whatever the rest shape
  /// For models with takes_directions: how the sheet's rigidity depends on the direction; null: it does not.
  const DirectedSheet* directed = nullptr;
};

struct BendingKind;
/// A bending model with its settings: `BendingModel model = Adaptive{.rings = RingFill::last};`
using BendingModel = Chosen<BendingKind>;

/// A kind of bending model: texts, properties, and functions, which take the model's settings.
struct BendingKind {
  std::string_view name;
  std::string_view label;       ///< the name in figures
  std::string_view summary;     ///< one line: what the constraints join
  std::string_view source;      ///< paper and equation
  std::string_view limits;      ///< what the model cannot do
  std::string_view compliance;  ///< the stiffness whose inverse is the scene's compliance
  FieldTable settings;
  bool bends = true;          ///< build() makes constraints
  bool springs_only = false;  ///< build() makes no elements, whatever the settings
  bool one_sided = false;     ///< its elements only push, so their force jumps where the cloth is straight
  bool prestressed = false;   ///< its springs push in the rest shape, so that their moment is linear in κ
  bool uses_sides = false;    ///< needs neighbouring triangles that face the same side
  bool needs_energy = false;  ///< its elements have an energy, but no constraint that could be projected
  /// Whether the model may be used with k although k ignores softness (k corrects every constraint by the
  /// same share). If false, the model cannot be used with k if any softness differs from 1.
  bool softness_needs_compliance = false;
  /// Mean strain that the model's springs cause with this k in a sheet that is otherwise unstretched; null:
  /// no strain. `strain_of_k_remedy` is a sentence about the remedy that helped in tests.
  double (*strain_of_k)(const void* settings, double k) = nullptr;
  std::string_view strain_of_k_remedy = {};
  /// Whether a formula gives the softness of each element for a rigidity D, so that calibrate() fits nothing.
  /// The sheet then has D at large deflections as nearly as the formula and the mesh allow.
  bool rigidity_by_formula = false;
  bool takes_poisson_ratio = false;  ///< build() reads BendingInput::poisson_ratio
  /// Whether a formula gives a rigidity that depends on the direction: build() reads BendingInput::directed.
  /// calibrate() gives such a rigidity to models without a formula.
  bool takes_directions = false;
  /// Whether set_moments() (moment_laws.hpp) can give the elements a moment that softens, and friction and
  /// folds that stay. Elements that yield need a fold with a sign.
  bool softens = false, yields = false;
  /// Whether this model, calibrated to a stated rigidity, is the reference for all other models.
  bool is_reference = false;
  BendingConstraints (*build)(const void* settings, const BendingInput&) = nullptr;
  double points_per_vertex = 1;  ///< vertices and directors, from which the memory of a run is estimated
  /// About how many springs build() makes per vertex, on a mesh with this diagonal and mean edge length (m).
  /// Also for the estimate of memory; null: at most a few.
  double (*springs_per_vertex)(const void* settings, double size, double mean_edge) = nullptr;
  /// For a model that a program adds: identifies the version of the model's code in run ids. If empty, the
  /// hash of the program's file is used instead.
  std::string_view code = {};
};

inline BendingConstraints constraints_of(const BendingModel& model, const BendingInput& input) {
  return model.kind().build(model.settings(), input);
}

/// All registered bending models: first the models of models.hpp in their order, then the models that the
/// program added.
std::span<const BendingKind* const> bending_models();

/// The model with the name `name`, or nullptr.
const BendingKind* find_bending_model(std::string_view name);

/// An error text if the model cannot be used with k, because k would ignore a softness and the model does not
/// set softness_needs_compliance. Nothing if the model can be used with k.
std::optional<std::string> unknown_to_k(const BendingKind& model, const BendingConstraints& constraints);

/// Whether the model's elements are hinges. The rigidity of hinges is known for rest shapes of any form.
inline bool is_made_of_hinges(const BendingKind& model) {
  return model.bends && !model.springs_only && !model.one_sided;
}

/// The kind of constraints that build() makes: "nothing", "springs", "hinges", or other "elements".
inline std::string_view made_of(const BendingKind& model) {
  if (!model.bends) return "nothing";
  if (model.springs_only) return "springs";
  return is_made_of_hinges(model) ? "hinges" : "elements";
}

/// Names of the registered models that are made of hinges.
std::vector<std::string_view> models_of_hinges();

/// Adds a model of the program. The address of the model must stay valid (see Registry::add()). Throws
/// std::invalid_argument if the model's name is already in use, or if the model has no build().
void register_bending_model(const BendingKind& model);
void register_bending_model(const BendingKind&&) = delete;
/// Removes a model that the program added. Scenes that already use the model can still use it.
void remove_bending_model(std::string_view name);

/// The models that the program added.
std::span<const BendingKind* const> added_bending_models();

}  // namespace bendlab
