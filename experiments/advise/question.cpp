#include "experiments/advise/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/references.hpp"
#include "experiments/config/run_json.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

std::string set(std::string_view pointer, const Json& value) {
  return fmt::format("{}={}", pointer, value.dump());
}

template <class Kinds, class Trait>
const auto& first_with(const Kinds& kinds, Trait trait) {
  return **std::ranges::find_if(kinds, trait);
}

void check_is_one_scene(const Experiment& experiment, const std::string& source) {
  std::string choice;
  for (const auto& [pointer, values] : experiment.axes)
    if (values.size() > 1) choice += fmt::format(" --set {}=VALUE", pointer);
  if (experiment.runs.size() != 1)
    throw ConfigError(
        source, {{"/sweep", fmt::format("has {} runs, but advice is for one scene: choose the scene with{}",
                                        experiment.runs.size(), choice)}});
  for (const auto& [pointer, values] : experiment.axes)
    if (lies_within(pointer, "/solver") && pointer != "/solver")
      throw ConfigError(
          source,
          {{child_pointer("/sweep", pointer),
            "sweeps a setting of the solver, but advice needs one value: write this value in /solver"}});
}

void check_states_a_cloth(const RunConfig& scene, const std::string& source) {
  const Bending& bending = scene.scene().bending;
  if (bending.stiffness != Stiffness::physical)
    throw ConfigError(
        source, {{"/bending/stiffness",
                  fmt::format("is {}: every model and setting then simulates a different cloth, and there is "
                              "no correct result. State the cloth: \"bending\": {{\"stiffness\": "
                              "\"physical\", \"flexural_rigidity\": B}}, B in N m (cotton about 1e-5); "
                              "springs have this rigidity at \"at_curvature\" (20/m by default)",
                              value_at(scene.resolved(), "/bending/stiffness")->get<std::string>())}});
  if (!bending.model.kind().bends && !bending.flexural_rigidity)
    throw ConfigError(source,
                      {{"/bending/model",
                        "is none, a model without bending, but only springs have a quartic_coefficient: "
                        "choose a spring model, or state flexural_rigidity (in N m) instead"}});
  const Accuracy& accuracy = scene.settings().accuracy;
  if (accuracy.solver && !accuracy.physical)
    throw ConfigError(source,
                      {{"/accuracy/physical",
                        "is missing: advice compares every model with the stated cloth, but /accuracy/solver "
                        "compares a model with itself. State a reference here, or remove /accuracy"}});
}

}  // namespace

Method method_that_projects() {
  return Method(first_with(methods(), &MethodKind::projects));
}

Question::Question(fs::path file, std::vector<std::string> overrides)
    : file_(std::move(file)), overrides_(std::move(overrides)) {
  const Experiment experiment = load_experiment(file_, overrides_);
  check_is_one_scene(experiment, file_.string());
  scene_ = experiment.runs.front();
  check_states_a_cloth(scene_, file_.string());
  name_ = experiment.name;
  own_solver_ = experiment.settings.value("solver", Json::object());
  const Json& stated = experiment.settings.value("bending", Json::object());
  rigidity_is_default_ = !stated.contains("flexural_rigidity") && !stated.contains("quartic_coefficient");
  // Hinges represent a flexural rigidity; only springs represent a quartic cloth.
  const Bending& bending = scene_.scene().bending;
  reference_model_ = bending.flexural_rigidity ? first_with(bending_models(), &BendingKind::is_reference).name
                                               : bending.model.name();
}

Setting Question::own_setting() const {
  const Solver& solver = scene_.scene().solver;
  Json further = own_solver_;
  for (const char* apart : {"method", "substeps", "iterations", "dt", "threads", "precision"})
    further.erase(apart);
  return {.model = std::string(scene_.scene().bending.model.name()),
          .method = std::string(solver.method.name()),
          .solver = further.dump(),
          .substeps = solver.substeps.value_or(1),
          .iterations = solver.iterations.value_or(1)};
}

int Question::cells_that_may_vary() const {
  const Scene& scene = scene_.scene();
  constexpr std::array flat = {Generator::grid, Generator::equilateral, Generator::delaunay, Generator::disc};
  const bool is_flat = !scene.mesh.file && scene.mesh.flaw == "none" &&
                       std::ranges::find(flat, scene.mesh.generator) != flat.end();
  const auto names_indices = [](const Json& effect) { return !effect.value("indices", Json()).empty(); };
  const bool may_vary = is_flat && scene.pins.indices.empty() && !scene.initial.after &&
                        std::ranges::none_of(scene_.resolved()["effects"], names_indices);
  return may_vary ? scene.mesh.cells : 0;
}

ErrorOf Question::natural_error() const {
  if (scene_.settings().accuracy.physical) return ErrorOf::own;
  const Scene& scene = scene_.scene();
  bool damped = false;
  for (const Effect& effect : scene.effects) {
    const EffectKind& kind = effect.kind();
    damped |= kind.damps;
    if (kind.acceleration == nullptr && !kind.damps && !kind.bounds_strain) return ErrorOf::motion;
  }
  const bool held = !scene.pins.vertices.empty() || !scene.pins.indices.empty();
  const bool still = scene.initial.velocity.isZero(0) && scene.initial.spin.isZero(0);
  return held && damped && still ? ErrorOf::rest : ErrorOf::motion;
}

Json Question::accuracy(const Reference& reference) const {
  RunSettings settings = scene_.settings();
  Scene& scene = settings.scene;
  Json accuracy = Json::object();
  if (reference.of == ErrorOf::own) {
    accuracy = scene_.resolved()["accuracy"];
  } else {
    settings.settled_speed = 0;
    if (scene.bending.model.name() != reference_model_)
      scene.bending.model = BendingModel(*find_bending_model(reference_model_));
    if (reference.cells > 0) scene.mesh.cells = reference.cells;
  }
  if (reference.of == ErrorOf::motion) {
    scene.solver = {.method = method_that_projects(),
                    .dt = scene.solver.dt,
                    .substeps = reference.substeps,
                    .iterations = 1,
                    .precision = ChosenPrecision::double_precision};
    accuracy["physical_coarser"] = {fmt::format("/solver/substeps={}", reference.substeps / 2)};
    accuracy["over_time"] = true;
  }
  if (reference.of == ErrorOf::rest) {
    scene.solver = {.method =
                        Method(first_with(methods(), [](const auto* kind) { return !kind->has_motion; }))};
    scene.duration = 20, settings.output.frames_per_second = 1;
    Strain& strain = scene.material.strain;
    if (strain.stiffness != Stiffness::physical &&
        (strain.stiffness != Stiffness::compliance || strain.compliance == 0))
      strain.stiffness = Stiffness::compliance, strain.compliance = stiff_membrane;
    std::erase_if(scene.effects, [](const Effect& e) { return e.kind().damps || e.kind().bounds_strain; });
    accuracy["align"] = "vertical";
    accuracy["start_from_end"] = reference.start_from_end;
  }
  Json sections = to_json(settings);
  if (reference.of == ErrorOf::motion) sections["solver"]["sweep"] = "symmetric";
  Json changes = Json::array();
  for (const std::string section :
       {"mesh", "material", "bending", "effects", "solver", "duration", "settled_speed", "output"})
    changes.push_back(set("/" + section, sections[section]));
  for (const Json& change : accuracy.value("physical", Json::array())) changes.push_back(change);
  accuracy["physical"] = changes;
  return accuracy;
}

std::vector<std::string> Question::changes(const Setting& setting) const {
  Json solver = Json::parse(setting.solver);
  solver.update(
      {{"method", setting.method}, {"substeps", setting.substeps}, {"iterations", setting.iterations}});
  for (const std::string own : {"dt", "threads", "precision"})
    if (own_solver_.contains(own) && (own != "precision" || find_method(setting.method)->make_float))
      solver[own] = own_solver_[own];
  std::vector<std::string> changes = {"/bending/model=" + setting.model, set("/solver", solver)};
  if (setting.cells > 0) changes.push_back(set("/mesh/cells", setting.cells));
  return changes;
}

std::vector<std::string> Question::overrides_with(const Setting& setting) const {
  std::vector<std::string> overrides = overrides_;
  std::ranges::copy(changes(setting), std::back_inserter(overrides));
  return overrides;
}

Experiment Question::experiment_with(const Setting& setting, const Json& accuracy, double times) const {
  std::vector<std::string> overrides = overrides_with(setting);
  overrides.push_back(set("/accuracy", accuracy));
  const bool of_the_end = !accuracy.value("over_time", false);
  if (of_the_end) overrides.emplace_back("/output/frames_per_second=1");
  if (!of_the_end || times != 1) overrides.emplace_back("/settled_speed=0");
  if (times != 1) overrides.push_back(fmt::format("/duration={}", times * scene_.scene().duration));
  Experiment experiment = load_experiment(file_, overrides);
  experiment.allow = {"implausible"};  // the advice says which runs are implausible
  experiment.axes.clear(), experiment.runs.front().point.clear();
  for (const std::string pointer : {"/bending/model", "/solver", "/mesh/cells"})
    if (const Json* value = value_at(experiment.settings, pointer)) {
      experiment.axes.push_back({pointer, {*value}});
      experiment.runs.front().point.emplace_back(pointer, *value);
    }
  return experiment;
}

Json Question::written(const Setting& setting, const fs::path& folder) const {
  std::ifstream stream(file_, std::ios::binary);
  Json document = parse_strict_json(std::string(std::istreambuf_iterator<char>(stream), {}), file_.string());
  ConfigProblems problems;
  apply_overrides(document, overrides_with(setting), problems);
  if (!problems.empty()) throw ConfigError(file_.string(), std::move(problems));
  document.erase("accuracy");
  const Json sweep = document.value("sweep", Json::object());  // every axis has one value
  document.erase("sweep");
  for (const auto& [pointer, values] : sweep.items()) set_at(document, pointer, values.front());
  Json expect = Json::array();
  for (const Json& entry : document.value("expect", Json::array()))
    if (!entry.contains("where")) expect.push_back(entry);
  document.erase("expect");
  if (!expect.empty()) document["expect"] = expect;
  const fs::path there = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
  const auto moved = [&](const fs::path& file) {
    return Json(fs::absolute(file).lexically_normal().lexically_proximate(there).string());
  };
  for (const NamedFile& file : input_files(scene_)) set_at(document, file.pointer, moved(file.path));
  if (const std::optional<RunConfig> before = run_before(scene_))
    for (const NamedFile& file : input_files(*before))
      for (Json& change : document["initial"]["after"])
        if (change.get<std::string>().starts_with(file.pointer + "="))
          change = set(file.pointer, moved(file.path));
  return document;
}

}  // namespace bendlab
