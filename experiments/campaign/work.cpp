#include "experiments/campaign/work.hpp"

#include <algorithm>
#include <optional>
#include <system_error>
#include <thread>

#include "bendlab/io/claim.hpp"
#include "experiments/campaign/run_index.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Watches the owners of runs: the processes that are computing runs which this process left out.
class WatchedRuns {
 public:
  WatchedRuns(const std::vector<CampaignRun>& runs, std::chrono::duration<double> lease) : lease_(lease) {
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (runs[i].outcome && runs[i].outcome->left) {
        const fs::path folder = runs[i].outcome->file.parent_path();
        watched_.push_back({i, folder, heartbeat_in(folder)});
      }
  }

  /// Waits until it is known which owners live. Returns the runs without a living owner: these runs are over
  /// or have to be computed.
  std::vector<std::size_t> wait() {
    std::vector<std::size_t> free;
    const Clock::time_point begin = Clock::now();
    while (!watched_.empty() && !stop_flag()) {
      const bool late = Clock::now() - begin > lease_;
      std::erase_if(watched_, [&](const Watched& watched) {
        const std::string now = heartbeat_in(watched.folder);
        const bool lives = !now.empty() && now != watched.heartbeat;
        if (now.empty() || (late && !lives)) free.push_back(watched.run);
        return now.empty() || lives || late;
      });
      if (!watched_.empty()) std::this_thread::sleep_for(1s);
    }
    return free;
  }

 private:
  struct Watched {
    std::size_t run;
    fs::path folder;
    std::string heartbeat;
  };
  std::chrono::duration<double> lease_;
  std::vector<Watched> watched_;
};

// The run in a folder, if the run is over. (It may have ended after RunsOnDisk had read the folder.)
std::optional<RunRecord> ended_since(const fs::path& folder) try {
  const fs::path file = folder / "run.vtkhdf";
  if (!fs::exists(file)) return std::nullopt;
  RunRecord record = read_checked(file);
  return is_over(record.status) ? std::optional(std::move(record)) : std::nullopt;
} catch (const std::exception&) {  // not a run file
  return std::nullopt;
}

}  // namespace

std::vector<CampaignRun> work_on(const std::vector<Experiment>& experiments, const CampaignOptions& options,
                                 std::chrono::duration<double> lease) {
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  CampaignOptions part = options;
  part.when_owned = WhenOwned::leave;
  run_campaign(runs, part, [](std::size_t) {});
  part.when_owned = WhenOwned::leave_living;
  for (;;) {
    const std::vector<std::size_t> free = WatchedRuns(runs, lease).wait();
    if (free.empty() || stop_flag()) return runs;
    std::vector<CampaignRun> again;
    for (const std::size_t run : free)
      again.push_back({.experiment = runs[run].experiment, .config = runs[run].config});
    run_campaign(again, part, [](std::size_t) {});
    const auto is_left = [](const CampaignRun& run) { return run.outcome && run.outcome->left; };
    const bool all_left = std::ranges::all_of(again, is_left);
    for (std::size_t i = 0; i < free.size(); ++i) runs[free[i]] = again[i];
    if (all_left) return runs;  // the owners live, but their heartbeats do not change: they may be suspended
  }
}

RunsOnDisk::RunsOnDisk(const std::set<fs::path>& parents,
                       const std::function<void(const std::string&)>& unreadable) {
  for (const fs::path& parent : parents) {
    std::error_code none;
    if (!fs::is_directory(parent, none)) continue;
    for (RunRecord& run : read_runs(parent, unreadable, Part::state))
      found_.emplace(run.file.parent_path().string(),
                     std::move(run));  // of a folder's files, the first is finished
  }
}

RunState RunsOnDisk::state_of(const fs::path& folder, const std::string& id) const {
  using Kind = RunState::Kind;
  const auto known = found_.find(folder.string());
  const RunRecord* const found = known == found_.end() ? nullptr : &known->second;
  if (found && is_over(found->status) && found->id == id) return {Kind::over, *found};
  if (!found && !fs::exists(folder)) return {};
  if (std::string owner = owner_of(folder); !owner.empty())
    return {.kind = Kind::running, .text = std::move(owner)};
  if (auto record = ended_since(folder); record && record->id == id) return {Kind::over, *std::move(record)};
  if (std::string failure = failure_in(folder); !failure.empty())
    return {.kind = Kind::failed, .text = std::move(failure)};
  if (found && !is_over(found->status)) return {Kind::interrupted, *found};
  const bool has_file = found || fs::exists(folder / "run.vtkhdf") || !unfinished_files(folder).empty();
  return {.kind = has_file ? Kind::unreadable : Kind::waiting};
}

}  // namespace bendlab
