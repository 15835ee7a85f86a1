// Every bending model has a config, and the comparisons include every model.
#include <filesystem>
#include <set>

#include "bendlab/bending/model.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::model_configs_test {
namespace {

const std::filesystem::path configs = std::filesystem::path(places::source) / "configs",
                            folder = configs / "models";

bool joins_rings(const std::filesystem::path& file) {  // only spring models have rings
  return file.stem().string().starts_with("rings");
}

}  // namespace

TEST_CASE("every registered model has a config that runs it with its own settings") {
  for (const BendingKind* model : bending_models()) {
    const std::filesystem::path file = folder / (std::string(model->name) + ".json");
    INFO(file);
    REQUIRE(std::filesystem::exists(file));
    const Experiment experiment = load_experiment(file);
    CHECK(experiment.name == "model_" + std::string(model->name));
    for (const RunConfig& run : experiment.runs) CHECK(run.scene().bending.model.name() == model->name);
  }
}

TEST_CASE("the hanging sheet and the cantilever run every registered model that pbd can simulate") {
  for (const char* name : {"hanging_sheet", "cantilever"}) {
    std::set<std::string> models;
    for (const RunConfig& run : load_experiment(folder / (std::string(name) + ".json")).runs)
      models.emplace(run.scene().bending.model.name());
    for (const BendingKind* model : bending_models()) {
      INFO(name << " lacks " << model->name);
      CHECK(models.count(std::string(model->name)) == (model->needs_energy ? 0 : 1));  // pbd refuses these
    }
  }
}

TEST_CASE("every hard case runs every model of pbd in both precisions and checks every step") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(configs / "stability")) {
    const Experiment experiment = load_experiment(entry.path());
    INFO(entry.path());
    CHECK(experiment.name == "stability_" + entry.path().stem().string());
    std::set<std::pair<std::string, ChosenPrecision>> combinations;
    for (const RunConfig& run : experiment.runs) {
      CHECK(run.settings().output.measures == std::vector<std::string>{"stability"});
      CHECK(run.scene().mesh.cells >= (run.scene().pins.vertices.empty() ? 16 : 32));
      combinations.emplace(run.scene().bending.model.name(), run.scene().solver.precision);
    }
    for (const BendingKind* model : bending_models())
      for (const ChosenPrecision precision :
           {ChosenPrecision::single_precision, ChosenPrecision::double_precision}) {
        INFO("lacks " << model->name << " in "
                      << (precision == ChosenPrecision::single_precision ? "single" : "double"));
        CHECK((joins_rings(entry.path()) || model->needs_energy ||
               combinations.count({std::string(model->name), precision}) == 1));
      }
    ++files;
  }
  CHECK(files > 10);
}

}  // namespace bendlab::model_configs_test
