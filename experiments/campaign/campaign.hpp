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

/// Part `index` of `count` parts of a campaign: the runs whose position in sweep order, modulo `count`, is
/// `index`.
struct Shard {
  std::size_t index = 0, count = 1;
};

/// "2/8" → the third of eight shards. Throws UsageError unless the text is i/n with 0 ≤ i < n.
Shard shard_of(const std::string& text);

struct CampaignOptions {
  std::filesystem::path out = "results";
  int jobs = 0;              ///< runs at a time; 0: number of cores / threads per run
  bool short_first = false;  ///< begin with the least work instead of the most (crude_work())
  bool force = false;        ///< compute complete runs again
  bool minimal = false;      ///< leave out effects that cannot act; implies force
  double checkpoint_interval_s = RunControl{}.checkpoint_interval_s;
  bool tells_verdicts = true;               ///< report each implausible run on stderr when it is over
  const std::atomic<bool>* stop = nullptr;  ///< true stops the campaign, as a signal does; null: stop_flag()
};

/// The text in a run's folder that says why the run failed, or "".
std::string failure_in(const std::filesystem::path& folder);

/// The runs of all experiments that belong to the shard, in sweep order.
std::vector<CampaignRun> plan_campaign(const std::vector<Experiment>& experiments, Shard shard = {});

/// Computes the runs, those with the most work first, as many at a time as fit into memory. Runs that another
/// process is computing are put off until the end: then this process waits until they are over, and computes
/// those whose owner has died. A run that fails does not stop the others; the reason is written into the
/// run's folder. `on_ready` is called with the index of every run in sweep order, by one thread at a time, as
/// soon as this run and all runs before it are over. After a stop signal each current run ends with its next
/// frame, and no further run begins.
void run_campaign(std::vector<CampaignRun>& runs, const CampaignOptions& options,
                  const std::function<void(std::size_t index)>& on_ready);

/// The most serious exit code of the runs; 0 if every run is complete. From serious to mild: signal, I/O,
/// mesh, config, numerical, usage, other.
int campaign_exit_code(const std::vector<CampaignRun>& runs);

}  // namespace bendlab
