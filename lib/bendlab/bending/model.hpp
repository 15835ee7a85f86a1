// The interface of a bending model: a pure function from the rest mesh to constraints, called once per scene.
// A new model is one file in models/, one line in models.def, one test and one config; a program that uses
// this library may register its own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/bending/expected.hpp"
#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/parameters/parameter.hpp"

namespace bendlab {

/// A number the model wants reported beside its results (its levels m and n, for example).
struct BendingFact {
  std::string name;
  double value = 0;
  std::string meaning;
};

struct BendingConstraints {
  DistanceConstraints distance;
  ElementLists elements;
  std::vector<BendingFact> facts;
};

struct BendingInput {
  const RestMesh& rest;
  const Pins& pins;
  const ParameterValues& parameters;  ///< the model's own table, defaults filled in
};

struct BendingModel {
  std::string_view name;
  std::string_view label;       ///< the name in figures
  std::string_view summary;     ///< one line: what is joined to what
  std::string_view source;      ///< paper and equation
  std::string_view limits;      ///< what it cannot do
  std::string_view compliance;  ///< what the scene's compliance is the inverse of
  std::span<const Parameter> parameters;
  bool springs_only = false;  ///< build() gives no elements, whatever the parameters
  bool one_sided = false;     ///< its elements only push: their force jumps where the cloth is straight
  bool prestressed = false;   ///< its springs push in the rest shape, so that their moment is linear in κ
  /// With k, which removes the same share of every constraint, its softness is left out. A model that does
  /// not say so is refused with k if a softness is not 1.
  bool softness_needs_compliance = false;
  BendingConstraints (*build)(const BendingInput&);
  /// How many constraints build() will give, for forecasts; null: a hinge over every interior edge.
  ExpectedConstraints (*expect)(const ExpectedMesh&, const ParameterValues&) = nullptr;
};

/// Every registered bending model, in the order of models.def; then those that the program added.
std::span<const BendingModel* const> bending_models();

/// The model of that name, or nullptr.
const BendingModel* find_bending_model(std::string_view name);

/// Why a model's constraints cannot have their stiffness as k: they have a softness, which k would leave out,
/// and the model does not say that it may. Nothing if they can.
std::optional<std::string> unknown_to_k(const BendingModel& model, const BendingConstraints& constraints);

/// Whether its elements are hinges: its rigidity is known for rest shapes of any form.
inline bool is_made_of_hinges(const BendingModel& model) {
  return model.expect == nullptr && !model.springs_only;
}

/// Names of the registered models that are made of hinges.
std::vector<std::string_view> models_of_hinges();

/// Adds a model of the program's own, which has to stay where it is. To be called before a config is read, by
/// one thread. Throws std::invalid_argument if its name is taken or it has no build(), std::logic_error if it
/// is too late.
void register_bending_model(const BendingModel& model);
void register_bending_model(const BendingModel&&) = delete;

/// The models that the program added.
std::span<const BendingModel* const> added_bending_models();

}  // namespace bendlab
