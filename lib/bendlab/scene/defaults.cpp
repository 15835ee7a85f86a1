#include "bendlab/scene/defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>

#include "bendlab/scene/fabrics.hpp"
#include "bendlab/scene/pointers.hpp"

namespace bendlab {
namespace {

// A value of /defaults: a function that changes several settings of Scene{}.
struct Recipe {
  std::string_view name;
  void (*change)(Scene&);
  /// Whether solver settings of the recipe apply to a config that sets /solver/method to the method of the
  /// recipe. If false, such a config gets the defaults of the method.
  bool solves = true;
};

// quasi_newton with its default settings, which were chosen with the scenes in configs/recommended.json.
void recommended(Scene&) {}

// The recommended cloth, simulated by projections. Coarse levels keep the cloth from stretching.
void projected(Scene& scene) {
  scene.solver.method = Pbd{.levels = 12};
}

// For a config without /solver/method, but with k, an effect on projections, or a setting of pbd.
void projected_k(Scene& scene) {
  projected(scene);
  scene.material.strain.stiffness = Stiffness::k;
}

// Chosen by simulating sheets of 1 m with 64 cells that hang by one corner, by two corners, and by a side. A
// frame takes 0.95 ms of CPU time; with the paper's adaptive springs it takes 1.10 ms. No triangle is ever
// stretched by more than 0.05, and the final positions are wrong by at most 2 %. The cloth does not tear in
// any of the 238 runs of tests/foreign/scenes.py.
void fast(Scene& scene) {
  scene.solver.iterations = 2;
}

// Every step is solved until it has converged, and the steps are of second order in time.
void reference(Scene& scene) {
  scene.solver.method = Newton{};
  scene.solver.substeps = 4;
}

// The paper states numbers only for the springs. Our choice of all other numbers is in configs/paper.
void paper(Scene& scene) {
  scene.pins.ring = 1;
  scene.material.strain.form = StrainForm::normalised;
  scene.material.strain.stiffness = Stiffness::k;
  scene.bending.model = Adaptive{};
  scene.bending.stiffness = Stiffness::k;
  scene.solver.method = Pbd{};
  scene.solver.substeps = 1, scene.solver.iterations = 10;
  scene.effects = {Gravity{}};
}

constexpr Recipe by_projections{"projected", projected}, by_projections_with_k{"projected k", projected_k};
constexpr std::array recipes = {Recipe{"recommended", recommended}, Recipe{"fast", fast},
                                Recipe{"reference", reference}, Recipe{"paper", paper, false}};

bool is_given(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

bool is_k(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && (*value == "k" || *value == "k_per_step");
}

// The kind whose name is the value of the setting; null if the name is not known.
template <class Kind>
const Kind* kind_at(const Json& settings, const std::string& pointer, const Kind* (*find)(std::string_view)) {
  const Json* const name = value_at(settings, pointer);
  return name != nullptr && name->is_string() ? find(name->get<std::string>()) : nullptr;
}

bool given(const Json& settings, std::string_view section, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(
      names, [&](std::string_view name) { return is_given(settings, fmt::format("{}/{}", section, name)); });
}

// The kind of membrane stiffness that a config without /material/strain/stiffness means, from the numbers
// that the config states. Empty if the config states /material/strain/stiffness, or none of the numbers.
std::optional<Stiffness> meant_membrane(const Json& settings) {
  if (value_at(settings, "/material/strain/stiffness") != nullptr) return std::nullopt;
  if (given(settings, "/material/strain", {"membrane_stiffness", "membrane"})) return Stiffness::physical;
  if (is_given(settings, "/material/strain/compliance")) return Stiffness::compliance;
  if (given(settings, "/material/strain", {"warp", "weft", "shear", "area"})) return Stiffness::k;
  return std::nullopt;
}

// Whether a config without /solver/method contains something that only projecting methods use.
bool asks_for_projection(const Json& settings) {
  if (is_k(settings, "/material/strain/stiffness") || meant_membrane(settings) == Stiffness::k ||
      is_k(settings, "/bending/stiffness") ||
      (is_given(settings, "/bending/k") && !is_given(settings, "/bending/stiffness")))
    return true;
  const BendingKind* const model = kind_at(settings, "/bending/model", find_bending_model);
  if (model != nullptr && model->one_sided) return true;
  const MethodKind &implicit = Solver{}.method.kind(), &projecting = Pbd::kind;
  if (const Json* const solver = value_at(settings, "/solver"); solver != nullptr && solver->is_object())
    for (const auto& [key, value] : solver->items())
      if (!value.is_null() && projecting.settings.find(key) && !implicit.settings.find(key)) return true;
  const Json* const effects = value_at(settings, "/effects");
  if (effects == nullptr || !effects->is_array()) return false;
  return std::ranges::any_of(*effects, [&](const Json& listed) {
    const EffectKind* const effect = kind_at(listed, "/type", find_effect);
    return effect != nullptr && !effect->helps_projection &&
           !implicit.takes_effect(effect->needs_projection, effect->acts_in_iterations);
  });
}

const Recipe& recipe_of(const Json& settings) {
  const Json* const chosen = value_at(settings, "/defaults");
  const auto named = std::ranges::find_if(recipes, [&](const Recipe& recipe) {
    return chosen != nullptr && *chosen == std::string(recipe.name);
  });
  if (named != recipes.end() && named != recipes.begin()) return *named;
  if (value_at(settings, "/solver/method") == nullptr)
    return asks_for_projection(settings) ? by_projections_with_k : recipes.front();
  return kind_at(settings, "/solver/method", find_method) == &Pbd::kind ? by_projections : recipes.front();
}

// Without /bending/stiffness, the stiffness is "k" if k is given, and "compliance" if compliance is given.
void choose_bending(const Json& settings, Bending& bending, ConfigProblems& problems) {
  const Json* const section = value_at(settings, "/bending");
  if (section == nullptr || !section->is_object() || section->contains("stiffness")) return;
  const bool k = is_given(settings, "/bending/k"), compliance = is_given(settings, "/bending/compliance"),
             physical = given(settings, "/bending",
                              {"flexural_rigidity", "quartic_coefficient", "rigidity", "softening",
                               "hysteresis", "plasticity"});
  if (k + compliance + physical > 1)
    problems.push_back(
        {"/bending/stiffness", fmt::format("is missing, but {} are given: set it to \"k\", \"k_per_step\", "
                                           "\"compliance\" or \"physical\" to choose which number is used",
                                           !physical ? "k and compliance"
                                           : k       ? "k and a rigidity"
                                                     : "compliance and a rigidity")});
  if (k)
    bending.stiffness = Stiffness::k;
  else if (compliance)
    bending.stiffness = Stiffness::compliance;
  else if (physical)
    bending.stiffness = Stiffness::physical;
}

// Removes the default rigidity if the config states quartic_coefficient, or if the model does not bend.
void choose_rigidity(const Json& settings, Bending& bending) {
  const BendingKind* const model = kind_at(settings, "/bending/model", find_bending_model);
  const bool bends = model != nullptr ? model->bends : bending.model.kind().bends;
  if (bends && !is_given(settings, "/bending/quartic_coefficient")) return;
  bending.flexural_rigidity.reset(), bending.at_curvature.reset();
}

// Applies the numbers of a fabric, except for those that the config states in another way.
void choose_fabric(const Json& settings, Scene& scene) {
  const Json* const name = value_at(settings, "/material/fabric");
  const Fabric* const fabric =
      name != nullptr && name->is_string() ? find_fabric(name->get<std::string>()) : nullptr;
  if (fabric == nullptr) return;
  if (const BendingKind* const model = kind_at(settings, "/bending/model", find_bending_model))
    scene.bending.model = BendingModel(*model);
  apply_fabric(*fabric, scene);
  const bool has_curve = given(settings, "/bending/softening", {"curvatures", "moments"});
  if (has_curve || given(settings, "/bending", {"flexural_rigidity", "quartic_coefficient"}) ||
      is_given(settings, "/material/youngs_modulus"))
    scene.bending.rigidity = {};
  // A sheet has a curve, half_at or plastic folds.
  if (has_curve || is_given(settings, "/bending/plasticity/yield_at")) scene.bending.softening = {};
  // Only the angle itself can yield.
  if (const Json* const measure = value_at(settings, "/bending/discrete_shells/measure");
      scene.bending.model.name() == "discrete_shells" && measure != nullptr && *measure != "theta")
    scene.bending.hysteresis = {};
}

}  // namespace

Scene scene_before(const Json& settings, ConfigProblems& problems) {
  Scene scene;
  if (!settings.is_object()) return scene;
  const Recipe& recipe = recipe_of(settings);
  recipe.change(scene);
  const MethodKind* const method = kind_at(settings, "/solver/method", find_method);
  if (method != nullptr && (!recipe.solves || method != &scene.solver.method.kind()))
    scene.solver = {.method = Method(*method)};
  if (const auto meant = meant_membrane(settings)) scene.material.strain.stiffness = *meant;
  choose_fabric(settings, scene);
  choose_bending(settings, scene.bending, problems);
  choose_rigidity(settings, scene.bending);
  // A program may be built without a default effect.
  std::erase_if(scene.effects, [](const Effect& effect) { return find_effect(effect.name()) == nullptr; });
  return scene;
}

}  // namespace bendlab
