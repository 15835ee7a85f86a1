// No bending model without its config, and none that the comparisons forget.
#include <filesystem>
#include <set>

#include "bendlab/bending/model.hpp"
#include "experiments/config.hpp"
#include "tests/catch.hpp"

using namespace bendlab;

namespace {

const std::filesystem::path folder = std::filesystem::path(BENDLAB_SOURCE_DIR) / "configs" / "models";

}  // namespace

TEST_CASE("every registered model has a config that runs it with its own settings") {
  for (const BendingModel* model : bending_models()) {
    const std::filesystem::path file = folder / (std::string(model->name) + ".json");
    INFO(file);
    REQUIRE(std::filesystem::exists(file));
    const Experiment experiment = load_experiment(file);
    CHECK(experiment.name == "model_" + std::string(model->name));
    for (const RunConfig& run : experiment.runs) CHECK(run.bending_model() == model->name);
  }
}

TEST_CASE("the hanging sheet and the cantilever run every registered model") {
  for (const char* name : {"hanging_sheet", "cantilever"}) {
    std::set<std::string> models;
    for (const RunConfig& run : load_experiment(folder / (std::string(name) + ".json")).runs)
      models.insert(run.bending_model());
    for (const BendingModel* model : bending_models()) {
      INFO(name << " lacks " << model->name);
      CHECK(models.count(std::string(model->name)) == 1);
    }
  }
}
