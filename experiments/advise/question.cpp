#include "experiments/advise/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>

#include "bendlab/bending/model.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/scene/scene.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 2> damping = {"rigid_damping", "constraint_damping"};
constexpr std::array<std::string_view, 2> bounds = {"tethers", "strain_limiting"};

template <class Names>
bool among(const Json& effect, const Names& names) {
  return std::ranges::find(names, effect["type"].get<std::string>()) != names.end();
}

std::string set(std::string_view pointer, const Json& value) {
  return fmt::format("{}={}", pointer, value.dump());
}

// Hinges for a flexural rigidity; only springs make a quartic cloth.
std::string reference_model_of(const RunConfig& scene) {
  return scene.section("/bending").has("flexural_rigidity") ? "dihedral" : scene.bending_model();
}

// The options that would choose a value of each swept setting.
std::string open_axes(const Experiment& experiment) {
  std::string text;
  for (const auto& [pointer, values] : experiment.axes)
    if (values.size() > 1) text += fmt::format("{}--set {}=VALUE", text.empty() ? "" : " ", pointer);
  return text;
}

void check_states_a_cloth(const RunConfig& scene, const std::string& source) {
  const ParameterValues bending = scene.section("/bending");
  const std::string& stiffness = bending.text("stiffness");
  if (stiffness != "physical")
    throw ConfigError(
        source,
        {{"/bending/stiffness",
          fmt::format(
              "is {}, which makes another cloth with every model and setting, so that no result is the right "
              "one; state the cloth: \"bending\": {{\"stiffness\": \"physical\", "
              "\"flexural_rigidity\": B}}, B in N m (cotton about 1e-5); springs have it at "
              "\"at_curvature\", 20/m if that is absent",
              stiffness)}});
  if (scene.bending_model() == "none" && !bending.has("flexural_rigidity"))
    throw ConfigError(
        source, {{"/bending/model",
                  "is none, which has no bending stiffness: give flexural_rigidity (in N m), or choose the "
                  "spring model that quartic_coefficient is for"}});
}

bool is_tethers(const Json& effect) {
  return effect["type"] == "tethers";
}

Variant variant_of(const RunConfig& scene) {
  return {.tethers = std::ranges::any_of(scene.resolved()["effects"], is_tethers),
          .shear = scene.section("/material/strain").text("form"),
          .flight_limit = scene.section("/solver").has("flight_limit")
                              ? scene.section("/solver").number("flight_limit")
                              : 0,
          .method = scene.section("/solver").text("method"),
          .softened = scene.section("/solver").has("membrane") &&
                      scene.section("/solver").text("membrane") == "auto",
          .second_order = scene.section("/solver").has("membrane") &&
                          scene.section("/solver").text("integrator") == "bdf2"};
}

bool is_held(const RunConfig& scene) {
  const ParameterValues pins = scene.section("/pins");
  return !pins.texts("vertices").empty() || !pins.numbers("indices").empty();
}

Json without_effects(const Json& effects, auto left_out) {
  Json kept = Json::array();
  for (const Json& effect : effects)
    if (!left_out(effect)) kept.push_back(effect);
  return kept;
}

// Makes file names relative to another folder: those of settings called `file`, also in sweeps and in changes
// ("/mesh/file=sheet.obj").
class MovedFiles {
 public:
  MovedFiles(const std::filesystem::path& from, const std::filesystem::path& to)
      : from_(from), to_(std::filesystem::absolute(to.empty() ? "." : to).lexically_normal()) {}

  void move(Json& node) const {
    if (node.is_object())
      for (auto& [key, value] : node.items())
        key == "file" || key.ends_with("/file") ? rename(value) : move(value);
    if (node.is_array())
      for (Json& entry : node) entry.is_string() ? move_change(entry) : move(entry);
  }

 private:
  void rename(Json& file) const {
    if (file.is_array())
      for (Json& each : file) rename(each);
    if (!file.is_string()) return;
    const auto there = std::filesystem::absolute(from_ / file.get<std::string>());
    file = there.lexically_normal().lexically_proximate(to_).string();
  }

  void move_change(Json& entry) const {
    const std::string text = entry.get<std::string>();
    const std::size_t at = text.find('=');
    if (!text.starts_with('/') || at == std::string::npos) return;
    const std::string pointer = text.substr(0, at), value = text.substr(at + 1);
    const Json parsed = Json::parse(value, nullptr, false);
    const Json before = {{pointer, parsed.is_discarded() ? Json(value) : parsed}};
    Json after = before;
    move(after);
    if (after != before) entry = pointer + "=" + after[pointer].dump();
  }

  std::filesystem::path from_, to_;
};

}  // namespace

Question::Question(std::filesystem::path file, std::vector<std::string> overrides)
    : file_(std::move(file)), overrides_(std::move(overrides)) {
  const Experiment experiment = load_experiment(file_, overrides_);
  if (experiment.runs.size() != 1)
    throw ConfigError(file_.string(),
                      {{"/sweep", fmt::format("has {} runs, but advice is for one scene: choose it with {}",
                                              experiment.runs.size(), open_axes(experiment))}});
  scene_ = experiment.runs.front();
  name_ = experiment.name;
  written_effects_ = experiment.settings.value("effects", scene_.resolved()["effects"]);
  effects_swept_ = std::ranges::any_of(experiment.axes,
                                       [](const Axis& axis) { return lies_within(axis.first, "/effects"); });
  own_ = variant_of(scene_);
  const Json& bending = experiment.settings.value("bending", Json::object());
  rigidity_is_default_ = !bending.contains("flexural_rigidity") && !bending.contains("quartic_coefficient");
  check_states_a_cloth(scene_, file_.string());
  reference_model_ = reference_model_of(scene_);
  const ParameterValues accuracy = scene_.section("/accuracy");
  if (accuracy.has("solver") && !accuracy.has("physical"))
    throw ConfigError(file_.string(),
                      {{"/accuracy/physical",
                        "is missing: models are compared with one stated cloth, but /accuracy/solver "
                        "compares each with itself. Name the reference here, or remove /accuracy"}});
}

ErrorOf Question::natural_error() const {
  if (scene_.section("/accuracy").has("physical")) return ErrorOf::own;
  bool damped = false;
  for (const Json& effect : scene_.resolved()["effects"]) {
    const std::string type = effect["type"];
    damped |= type == "viscous_drag" || among(effect, damping);
    if (type != "gravity" && type != "viscous_drag" && !among(effect, damping) && !among(effect, bounds))
      return ErrorOf::motion;
  }
  const ParameterValues initial = scene_.section("/initial");
  const auto still = [&](const char* velocity) {
    return std::ranges::all_of(initial.numbers(velocity), [](double v) { return v == 0; });
  };
  return is_held(scene_) && damped && still("velocity") && still("spin") ? ErrorOf::rest : ErrorOf::motion;
}

Json Question::accuracy(ErrorOf what, bool start_from_end) const {
  if (what == ErrorOf::own) {
    Json accuracy = scene_.resolved()["accuracy"];
    std::vector<std::string> changes = own_changes();
    for (const Json& change : accuracy["physical"]) changes.push_back(change);
    accuracy["physical"] = changes;
    return accuracy;
  }
  Json accuracy = Json::object();
  if (what == ErrorOf::motion) {
    accuracy["physical"] = motion_changes();
    accuracy["physical_coarser"] = {fmt::format("/solver/substeps={}", reference_substeps() / 2)};
    accuracy["over_time"] = true;
  } else {
    accuracy["physical"] = rest_changes();
    accuracy["align"] = "vertical";
    accuracy["start_from_end"] = start_from_end;
  }
  return accuracy;
}

int Question::reference_substeps() const {
  constexpr double allowed_s = 60, projection_s = 6e-9;
  constexpr double per_triangle = 2 * (3 + 1.5);  // strain and hinges, there and back
  const double triangles = static_cast<double>(rest_mesh_of(scene_).mesh.triangles.rows());
  const double steps = scene_.section("").number("duration") / scene_.section("/solver").number("dt");
  const double substeps = allowed_s / (steps * triangles * per_triangle * projection_s);
  return std::clamp(
      static_cast<int>(std::bit_floor(static_cast<unsigned>(std::clamp(substeps, 1.0, 1024.0)))), 64, 1024);
}

double Question::speed(double kinetic_energy) const {
  const AcceptedMesh accepted = rest_mesh_of(scene_);
  const RestMesh rest(accepted.mesh);
  double area = 0;
  for (const double each : rest.areas()) area += each;
  const double mass = scene_.section("/material").number("density") * area;
  return mass > 0 ? std::sqrt(2 * kinetic_energy / mass) / rest.size() : 0;
}

std::vector<std::string> Question::rest_changes() const {
  const Json& strain = scene_.resolved()["material"]["strain"];
  Json bending = scene_.resolved()["bending"];
  bending["model"] = reference_model_;
  std::vector<std::string> changes = {R"(/solver={"method":"equilibrium"})",
                                      "/duration=20",
                                      "/settled_speed=0",
                                      "/output/frames_per_second=1",
                                      set("/material/strain/form", own_.shear),
                                      set("/bending", bending)};
  if (strain["stiffness"] != "compliance" || strain["compliance"].get<double>() == 0) {
    changes.emplace_back("/material/strain/stiffness=compliance");
    changes.push_back(set("/material/strain/compliance", stiff_membrane));
  }
  changes.push_back(set("/effects", without_effects(scene_.resolved()["effects"], [](const Json& effect) {
                          return among(effect, damping) || among(effect, bounds);
                        })));
  return changes;
}

std::vector<std::string> Question::motion_changes() const {
  Json bending = scene_.resolved()["bending"];
  bending["model"] = reference_model_;
  std::vector<std::string> changes = own_changes();
  changes.insert(changes.end(),
                 {"/settled_speed=0", "/solver/method=pbd",
                  fmt::format("/solver/substeps={}", reference_substeps()), "/solver/iterations=1",
                  "/solver/sweep=symmetric", "/solver/precision=double", set("/bending", bending)});
  return changes;
}

std::vector<std::string> Question::own_changes() const {
  std::vector<std::string> changes = {set("/effects", scene_.resolved()["effects"]),
                                      set("/material/strain/form", own_.shear),
                                      set("/solver", scene_.resolved()["solver"])};
  const Json& bending = scene_.resolved()["bending"];
  if (const auto own = bending.find(scene_.bending_model()); own != bending.end())
    changes.push_back(set("/bending/" + scene_.bending_model(), *own));
  return changes;
}

Variant Question::recommended_variant(std::string_view method, bool softened) const {
  Variant variant = own_;
  variant.tethers |= may_tether();
  variant.shear = "angle";
  return in_method(variant, method, softened);
}

// An entry of a swept list has the place that its axis names.
bool Question::may_tether() const {
  return is_held(scene_) && !effects_swept_;
}

// Springs of 2, 4 and 8 edges, as long as they are short beside the sheet.
VariantChoices Question::choices(const std::string& model, const std::vector<std::string>& methods) const {
  VariantChoices choices{.tethers = may_tether(), .methods = methods};
  const auto& parameters = find_bending_model(model)->parameters;
  if (std::ranges::find(parameters, "radius", &Parameter::name) == parameters.end()) return choices;
  constexpr double longest = 0.15;  // sizes
  const AcceptedMesh accepted = rest_mesh_of(scene_);
  const RestMesh rest(accepted.mesh);
  for (const int edges : {2, 4, 8})
    if (const double radius = edges * rest.mean_edge_length(); radius <= longest * rest.size())
      choices.radii.push_back(std::stod(fmt::format("{:.3g}", radius)));
  return choices;
}

std::vector<Setting> Question::neighbours(const Setting& setting,
                                          const std::vector<std::string>& methods) const {
  std::vector<Setting> found;
  for (const Variant& variant : bendlab::neighbours(setting.variant, choices(setting.model, methods)))
    found.push_back({.model = setting.model, .substeps = setting.substeps, .variant = variant});
  return found;
}

Json Question::effects_with(bool tethers) const {
  if (!tethers) return without_effects(written_effects_, is_tethers);
  Json effects = written_effects_;
  effects.push_back({{"type", "tethers"}});
  return effects;
}

std::vector<std::string> Question::changes(const Setting& setting) const {
  const Variant& variant = setting.variant;
  const Method& method = *find_method(variant.method);
  std::vector<std::string> changes = {"/bending/model=" + setting.model,
                                      fmt::format("/solver/substeps={}", setting.substeps),
                                      fmt::format("/solver/iterations={}", setting.iterations)};
  if (variant.method != own_.method) changes.insert(changes.begin(), "/solver/method=" + variant.method);
  if (method.reads("precision"))
    changes.push_back(fmt::format("/solver/precision={}", setting.double_precision ? "double" : "single"));
  if (softens(variant.method)) {
    changes.push_back(fmt::format("/solver/membrane={}", variant.softened ? "auto" : "stated"));
    changes.push_back(fmt::format("/solver/integrator={}", variant.second_order ? "bdf2" : "euler"));
  }
  if (method.projects && variant.tethers != own_.tethers)
    changes.push_back(set("/effects", effects_with(variant.tethers)));
  if (variant.shear != own_.shear) changes.push_back("/material/strain/form=" + variant.shear);
  if (method.projects && variant.flight_limit != own_.flight_limit)
    changes.push_back(fmt::format("/solver/flight_limit={}", variant.flight_limit));
  if (variant.radius > 0)
    changes.push_back(fmt::format("/bending/{}/radius={}", setting.model, variant.radius));
  return changes;
}

RunConfig Question::run_with(const Setting& setting, const Json& accuracy) const {
  return run_with(setting, accuracy, {});
}

RunConfig Question::longer_run_with(const Setting& setting, const Json& accuracy, double times) const {
  return run_with(
      setting, accuracy,
      {fmt::format("/duration={}", times * scene_.section("").number("duration")), "/settled_speed=0"});
}

RunConfig Question::run_with(const Setting& setting, const Json& accuracy,
                             const std::vector<std::string>& further) const {
  std::vector<std::string> overrides = overrides_;
  std::ranges::copy(changes(setting), std::back_inserter(overrides));
  overrides.push_back(set("/accuracy", accuracy));
  const bool of_the_end = !accuracy.value("over_time", false);
  overrides.emplace_back(of_the_end ? "/output/frames_per_second=1" : "/settled_speed=0");
  std::ranges::copy(further, std::back_inserter(overrides));
  RunConfig run = load_experiment(file_, overrides).runs.front();
  const Variant& variant = setting.variant;
  run.point = {{"/bending/model", setting.model},
               {"/solver/method", variant.method},
               {"/solver/substeps", setting.substeps},
               {"/solver/iterations", setting.iterations},
               {"/solver/precision", setting.double_precision ? "double" : "single"}};
  // By these a message tells runs apart; no setting says alone whether there are tethers.
  run.point.emplace_back("/effects/tethers", variant.tethers);
  run.point.emplace_back("/material/strain/form", variant.shear);
  if (variant.softened) run.point.emplace_back("/solver/membrane", "auto");
  if (variant.second_order) run.point.emplace_back("/solver/integrator", "bdf2");
  if (variant.flight_limit != own_.flight_limit)
    run.point.emplace_back("/solver/flight_limit", variant.flight_limit);
  if (variant.radius > 0)
    run.point.emplace_back(fmt::format("/bending/{}/radius", setting.model), variant.radius);
  return run;
}

Json Question::written(const Setting& setting, const std::filesystem::path& folder) const {
  std::ifstream stream(file_, std::ios::binary);
  Json document = parse_strict_json(std::string(std::istreambuf_iterator<char>(stream), {}), file_.string());
  std::vector<std::string> overrides = overrides_;
  std::ranges::copy(changes(setting), std::back_inserter(overrides));
  ConfigProblems problems;
  apply_overrides(document, overrides, problems);
  if (!problems.empty()) throw ConfigError(file_.string(), std::move(problems));
  document.erase("accuracy");
  if (document.contains("expect"))
    document["expect"] =
        without_effects(document["expect"], [](const Json& entry) { return entry.contains("where"); });
  MovedFiles(file_.parent_path(), folder).move(document);
  return document;
}

}  // namespace bendlab
