// Options that several commands have.
#pragma once

#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"
#include "experiments/cli/command.hpp"

namespace bendlab {

/// The experiments of configs. `overrides` are "/pointer=value" texts. `axes` are "/pointer=value,value"
/// texts, added to the sweeps. Throws one ConfigsError with the problems of all configs.
std::vector<Experiment> load_experiments(const std::vector<std::string>& files,
                                         std::vector<std::string> overrides = {},
                                         const std::vector<std::string>& axes = {});

/// CONFIG, --set and --sweep
struct ConfigArguments {
  std::vector<std::string> files, overrides, axes;

  explicit ConfigArguments(Command& command);
  std::vector<Experiment> experiments() const { return load_experiments(files, overrides, axes); }
};

/// --set of a command with one config
void add_set(Command& command, std::vector<std::string>& overrides);

/// --jobs
void add_jobs(Command& command, CampaignOptions& campaign);
/// --checkpoint
void add_checkpoint(Command& command, CampaignOptions& campaign);
/// --jobs, --force and --checkpoint
void add_campaign(Command& command, CampaignOptions& campaign);

}  // namespace bendlab
