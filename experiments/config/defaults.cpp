#include "experiments/config/defaults.hpp"

#include <fmt/format.h>

#include <string>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/lattice_rows.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/resolve.hpp"

namespace bendlab {
namespace {

bool of_the_paper(const Json& settings) {
  const Json* const chosen = value_at(settings, "/defaults");
  return chosen != nullptr && *chosen == "paper";
}

// The paper gives no numbers but those of its springs; ours for the rest are in configs/paper.
struct PaperSetting {
  const char *section, *name, *value;
};
constexpr std::array paper_settings = {
    PaperSetting{"/pins", "ring", "1"},
    PaperSetting{"/material/strain", "form", R"("normalised")"},
    PaperSetting{"/bending", "model", R"("adaptive")"},
    PaperSetting{"/solver", "substeps", "1"},
    PaperSetting{"/solver", "iterations", "10"},
};

// Where a section is no object the table's check says so.
void fill(Json& settings, const PaperSetting& setting) {
  const Json* const section = value_at(settings, setting.section);
  if (section == nullptr || (section->is_object() && !section->contains(setting.name)))
    set_at(settings, fmt::format("{}/{}", setting.section, setting.name), Json::parse(setting.value));
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
  if (of_the_paper(settings)) return effects;
  append_effect(effects, "tethers");
  append_effect(effects, "viscous_drag", {{"coefficient", default_drag_coefficient}});
  return effects;
}

Json with_defaults(const Json& settings, ConfigProblems& problems) {
  Json filled = settings;
  if (!filled.is_object()) return filled;
  state_steps(filled);
  if (of_the_paper(settings))
    for (const PaperSetting& setting : paper_settings) fill(filled, setting);
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
