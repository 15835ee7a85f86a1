#include "bendlab/scene/defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>

#include "bendlab/scene/pointers.hpp"

namespace bendlab {
namespace {

// Settings that go together: a choice of /defaults. They change Scene{}.
struct Recipe {
  std::string_view name;
  void (*change)(Scene&);
  /// Its method and settings go together; else a config that names a method replaces them.
  bool solves = true;
};

// quasi_newton and its own settings. What they were measured on is in configs/recommended.json.
void recommended(Scene&) {}

// The same cloth by projections. Coarse levels hold it together, whatever effects are listed.
void projected(Scene& scene) {
  scene.solver.method = Pbd{.levels = 12};
}

// For a config that names no method, but states what only projections take: k, an effect that acts on
// projections, a setting of pbd.
void projected_k(Scene& scene) {
  projected(scene);
  scene.material.strain.stiffness = Stiffness::k;
}

// Sheets of 1 m on 64 cells that hang by one corner, two, and a side: 0.95 ms of CPU per frame, where the
// paper's adaptive springs take 1.10; no triangle is ever stretched by more than 0.05, and they end within 2
// % of where they should. None of the 238 runs of tests/foreign/scenes.py tears.
void fast(Scene& scene) {
  scene.solver.iterations = 2;
}

// Steps that are solved to their minimum, of second order in time.
void reference(Scene& scene) {
  scene.solver.method = Newton{};
  scene.solver.substeps = 4;
}

// The paper gives no numbers but those of its springs; ours for the rest are in configs/paper.
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

// The kind that a setting names; null if it names none.
template <class Kind>
const Kind* kind_at(const Json& settings, const std::string& pointer, const Kind* (*find)(std::string_view)) {
  const Json* const name = value_at(settings, pointer);
  return name != nullptr && name->is_string() ? find(name->get<std::string>()) : nullptr;
}

bool given(const Json& settings, std::string_view section, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(
      names, [&](std::string_view name) { return is_given(settings, fmt::format("{}/{}", section, name)); });
}

// Whoever gives a membrane's number means that. Nothing if the config says how it is stiff, or nothing of it.
std::optional<Stiffness> meant_membrane(const Json& settings) {
  if (value_at(settings, "/material/strain/stiffness") != nullptr) return std::nullopt;
  if (is_given(settings, "/material/strain/membrane_stiffness")) return Stiffness::physical;
  if (is_given(settings, "/material/strain/compliance")) return Stiffness::compliance;
  if (given(settings, "/material/strain", {"warp", "weft", "shear", "area"})) return Stiffness::k;
  return std::nullopt;
}

// Whether a config that names no method states what only a method that projects constraints takes.
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
  const auto found = std::ranges::find_if(recipes, [&](const Recipe& recipe) {
    return chosen != nullptr && *chosen == std::string(recipe.name);
  });
  if (found != recipes.end() && found != recipes.begin()) return *found;
  if (value_at(settings, "/solver/method") == nullptr)
    return asks_for_projection(settings) ? by_projections_with_k : recipes.front();
  return kind_at(settings, "/solver/method", find_method) == &Pbd::kind ? by_projections : recipes.front();
}

// Whoever gives k means k, and whoever gives a compliance means that.
void choose_bending(const Json& settings, Bending& bending, ConfigProblems& problems) {
  const Json* const section = value_at(settings, "/bending");
  if (section == nullptr || !section->is_object() || section->contains("stiffness")) return;
  const bool k = is_given(settings, "/bending/k"), compliance = is_given(settings, "/bending/compliance"),
             physical = given(settings, "/bending", {"flexural_rigidity", "quartic_coefficient"});
  if (k + compliance + physical > 1)
    problems.push_back({"/bending/stiffness",
                        fmt::format("is missing, and {} are given: say which of them counts, as \"k\", "
                                    "\"k_per_step\", \"compliance\" or \"physical\"",
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

// A rigidity is stated in one way, and the control has none.
void choose_rigidity(const Json& settings, Bending& bending) {
  const BendingKind* const model = kind_at(settings, "/bending/model", find_bending_model);
  const bool bends = model != nullptr ? model->bends : bending.model.kind().bends;
  if (bends && !is_given(settings, "/bending/quartic_coefficient")) return;
  bending.flexural_rigidity.reset(), bending.at_curvature.reset();
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
  choose_bending(settings, scene.bending, problems);
  choose_rigidity(settings, scene.bending);
  // A build may lack an effect.
  std::erase_if(scene.effects, [](const Effect& effect) { return find_effect(effect.name()) == nullptr; });
  return scene;
}

}  // namespace bendlab
