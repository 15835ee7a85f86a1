#include "experiments/config/defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/lattice_rows.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/resolve.hpp"

namespace bendlab {
namespace {

struct RecipeSetting {
  const char *section, *name, *value;
};

// Settings that go together: a choice of /defaults.
struct Recipe {
  std::string_view name;
  std::string_view method;  ///< its settings of /solver are for this method alone; empty: for any
  bool drags;               ///< beside gravity, if a config lists no effects
  std::span<const RecipeSetting> settings;
};

// The paper gives no numbers but those of its springs; ours for the rest are in configs/paper.
constexpr std::array paper_settings = {
    RecipeSetting{"/pins", "ring", "1"},
    RecipeSetting{"/material/strain", "form", R"("normalised")"},
    RecipeSetting{"/material/strain", "stiffness", R"("k")"},
    RecipeSetting{"/bending", "model", R"("adaptive")"},
    RecipeSetting{"/solver", "method", R"("pbd")"},
    RecipeSetting{"/solver", "substeps", "1"},
    RecipeSetting{"/solver", "iterations", "10"},
};

// The default: quasi_newton and its own settings. What they were measured on is in configs/recommended.json.
constexpr std::array recommended_settings = {
    RecipeSetting{"/solver", "method", R"("quasi_newton")"},
};

// The same cloth by projections. Coarse levels hold it together, whatever effects are listed.
constexpr std::array projected_settings = {
    RecipeSetting{"/solver", "levels", "12"},
};

// For a config that names no method, but states what only projections take: k, an effect that acts on
// projections, a setting of pbd.
constexpr std::array projected_k_settings = {
    RecipeSetting{"/material/strain", "stiffness", R"("k")"},
    RecipeSetting{"/solver", "method", R"("pbd")"},
    RecipeSetting{"/solver", "levels", "12"},
};

// Sheets of 1 m on 64 cells that hang by one corner, two, and a side: 0.95 ms of CPU per frame, where the
// paper's adaptive springs take 1.10; no triangle is ever stretched by more than 0.05, and they end within 2
// % of where they should. None of the 238 runs of tests/foreign/scenes.py tears.
constexpr std::array fast_settings = {
    RecipeSetting{"/solver", "method", R"("quasi_newton")"},
    RecipeSetting{"/solver", "iterations", "2"},
};

// Steps that are solved to their minimum, of second order in time.
constexpr std::array reference_settings = {
    RecipeSetting{"/solver", "method", R"("newton")"},
    RecipeSetting{"/solver", "substeps", "4"},
};

constexpr Recipe projected{"projected", "pbd", true, projected_settings};
constexpr Recipe projected_k{"projected k", "pbd", true, projected_k_settings};
constexpr std::array recipes = {
    Recipe{"recommended", "quasi_newton", true, recommended_settings},
    Recipe{"fast", "quasi_newton", true, fast_settings},
    Recipe{"reference", "newton", true, reference_settings},
    Recipe{"paper", "", false, paper_settings},
};

bool is_given(const Json& settings, const char* pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

bool is_k(const Json& settings, const char* pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && (*value == "k" || *value == "k_per_step");
}

// Whether a config that names no method states what only a method that projects constraints takes.
bool asks_for_projection(const Json& settings) {
  if (is_k(settings, "/material/strain/stiffness") || is_k(settings, "/bending/stiffness") ||
      (is_given(settings, "/bending/k") && !is_given(settings, "/bending/stiffness")))
    return true;
  const Json* const name = value_at(settings, "/bending/model");
  const BendingModel* const model =
      name != nullptr && name->is_string() ? find_bending_model(name->get<std::string>()) : nullptr;
  if (model != nullptr && model->one_sided) return true;
  const Method &implicit = *find_method("quasi_newton"), &projecting = *find_method("pbd");
  if (const Json* const solver = value_at(settings, "/solver"); solver != nullptr && solver->is_object())
    for (const auto& [key, value] : solver->items())
      if (!value.is_null() && projecting.reads(key) && !implicit.reads(key)) return true;
  const Json* const effects = value_at(settings, "/effects");
  if (effects == nullptr || !effects->is_array()) return false;
  return std::ranges::any_of(*effects, [&](const Json& listed) {
    const Json* const type = value_at(listed, "/type");
    const Effect* const effect =
        type != nullptr && type->is_string() ? find_effect(type->get<std::string>()) : nullptr;
    return effect != nullptr && !effect->helps_projection &&
           !implicit.takes_effect(effect->name, effect->needs_projection);
  });
}

const Recipe* recipe_of(const Json& settings) {
  const Json* const chosen = value_at(settings, "/defaults");
  const std::string name =
      chosen != nullptr && chosen->is_string() ? chosen->get<std::string>() : "recommended";
  const auto found = std::ranges::find(recipes, name, &Recipe::name);
  if (found == recipes.end()) return nullptr;
  if (found != recipes.begin()) return &*found;
  const Json* const method = value_at(settings, "/solver/method");
  if (method == nullptr) return asks_for_projection(settings) ? &projected_k : &*found;
  return *method == projected.method ? &projected : &*found;
}

bool of_the_paper(const Json& settings) {
  const Recipe* const recipe = recipe_of(settings);
  return recipe != nullptr && recipe->name == "paper";
}

// Where a section is no object the table's check says so.
void fill(Json& settings, const RecipeSetting& setting) {
  const Json* const section = value_at(settings, setting.section);
  if (section == nullptr || (section->is_object() && !section->contains(setting.name)))
    set_at(settings, fmt::format("{}/{}", setting.section, setting.name), Json::parse(setting.value));
}

// What a config states of another method is left to that one's own defaults.
void fill(Json& settings, const Recipe& recipe) {
  const Json* const method = value_at(settings, "/solver/method");
  const bool other = !recipe.method.empty() && method != nullptr && *method != recipe.method;
  for (const RecipeSetting& setting : recipe.settings)
    if (!other || std::string_view(setting.section) != "/solver") fill(settings, setting);
}

bool given(const Json& section, const char* name) {
  return section.contains(name) && !section[name].is_null();
}

// Whoever gives k means k, and whoever gives a compliance means that.
void choose_stiffness(Json& bending, const char* otherwise, ConfigProblems& problems) {
  if (bending.contains("stiffness")) return;
  const bool k = given(bending, "k"), compliance = given(bending, "compliance"),
             physical = given(bending, "flexural_rigidity") || given(bending, "quartic_coefficient");
  if (k + compliance + physical > 1)
    problems.push_back({"/bending/stiffness",
                        fmt::format("is missing, and {} are given: say which of them counts, as \"k\", "
                                    "\"k_per_step\", \"compliance\" or \"physical\"",
                                    !physical ? "k and compliance"
                                    : k       ? "k and a rigidity"
                                              : "compliance and a rigidity")});
  bending["stiffness"] = k ? "k" : compliance ? "compliance" : physical ? "physical" : otherwise;
}

// The stated rigidity of a sheet of which only the model is known.
void state_rigidity(Json& bending) {
  const Json name = bending.value("model", Json(default_bending_model));
  const BendingModel* const model = name.is_string() ? find_bending_model(name.get<std::string>()) : nullptr;
  if (bending["stiffness"] != "physical" || given(bending, "quartic_coefficient") || name == "none") return;
  if (!given(bending, "flexural_rigidity")) bending["flexural_rigidity"] = default_flexural_rigidity;
  if (model != nullptr && model->springs_only && !model->prestressed && !given(bending, "at_curvature"))
    bending["at_curvature"] = default_at_curvature;
}

// The section of that pointer, or null.
Json* section_of(Json& settings, const char* pointer) {
  const Json::json_pointer at(pointer);
  return settings.contains(at) && settings[at].is_object() ? &settings[at] : nullptr;
}

// Whoever gives a membrane's number means that.
void choose_membrane(Json& settings) {
  Json* const strain = section_of(settings, "/material/strain");
  if (strain == nullptr || strain->contains("stiffness")) return;
  const auto any_of = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* name) { return given(*strain, name); });
  };
  if (any_of({"membrane_stiffness"}))
    (*strain)["stiffness"] = "physical";
  else if (any_of({"compliance"}))
    (*strain)["stiffness"] = "compliance";
  else if (any_of({"warp", "weft", "shear", "area"}))
    (*strain)["stiffness"] = "k";
}

// The stated stiffness of a membrane that says no other, or only that it is physical.
void state_membrane(Json& settings) {
  fill(settings, RecipeSetting{"/material/strain", "stiffness", R"("physical")"});
  Json* const strain = section_of(settings, "/material/strain");
  if (strain != nullptr && strain->value("stiffness", Json()) == "physical" &&
      !given(*strain, "membrane_stiffness"))
    (*strain)["membrane_stiffness"] = default_membrane_stiffness;
}

// A method with steps of its own kind has its own defaults for them.
void state_steps(Json& settings) {
  const Json* const name = value_at(settings, "/solver/method");
  const Method* const method = name && name->is_string() ? find_method(name->get<std::string>()) : nullptr;
  if (method == nullptr) return;
  Json& solver = settings["solver"];
  if (method->default_substeps > 0 && !given(solver, "substeps"))
    solver["substeps"] = method->default_substeps;
  if (method->default_iterations > 0 && !given(solver, "iterations"))
    solver["iterations"] = method->default_iterations;
  for (const Parameter& row : method->parameters)
    if (!given(solver, row.name.data())) solver[std::string(row.name)] = json_of(default_of(row));
}

// A build may lack an effect.
void append_effect(Json& effects, const char* type, Json settings = Json::object()) {
  if (find_effect(type) == nullptr) return;
  settings["type"] = type;
  effects.push_back(std::move(settings));
}

}  // namespace

Json default_effects(const Json& settings) {
  Json effects = Json::array();
  append_effect(effects, "gravity");
  const Recipe* const recipe = recipe_of(settings);
  if (recipe != nullptr && !recipe->drags) return effects;
  append_effect(effects, "viscous_drag", {{"coefficient", default_drag_coefficient}});
  return effects;
}

Json with_defaults(const Json& settings, ConfigProblems& problems) {
  Json filled = settings;
  if (!filled.is_object()) return filled;
  choose_membrane(filled);
  const Recipe* const recipe = recipe_of(filled);
  const bool has_method = recipe != nullptr && !recipe->method.empty();
  if (has_method) fill(filled, *recipe);
  state_steps(filled);
  if (recipe != nullptr && !has_method) fill(filled, *recipe);
  state_membrane(filled);
  state_rows(filled);
  if (!filled.contains("effects")) filled["effects"] = default_effects(filled);
  if (!filled.contains("bending")) filled["bending"] = Json::object();
  if (Json& bending = filled["bending"]; bending.is_object()) {
    choose_stiffness(bending, of_the_paper(settings) ? "k" : "physical", problems);
    state_rigidity(bending);
  }
  return filled;
}

}  // namespace bendlab
