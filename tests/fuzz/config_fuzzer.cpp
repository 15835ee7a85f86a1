// Configs: text → strict JSON → experiment → settings of every run → scene → two steps.
//
// Either the config is refused with a ConfigError, or:
// * the resolved settings of every run, as text, are a config of exactly one run with the same settings;
// * its scene is built, or refused with one of our errors;
// * a step gives finite positions, or reports that the cloth diverged.
#include <algorithm>
#include <cmath>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/rules.hpp"
#include "bendlab/solver/simulation.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "tests/fuzz/fuzzer.hpp"
#include "tests/random_settings.hpp"

using namespace bendlab;
using namespace bendlab::fuzz;

namespace {

constexpr std::size_t most_points = 64;  // of a sweep: every point takes as long as a single run
constexpr std::size_t most_scenes = 2;
constexpr double most_vertices = 300;
constexpr double most_that_collide = 60;  // thick cloth compares all triangles with all others

// The number of runs, if the config is valid.
std::size_t points_of(const Json& document) {
  const Json* const sweep = value_at(document, "/sweep");
  if (sweep == nullptr || !sweep->is_object()) return 1;
  std::size_t points = 1;
  for (const auto& [pointer, values] : sweep->items())
    points = std::min(points * (values.is_array() ? std::max<std::size_t>(values.size(), 1) : 16),
                      most_points + 1);
  return points;
}

bool is_small(const RunConfig& run) {
  const Mesh& mesh = run.scene().mesh;
  const Solver& solver = run.scene().solver;
  const double cells = mesh.cells;
  const double rows = mesh.generator == Generator::tube ? mesh.height * cells / (6 * mesh.radius)
                      : mesh.generator == Generator::disc || mesh.generator == Generator::sphere
                          ? 6 * cells
                          : cells * mesh.height / mesh.width;
  const bool collides = std::ranges::any_of(
      run.scene().effects, [](const Effect& effect) { return effect.as<SelfCollision>() != nullptr; });
  const double finer = std::pow(4.0, mesh.refine.value_or(0));
  return finer * cells * std::max(1.0, rows) < (collides ? most_that_collide : most_vertices) &&
         solver.threads <= 2 && substeps_of(solver) * iterations_of(solver) <= 64;
}

void check_round_trip(const RunConfig& run) {
  Json settings = run.resolved();
  settings["name"] = "again";
  const Experiment again = experiment_of(settings, "resolved settings");
  require(again.runs.size() == 1, "resolved settings are one run");
  require(again.runs.front().resolved() == run.resolved(), "resolved settings resolve to themselves");
  require(identity_text(again.runs.front().resolved()) == identity_text(run.resolved()),
          "resolved settings have the same identity");
}

void check_steps(const RunConfig& run) try {
  const BuiltScene scene = build_scene(run.scene());
  require(scene.input.positions.allFinite(), "a scene starts at finite positions");
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (int step = 0; step < 2; ++step) {
    if (!simulation->step()) return;
    require(simulation->positions().allFinite(), "a step that did not diverge has finite positions");
  }
} catch (const ConfigError&) {
} catch (const MeshError&) {
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  ConfigProblems problems;
  const std::optional<Json> document = read_strict_json(text, problems);
  if (document && points_of(*document) > most_points) return 0;
  Experiment experiment;
  try {
    experiment = parse_experiment(text, "input");
  } catch (const ConfigError& error) {
    require(!error.problems().empty(), "a refusal states its problems");
    return 0;
  }
  require(!experiment.runs.empty(), "a valid config has a run");
  for (std::size_t i = 0; i < std::min(most_scenes, experiment.runs.size()); ++i) {
    const RunConfig& run = experiment.runs[i];
    check_round_trip(run);
    if (input_files(run).empty() && is_small(run)) check_steps(run);
  }
  return 0;
}

namespace {

// Changes that random_changes() does not make.
void change_structure(Json& document, test::Random& random) {
  const std::vector<test::Change> changes = test::random_changes(random);
  if (changes.empty()) return;
  const auto& [pointer, value] = changes.front();
  switch (random() % 5) {
    case 0: {
      Json& sweep = document["sweep"];
      if (!sweep.is_object()) sweep = Json::object();
      sweep[pointer] = {value, test::random_changes(random).empty() ? value : Json(1)};
      break;
    }
    case 1:
      document["expect"] = {
          {{"metric", "max_stretch"}, {"max", 2}, {"why", "so"}, {"where", {{pointer, value}}}}};
      break;
    case 2:
      document["because"][pointer] = "so";
      break;
    case 3:
      document[test::chance(random, 0.5) ? "accuracy" : "initial"][test::one_of(
          random, std::array{"after", "solver", "physical"})] = {pointer + "=" + value.dump()};
      break;
    case 4:
      document["cover"] = 1 + random() % 3;
      break;
  }
}

// Sets or removes a few settings of the config. If the text is no config, a minimal config is used instead.
std::string with_other_settings(std::string_view text, test::Random& random) {
  ConfigProblems problems;
  const std::optional<Json> read = read_strict_json(text, problems);
  Json document = read && read->is_object() ? *read : Json{{"name", "fuzz"}, {"mesh", {{"cells", 3}}}};
  try {
    if (test::chance(random, 0.2)) change_structure(document, random);
    if (test::chance(random, 0.2) && document.size() > 1)
      document.erase(std::next(document.begin(), static_cast<std::ptrdiff_t>(random() % document.size())));
    for (std::size_t count = 1 + random() % 2; count > 0; --count)
      for (auto& [pointer, value] : test::random_changes(random)) set_at(document, pointer, std::move(value));
  } catch (const Json::exception&) {  // the document has another type at this place
  }
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  test::Random random(seed);
  const std::size_t put_bytes =
      test::chance(random, 0.7) ? put(with_other_settings(text_of(data, size), random), data, max_size) : 0;
  return put_bytes > 0 ? put_bytes : LLVMFuzzerMutate(data, size, max_size);
}
