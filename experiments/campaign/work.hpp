// Many processes, on one machine or on many that share a disk, compute the runs of one plan together.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/campaign.hpp"
#include "experiments/campaign/plan_file.hpp"

namespace bendlab {

/// Computes the runs of the options' shard, longest first, then those that nobody has begun or that a dead
/// process left behind. Ends when every run is over, or is computed by a process that lives: a process on
/// another machine does if its heartbeat changes within the lease. Returns every run of the plan.
std::vector<CampaignRun> work_on(const std::vector<Experiment>& experiments, const CampaignOptions& options,
                                 std::chrono::duration<double> lease = std::chrono::seconds(60));

/// What has become of a planned run.
struct PlannedState {
  enum class Kind { over, running, failed, interrupted, waiting } kind = Kind::waiting;
  RunStatus status = RunStatus::running;  ///< of one that is over
  std::string text;                       ///< who computes it, or why it failed
  double wall_s = 0, cpu_s = 0;           ///< of one that is over
};

/// The run of a folder that ended while others were read; nothing if none did.
std::optional<RunRecord> ended_since(const std::filesystem::path& folder);

/// States of a plan's runs, in its order. `unreadable` as in read_runs().
std::vector<PlannedState> states_of(const PlanOverview& plan,
                                    const std::function<void(const std::string&)>& unreadable);

}  // namespace bendlab
