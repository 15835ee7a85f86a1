#include "experiments/cli/shared_options.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "experiments/config/overrides.hpp"
#include "experiments/measures/metrics.hpp"
#include "experiments/run/errors.hpp"

namespace bendlab {

std::vector<Experiment> load_experiments(const std::vector<std::string>& files,
                                         std::vector<std::string> overrides,
                                         const std::vector<std::string>& axes) {
  for (const std::string& axis : axes) try {
      overrides.push_back(sweep_override(axis));
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--sweep: {}", error.what()));
    }
  std::vector<Experiment> experiments;
  std::string problems;
  for (const std::string& file : files) {
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

ConfigArguments::ConfigArguments(Command& command) {
  command.add(files, "CONFIG", "Config files (JSON)");
  command.add(overrides, "--set /POINTER=VALUE...",
              "Change a setting, such as /mesh/cells=64. If the config sweeps this setting, the value (or a "
              "list of values) replaces the swept values. Repeatable");
  command.add(axes, "--sweep /POINTER=VALUES...",
              "Vary one more setting, such as /bending/k=0.1,0.2. Repeatable");
}

void add_set(Command& command, std::vector<std::string>& overrides) {
  command.add(overrides, "--set /POINTER=VALUE...",
              "Change a setting of the config, such as /mesh/cells=64. Repeatable");
}

void add_jobs(Command& command, CampaignOptions& campaign) {
  command.add(campaign.jobs, "--jobs,-j",
              "Number of runs to compute at a time (default: number of cores / threads per run)", {1, 1024});
}

void add_checkpoint(Command& command, CampaignOptions& campaign) {
  command.add(
      campaign.checkpoint_interval_s, "--checkpoint",
      "Seconds between two checkpoints of a run, from which the run continues after a crash. "
      "Checkpoints take at most 1 % of a run's time. 0: write a checkpoint only when the run is stopped",
      not_negative);
}

void add_campaign(Command& command, CampaignOptions& campaign) {
  add_jobs(command, campaign);
  command.add(campaign.force, "--force",
              "Compute complete runs again; each old file stays until the new file replaces it");
  add_checkpoint(command, campaign);
}

}  // namespace bendlab
