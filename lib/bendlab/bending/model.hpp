// The interface of a bending model: a pure function from the rest mesh to constraints, called once per scene.
// A new model is a struct in models.hpp, one file in models/, one test and one config. A program that uses
// this library may register models of its own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/own_elements.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/parameters/family.hpp"
#include "bendlab/parameters/field.hpp"

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
  OwnElements own;  ///< evaluated by a function that the model provides
  std::vector<BendingFact> facts;
};

struct BendingInput {
  const RestMesh& rest;
  const Pins& pins;
  /// Diagonal of the rest box of the whole mesh, m. For a forecast, `rest` may be only a patch of that mesh.
  double size = rest.size();
  /// A forecast counts only the constraints whose first vertex is a multiple of `stride`; build() may leave
  /// out the rest.
  int stride = 1;
};

struct BendingKind;
/// A bending model with its settings: `BendingModel model = Adaptive{.rings = RingFill::last};`
using BendingModel = Chosen<BendingKind>;

/// A kind of bending model: its texts, its traits and its functions, which take the model's settings.
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
  /// Whether the model may be used with k although k ignores softness (k removes the same share of every
  /// constraint). If false, the model is refused with k as soon as a softness is not 1.
  bool softness_needs_compliance = false;
  /// Mean strain of a sound sheet that the model's springs cause with this k; null: no strain. Then a
  /// sentence about the remedy that helped in tests.
  double (*strain_of_k)(const void* settings, double k) = nullptr;
  std::string_view strain_of_k_remedy = {};
  /// Whether this model, calibrated to a stated rigidity, is the reference that other models are judged by.
  bool is_reference = false;
  BendingConstraints (*build)(const void* settings, const BendingInput&) = nullptr;
  /// For a model that a program adds: identifies the version of the model's code in run ids. Empty: the
  /// program's file identifies it.
  std::string_view code = {};
};

/// The constraints of `model` on the mesh of `input`.
inline BendingConstraints constraints_of(const BendingModel& model, const BendingInput& input) {
  return model.kind().build(model.settings(), input);
}

/// All registered bending models: first the models of models.hpp in their order, then the models that the
/// program added.
std::span<const BendingKind* const> bending_models();

/// The model of that name, or nullptr.
const BendingKind* find_bending_model(std::string_view name);

/// An error text if the model cannot be used with k, because k would ignore a softness and the model does not
/// set softness_needs_compliance. Nothing if the model can be used with k.
std::optional<std::string> unknown_to_k(const BendingKind& model, const BendingConstraints& constraints);

/// Whether the model's elements are hinges. Then its rigidity is known for rest shapes of any form.
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

/// Adds a model of the program. The model is kept by reference, so it must stay where it is (see
/// Registry::add()). Throws std::invalid_argument if the model's name is taken or it has no build().
void register_bending_model(const BendingKind& model);
void register_bending_model(const BendingKind&&) = delete;
/// Removes a model that the program added. Scenes that use the model keep it.
void remove_bending_model(std::string_view name);

/// The models that the program added.
std::span<const BendingKind* const> added_bending_models();

}  // namespace bendlab
