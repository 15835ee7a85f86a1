// Many processes, on one machine or on many that share a disk, compute the runs of one plan together.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/campaign/campaign.hpp"

namespace bendlab {

/// Computes the runs of the options' shard, longest first, then those that nobody has begun or that a dead
/// process left behind. Ends when every run is over, or is computed by a process that lives: a process on
/// another machine does if its heartbeat changes within the lease. Returns every run of the plan.
std::vector<CampaignRun> work_on(const std::vector<Experiment>& experiments, const CampaignOptions& options,
                                 std::chrono::duration<double> lease = std::chrono::seconds(60));

/// What has become of a run.
struct RunState {
  enum class Kind { over, running, failed, interrupted, unreadable, waiting } kind = Kind::waiting;
  RunRecord record{};  ///< Part::state of one that is over or interrupted
  std::string text{};  ///< who computes it, or why it failed
};

/// The runs that lie in some folders.
class RunsOnDisk {
 public:
  /// `parents`: those of runs' folders. `unreadable` as in read_runs().
  RunsOnDisk(const std::set<std::filesystem::path>& parents,
             const std::function<void(const std::string&)>& unreadable);

  /// Of the run `id` in its folder. Any thread.
  RunState state_of(const std::filesystem::path& folder, const std::string& id) const;

 private:
  std::unordered_map<std::string, RunRecord> found_;  // by folder: comparing paths is slow
};

}  // namespace bendlab
