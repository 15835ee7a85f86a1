// The interface of a bending model: a pure function from the rest mesh to constraints, called once per scene.
// A new model is a struct in models.hpp, one file in models/, one test and one config; a program that uses
// this library may register its own.
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

/// A number the model wants reported beside its results (its levels m and n, for example).
struct BendingFact {
  std::string name;
  double value = 0;
  std::string meaning;
  std::string unit = "1";
};

struct BendingConstraints {
  DistanceConstraints distance;
  ElementLists elements;
  OwnElements own;  ///< of a function that the library does not know
  std::vector<BendingFact> facts;
};

struct BendingInput {
  const RestMesh& rest;
  const Pins& pins;
  /// m, diagonal of the rest box. For a forecast `rest` may be a patch of a mesh; this is that of the whole.
  double size = rest.size();
  /// A forecast counts the constraints whose first vertex is a multiple of it; others may be left out.
  int stride = 1;
};

struct BendingKind;
/// A bending model with its settings: `BendingModel model = Adaptive{.rings = RingFill::last};`
using BendingModel = Chosen<BendingKind>;

/// A member of the family: its traits, and what it makes. Functions take the model's settings.
struct BendingKind {
  std::string_view name;
  std::string_view label;       ///< the name in figures
  std::string_view summary;     ///< one line: what is joined to what
  std::string_view source;      ///< paper and equation
  std::string_view limits;      ///< what it cannot do
  std::string_view compliance;  ///< what the scene's compliance is the inverse of
  FieldTable settings;
  bool bends = true;          ///< it makes constraints
  bool springs_only = false;  ///< build() gives no elements, whatever the parameters
  bool one_sided = false;     ///< its elements only push: their force jumps where the cloth is straight
  bool prestressed = false;   ///< its springs push in the rest shape, so that their moment is linear in κ
  /// With k, which removes the same share of every constraint, its softness is left out. A model that does
  /// not say so is refused with k if a softness is not 1.
  bool softness_needs_compliance = false;
  /// The mean strain that its springs give a sound sheet with that k; null: none. And what helped in tests.
  double (*strain_of_k)(const void* settings, double k) = nullptr;
  std::string_view strain_of_k_remedy = {};
  /// It stands for the sheet of a stated rigidity where other models are judged.
  bool is_reference = false;
  BendingConstraints (*build)(const void* settings, const BendingInput&) = nullptr;
  /// Of an added one: tells versions of its code apart, in run ids. Empty: the program's file does.
  std::string_view code = {};
};

/// The model's constraints.
inline BendingConstraints constraints_of(const BendingModel& model, const BendingInput& input) {
  return model.kind().build(model.settings(), input);
}

/// Every registered bending model, in the order of models.hpp; then those that the program added.
std::span<const BendingKind* const> bending_models();

/// The model of that name, or nullptr.
const BendingKind* find_bending_model(std::string_view name);

/// Why a model's constraints cannot have their stiffness as k: they have a softness, which k would leave out,
/// and the model does not say that it may. Nothing if they can.
std::optional<std::string> unknown_to_k(const BendingKind& model, const BendingConstraints& constraints);

/// Whether its elements are hinges: its rigidity is known for rest shapes of any form.
inline bool is_made_of_hinges(const BendingKind& model) {
  return model.bends && !model.springs_only && !model.one_sided;
}

/// What build() makes: "nothing", "springs", "hinges", or "elements" of another kind.
inline std::string_view made_of(const BendingKind& model) {
  if (!model.bends) return "nothing";
  if (model.springs_only) return "springs";
  return is_made_of_hinges(model) ? "hinges" : "elements";
}

/// Names of the registered models that are made of hinges.
std::vector<std::string_view> models_of_hinges();

/// Adds a model of the program's own, which has to stay where it is. See Registry::add(). Throws
/// std::invalid_argument if its name is taken or it has no build().
void register_bending_model(const BendingKind& model);
void register_bending_model(const BendingKind&&) = delete;
/// Takes one out that was added. Scenes that have it keep it.
void remove_bending_model(std::string_view name);

/// The models that the program added.
std::span<const BendingKind* const> added_bending_models();

}  // namespace bendlab
