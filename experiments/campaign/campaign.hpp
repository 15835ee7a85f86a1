// Many runs side by side: the points of one or more experiments, over the cores.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/campaign/run_labels.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/forecast.hpp"
#include "experiments/run/run_control.hpp"
#include "experiments/run/run_outcome.hpp"

namespace bendlab {

/// One run of a campaign and what became of it.
struct CampaignRun {
  const Experiment* experiment = nullptr;
  const RunConfig* config = nullptr;
  std::optional<RunOutcome> outcome{};  ///< absent: it failed, or was not started because of a signal
  int exit_code = 0;
  std::string error{};  ///< why it failed, empty if it did not

  bool started() const { return outcome.has_value() || !error.empty(); }
};
inline std::string place_text(const CampaignRun& run) {
  return place_text(*run.experiment, *run.config);
}
inline std::string run_text(const CampaignRun& run) {
  return run_text(*run.experiment, *run.config);
}

/// A part of a campaign: the `index`-th of `count`.
struct Shard {
  std::size_t index = 0, count = 1;
};

struct CampaignOptions {
  std::filesystem::path out = "results";
  int jobs = 0;              ///< runs side by side; 0: cores / the threads that a run takes
  bool short_first = false;  ///< the runs that are expected to be short first, instead of the long ones
  bool force = false;        ///< compute complete runs again
  bool minimal = false;      ///< without effects that cannot act; implies force
  double checkpoint_interval_s = RunControl{}.checkpoint_interval_s;
  /// Together with other processes: the runs of the shard first, then the others. Each run that is computed
  /// is told on stderr, and why one failed is kept in its folder.
  std::optional<Shard> shard{};
  WhenOwned when_owned = WhenOwned::wait;
  bool tells_verdicts = true;               ///< each implausible run on stderr, when it is over
  const std::atomic<bool>* stop = nullptr;  ///< set: as after a stop signal; null: that is stop_flag()
};

/// CPU time that a run is expected to take, s (forecast.hpp).
double expected_cpu_s(const RunConfig& config);

/// For each run the shard that it belongs to, so that all take about as long: the longest run goes to the
/// emptiest shard, then the next one.
std::vector<std::size_t> shards_of(const std::vector<double>& expected_s, std::size_t count);

/// Why a run failed in a process that worked with others: a text in its folder; empty if there is none.
std::string failure_in(const std::filesystem::path& folder);

/// Every run of every experiment, in sweep order.
std::vector<CampaignRun> plan_campaign(const std::vector<Experiment>& experiments);

/// What runs need together.
struct Needs {
  double cpu_s = 0, disk_bytes = 0;
  double most_memory_bytes = 0;  ///< of the largest

  void add(const Forecast& run);
};

/// Executes the runs, the ones expected to be long first, side by side as far as they fit into memory; a run
/// that fails does not stop the others.
/// `on_ready` is called with the index of every run in sweep order, by one thread at a time, as soon as it
/// and those before it are over. A stop signal ends the runs after their current frame and starts no other.
void run_campaign(std::vector<CampaignRun>& runs, const CampaignOptions& options,
                  const std::function<void(std::size_t index)>& on_ready);

/// 0 if every run is complete, else the gravest of their exit codes: signal, I/O, mesh, config, numerical,
/// other.
int campaign_exit_code(const std::vector<CampaignRun>& runs);

}  // namespace bendlab
