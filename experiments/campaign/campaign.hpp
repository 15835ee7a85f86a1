// Computes the runs of one or more experiments, several at a time on all cores.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/run_labels.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// One run of a campaign and its outcome.
struct CampaignRun {
  const Experiment* experiment = nullptr;
  const RunConfig* config = nullptr;
  std::optional<RunOutcome> outcome{};  ///< absent: it failed, or was not started because of a signal
  int exit_code = 0;
  std::string error{};  ///< why the run failed; empty if it did not

  bool started() const { return outcome.has_value() || !error.empty(); }
};
inline std::string place_text(const CampaignRun& run) {
  return place_text(*run.experiment, *run.config);
}
inline std::string run_text(const CampaignRun& run) {
  return run_text(*run.experiment, *run.config);
}

/// Part `index` of `count` parts of a campaign, 0 ≤ index < count.
struct Shard {
  std::size_t index = 0, count = 1;
};

struct CampaignOptions {
  std::filesystem::path out = "results";
  int jobs = 0;              ///< runs at a time; 0: number of cores / threads per run
  bool short_first = false;  ///< begin with the least work instead of the most (crude_work())
  bool force = false;        ///< compute complete runs again
  bool minimal = false;      ///< leave out effects that cannot act; implies force
  double checkpoint_interval_s = RunControl{}.checkpoint_interval_s;
  /// For work together with other processes: first the runs of this shard are computed, then all other runs.
  /// Each computed run is reported on stderr. If a run fails, the reason is written into the run's folder.
  std::optional<Shard> shard{};
  WhenOwned when_owned = WhenOwned::wait;
  bool tells_verdicts = true;               ///< report each implausible run on stderr when it is over
  const std::atomic<bool>* stop = nullptr;  ///< true stops the campaign, as a signal does; null: stop_flag()
};

/// The shard of each run, such that all shards have about equal work: the run with the most work goes to the
/// emptiest shard, then the run with the second most, and so on.
std::vector<std::size_t> shards_of(const std::vector<double>& works, std::size_t count);

/// The text in a run's folder that says why the run failed (with CampaignOptions::shard), or "".
std::string failure_in(const std::filesystem::path& folder);

/// The runs of all experiments, in sweep order.
std::vector<CampaignRun> plan_campaign(const std::vector<Experiment>& experiments);

/// Computes the runs, those with the most work first, as many at a time as fit into memory. A run that fails
/// does not stop the others. `on_ready` is called with the index of every run in sweep order, by one thread
/// at a time, as soon as this run and all runs before it are over. After a stop signal each current run ends
/// with its next frame, and no further run begins.
void run_campaign(std::vector<CampaignRun>& runs, const CampaignOptions& options,
                  const std::function<void(std::size_t index)>& on_ready);

/// The most serious exit code of the runs; 0 if every run is complete. From serious to mild: signal, I/O,
/// mesh, config, numerical, usage, other.
int campaign_exit_code(const std::vector<CampaignRun>& runs);

}  // namespace bendlab
