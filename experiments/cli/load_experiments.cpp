#include "experiments/cli/commands.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "experiments/config/overrides.hpp"
#include "experiments/measures/metrics.hpp"
#include "experiments/run/errors.hpp"

namespace bendlab {

std::vector<Experiment> load_experiments(const ConfigArguments& configs) {
  std::vector<std::string> overrides = configs.overrides;
  for (const std::string& axis : configs.axes) try {
      overrides.push_back(sweep_override(axis));
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--sweep: {}", error.what()));
    }
  std::vector<Experiment> experiments;
  std::string problems;
  for (const std::filesystem::path& file : configs.files) {
    try {
      experiments.push_back(load_experiment(file, overrides));
      check_metrics(experiments.back());
    } catch (const ConfigError& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!problems.empty()) throw ConfigsError(problems);
  return experiments;
}

}  // namespace bendlab
