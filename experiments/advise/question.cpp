#include "experiments/advise/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

std::string set(std::string_view pointer, const Json& value) {
  return fmt::format("{}={}", pointer, value.dump());
}

// Hinges for a flexural rigidity; only springs make a quartic cloth.
std::string reference_model_of(const RunConfig& scene) {
  const Bending& bending = scene.scene().bending;
  if (!bending.flexural_rigidity) return std::string(bending.model.name());
  const auto kinds = bending_models();
  return std::string((*std::ranges::find_if(kinds, &BendingKind::is_reference))->name);
}

std::string method_without_motion() {
  const auto kinds = methods();
  return std::string((*std::ranges::find_if_not(kinds, &MethodKind::has_motion))->name);
}

// The options that would choose a value of each swept setting.
std::string open_axes(const Experiment& experiment) {
  std::string text;
  for (const auto& [pointer, values] : experiment.axes)
    if (values.size() > 1) text += fmt::format("{}--set {}=VALUE", text.empty() ? "" : " ", pointer);
  return text;
}

void check_is_one_scene(const Experiment& experiment, const std::string& source) {
  if (experiment.runs.size() != 1)
    throw ConfigError(source,
                      {{"/sweep", fmt::format("has {} runs, but advice is for one scene: choose it with {}",
                                              experiment.runs.size(), open_axes(experiment))}});
  for (const auto& [pointer, values] : experiment.axes)
    if (lies_within(pointer, "/solver") && pointer != "/solver")
      throw ConfigError(source, {{child_pointer("/sweep", pointer),
                                  "sweeps a part of what is to be advised: write the value in /solver"}});
}

void check_states_a_cloth(const RunConfig& scene, const std::string& source) {
  const Bending& bending = scene.scene().bending;
  if (bending.stiffness != Stiffness::physical)
    throw ConfigError(
        source,
        {{"/bending/stiffness",
          fmt::format(
              "is {}, which makes another cloth with every model and setting, so that no result is the right "
              "one; state the cloth: \"bending\": {{\"stiffness\": \"physical\", "
              "\"flexural_rigidity\": B}}, B in N m (cotton about 1e-5); springs have it at "
              "\"at_curvature\", 20/m if that is absent",
              value_at(scene.resolved(), "/bending/stiffness")->get<std::string>())}});
  if (!bending.model.kind().bends && !bending.flexural_rigidity)
    throw ConfigError(
        source, {{"/bending/model",
                  "is none, which has no bending stiffness: give flexural_rigidity (in N m), or choose the "
                  "spring model that quartic_coefficient is for"}});
}

bool is_held(const RunConfig& scene) {
  const Pinning& pins = scene.scene().pins;
  return !pins.vertices.empty() || !pins.indices.empty();
}

Json without(const Json& list, auto left_out) {
  Json kept = Json::array();
  for (const Json& entry : list)
    if (!left_out(entry)) kept.push_back(entry);
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
  check_is_one_scene(experiment, file_.string());
  scene_ = experiment.runs.front();
  name_ = experiment.name;
  own_solver_ = experiment.settings.value("solver", Json::object());
  const Json& bending = experiment.settings.value("bending", Json::object());
  rigidity_is_default_ = !bending.contains("flexural_rigidity") && !bending.contains("quartic_coefficient");
  check_states_a_cloth(scene_, file_.string());
  reference_model_ = reference_model_of(scene_);
  const Accuracy& accuracy = scene_.settings().accuracy;
  if (accuracy.solver && !accuracy.physical)
    throw ConfigError(file_.string(),
                      {{"/accuracy/physical",
                        "is missing: models are compared with one stated cloth, but /accuracy/solver "
                        "compares each with itself. Name the reference here, or remove /accuracy"}});
}

Setting Question::own_setting() const {
  const Solver& solver = scene_.scene().solver;
  const Setting usual;
  Setting own{.model = std::string(scene_.scene().bending.model.name()),
              .method = std::string(solver.method.name()),
              .substeps = solver.substeps.value_or(usual.substeps),
              .iterations = solver.iterations.value_or(usual.iterations)};
  Json further = own_solver_;
  for (const char* apart : {"method", "substeps", "iterations", "dt", "threads", "precision"})
    further.erase(apart);
  own.solver = further.dump();
  return own;
}

int Question::cells_that_may_vary() const {
  const Json& settings = scene_.resolved();
  const Json& mesh = settings["mesh"];
  constexpr std::array flat = {"grid", "equilateral", "delaunay", "disc"};
  const bool is_flat = mesh.contains("generator") && mesh.value("flaw", "none") == "none" &&
                       std::ranges::find(flat, mesh["generator"].get<std::string>()) != flat.end();
  const auto names_indices = [](const Json& each) { return !each.value("indices", Json::array()).empty(); };
  if (!is_flat || names_indices(settings["pins"]) ||
      std::ranges::any_of(settings["effects"], names_indices) || settings["initial"].contains("after"))
    return 0;
  return mesh["cells"].get<int>();
}

ErrorOf Question::natural_error() const {
  if (scene_.settings().accuracy.physical) return ErrorOf::own;
  bool damped = false;
  for (const Effect& effect : scene_.scene().effects) {
    const EffectKind& kind = effect.kind();
    damped |= kind.damps;
    if (kind.acceleration == nullptr && !kind.damps && !kind.bounds_strain) return ErrorOf::motion;
  }
  const Initial& initial = scene_.scene().initial;
  const bool still = initial.velocity.isZero(0) && initial.spin.isZero(0);
  return is_held(scene_) && damped && still ? ErrorOf::rest : ErrorOf::motion;
}

Json Question::accuracy(const Reference& reference) const {
  Json accuracy = reference.of == ErrorOf::own ? scene_.resolved()["accuracy"] : Json::object();
  std::vector<std::string> changes = own_changes();
  if (reference.of == ErrorOf::own)
    for (const Json& change : accuracy["physical"]) changes.push_back(change);
  if (reference.of == ErrorOf::motion) {
    changes = motion_changes(reference.substeps);
    accuracy["physical_coarser"] = {fmt::format("/solver/substeps={}", reference.substeps / 2)};
    accuracy["over_time"] = true;
  }
  if (reference.of == ErrorOf::rest) {
    changes = rest_changes();
    accuracy["align"] = "vertical";
    accuracy["start_from_end"] = reference.start_from_end;
  }
  if (reference.cells > 0) changes.push_back(set("/mesh/cells", reference.cells));
  accuracy["physical"] = changes;
  return accuracy;
}

double Question::speed(double kinetic_energy) const {
  const AcceptedMesh accepted = rest_mesh_of(scene_.scene().mesh, scene_.folder());
  const RestMesh rest(accepted.mesh);
  double area = 0;
  for (const double each : rest.areas()) area += each;
  const double mass = scene_.scene().material.density * area;
  return mass > 0 ? std::sqrt(2 * kinetic_energy / mass) / rest.size() : 0;
}

// A reference is the same whatever the setting of the run.
std::string Question::method_that_projects() {
  const auto kinds = methods();
  return std::string((*std::ranges::find_if(kinds, &MethodKind::projects))->name);
}

std::vector<std::string> Question::own_changes() const {
  const Json& settings = scene_.resolved();
  std::vector<std::string> changes = {set("/mesh", settings["mesh"]), set("/solver", settings["solver"])};
  if (const auto own = settings["bending"].find(std::string(scene_.scene().bending.model.name()));
      own != settings["bending"].end())
    changes.push_back(set(fmt::format("/bending/{}", scene_.scene().bending.model.name()), *own));
  return changes;
}

std::vector<std::string> Question::rest_changes() const {
  const Json& settings = scene_.resolved();
  const Json& strain = settings["material"]["strain"];
  Json bending = settings["bending"];
  bending["model"] = reference_model_;
  std::vector<std::string> changes = {set("/mesh", settings["mesh"]),
                                      set("/solver", {{"method", method_without_motion()}}),
                                      "/duration=20",
                                      "/settled_speed=0",
                                      "/output/frames_per_second=1",
                                      set("/bending", bending)};
  if (strain["stiffness"] == "k" || strain["stiffness"] == "k_per_step" ||
      (strain["stiffness"] == "compliance" && strain["compliance"].get<double>() == 0)) {
    changes.emplace_back("/material/strain/stiffness=compliance");
    changes.push_back(set("/material/strain/compliance", stiff_membrane));
  }
  changes.push_back(set("/effects", without(settings["effects"], [](const Json& effect) {
                          const EffectKind& kind = *find_effect(effect["type"].get<std::string>());
                          return kind.damps || kind.bounds_strain;
                        })));
  return changes;
}

std::vector<std::string> Question::motion_changes(int substeps) const {
  const Json& settings = scene_.resolved();
  Json bending = settings["bending"], solver = {{"method", method_that_projects()},
                                                {"dt", settings["solver"]["dt"]},
                                                {"substeps", substeps},
                                                {"iterations", 1},
                                                {"sweep", "symmetric"},
                                                {"precision", "double"}};
  bending["model"] = reference_model_;
  return {set("/mesh", settings["mesh"]), "/settled_speed=0", set("/solver", solver),
          set("/bending", bending)};
}

std::vector<std::string> Question::changes(const Setting& setting) const {
  Json solver = Json::parse(setting.solver);
  solver.update(
      {{"method", setting.method}, {"substeps", setting.substeps}, {"iterations", setting.iterations}});
  for (const char* own : {"dt", "threads", "precision"})
    if (own_solver_.contains(own) &&
        (own != std::string_view("precision") || find_method(setting.method)->make_float))
      solver[own] = own_solver_[own];
  std::vector<std::string> changes = {"/bending/model=" + setting.model, set("/solver", solver)};
  if (setting.cells > 0) changes.push_back(set("/mesh/cells", setting.cells));
  return changes;
}

RunConfig Question::run_with(const Setting& setting, const Json& accuracy, double times) const {
  std::vector<std::string> overrides = overrides_;
  std::ranges::copy(changes(setting), std::back_inserter(overrides));
  overrides.push_back(set("/accuracy", accuracy));
  const bool of_the_end = !accuracy.value("over_time", false);
  if (of_the_end) overrides.emplace_back("/output/frames_per_second=1");
  if (!of_the_end || times != 1) overrides.emplace_back("/settled_speed=0");
  if (times != 1) overrides.push_back(fmt::format("/duration={}", times * scene_.scene().duration));
  RunConfig run = load_experiment(file_, overrides).runs.front();
  run.point = {{"/bending/model", setting.model},
               {"/solver/method", setting.method},
               {"/solver/substeps", setting.substeps},
               {"/solver/iterations", setting.iterations}};
  const Json further = Json::parse(setting.solver);
  for (const auto& [name, value] : further.items()) run.point.emplace_back("/solver/" + name, value);
  if (setting.cells > 0) run.point.emplace_back("/mesh/cells", setting.cells);
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
        without(document["expect"], [](const Json& entry) { return entry.contains("where"); });
  MovedFiles(file_.parent_path(), folder).move(document);
  return document;
}

}  // namespace bendlab
