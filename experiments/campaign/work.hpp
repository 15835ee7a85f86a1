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

/// Computes the runs of the shard in `options`, the longest first. Then computes the runs that no process has
/// begun, and the unfinished runs of processes that died. Ends when every run is over or is being computed by
/// a living process. A process on another machine counts as living if its heartbeat (a file in the run's
/// folder) changes within `lease`. Returns every run of the plan.
std::vector<CampaignRun> work_on(const std::vector<Experiment>& experiments, const CampaignOptions& options,
                                 std::chrono::duration<double> lease = std::chrono::seconds(60));

/// The state of a run on disk.
struct RunState {
  enum class Kind { over, running, failed, interrupted, unreadable, waiting } kind = Kind::waiting;
  RunRecord record{};  ///< Part::state, if the run is over or interrupted
  std::string text{};  ///< the process that computes the run, or why the run failed
};

/// The runs in some folders, as on disk when this object was made.
class RunsOnDisk {
 public:
  /// `parents`: the parents of the runs' folders. `unreadable`: as in read_runs().
  RunsOnDisk(const std::set<std::filesystem::path>& parents,
             const std::function<void(const std::string&)>& unreadable);

  /// The state of the run `id` in its folder. Thread-safe.
  RunState state_of(const std::filesystem::path& folder, const std::string& id) const;

 private:
  std::unordered_map<std::string, RunRecord> found_;  // by folder: comparing paths is slow
};

}  // namespace bendlab
