#include "experiments/campaign/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "bendlab/io/disk.hpp"
#include "bendlab/io/folder_lock.hpp"
#include "bendlab/scene/counted.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/folder.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/terminal/progress.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

int jobs_for(const std::vector<CampaignRun>& runs, int wanted) {
  if (wanted > 0) return wanted;
  std::int64_t threads = 1;
  for (const CampaignRun& run : runs)
    threads = std::max<std::int64_t>(threads, run.config->scene().solver.threads);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency() / threads));
}

/// For each run, the index of the first run with the same file. Two experiments with the same name may share
/// a run, which must be computed only once.
std::vector<std::size_t> first_of_equals(const std::vector<CampaignRun>& runs) {
  std::map<std::string, std::size_t> first;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunConfig& config = *runs[i].config;
    std::string what_names_the_file =
        fmt::format("{}\n{}", runs[i].experiment->name, identity_text(config.resolved()));
    for (const auto& [pointer, value] : config.point)
      what_names_the_file += fmt::format("\n{} {}", pointer, value.dump());
    for (const NamedFile& file : input_files(config))
      what_names_the_file += fmt::format("\n{}", file.path.string());
    result.push_back(first.try_emplace(what_names_the_file, i).first->second);
  }
  return result;
}

constexpr const char* failure_name = "run.failure";

// Writes why a run failed into the run's folder. Ignores write errors, because the reason is printed, too.
void keep_failure(const CampaignRun& run, const fs::path& out) try {
  const fs::path folder = run_folder(out, *run.experiment, *run.config);
  make_folder(folder);
  replace_file(folder / failure_name, run.error + "\n", Wait::no);
} catch (const std::exception&) {
}

void remove_failure(const fs::path& run_file) {
  std::error_code ignored;
  fs::remove(run_file.parent_path() / failure_name, ignored);
}

// Lets a run begin if it fits into the available memory together with all runs in progress. If no run is in
// progress, any run may begin.
class MemoryBudget {
 public:
  // Reserves memory for a run, as long as this object exists.
  class Reservation {
   public:
    Reservation(MemoryBudget& budget, double bytes) : budget_(budget), bytes_(bytes) {
      std::unique_lock lock(budget_.mutex_);
      budget_.released_.wait(
          lock, [&] { return budget_.in_use_ == 0 || budget_.in_use_ + bytes_ <= budget_.all_; });
      budget_.in_use_ += bytes_;
    }
    ~Reservation() {
      {
        const std::lock_guard lock(budget_.mutex_);
        budget_.in_use_ -= bytes_;
      }
      budget_.released_.notify_all();
    }
    Reservation(const Reservation&) = delete;
    Reservation& operator=(const Reservation&) = delete;

   private:
    MemoryBudget& budget_;
    double bytes_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable released_;
  const double all_ = available_memory();
  double in_use_ = 0;  // sums of whole bytes: exact
};

void execute(CampaignRun& run, const CampaignOptions& options, const RunControl& control) {
  try {
    run.outcome = execute_run(*run.experiment, *run.config, options.out, control);
    if (run.outcome->differs) run.exit_code = exit_failed;
    if (run.outcome->status == RunStatus::implausible && !run.experiment->allows(RunStatus::implausible))
      run.exit_code = exit_failed;
    if (run.outcome->status == RunStatus::diverged) run.exit_code = exit_numerical;
    if (run.outcome->status == RunStatus::interrupted) run.exit_code = stop_exit_code();
    if (!run.outcome->left) remove_failure(run.outcome->file);
  } catch (...) {
    const Failure failure = current_failure();
    run.exit_code = failure.exit_code;
    run.error = failure.message;
    keep_failure(run, options.out);
  }
}

// The order in which runs begin: the most work first, or the least work first.
std::vector<std::size_t> order_of(const std::vector<double>& works, bool short_first) {
  std::vector<std::size_t> order(works.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return short_first ? works[a] < works[b] : works[a] > works[b]; });
  return order;
}

// Gives the runs to the threads that compute them.
class Queue {
 public:
  explicit Queue(std::vector<std::size_t> order) : untried_(order.begin(), order.end()) {}

  /// The next run that no other process is computing; empty if no run is left. Waits if other processes are
  /// computing all runs that are left. `waiting` is called before the first wait with the number of runs.
  std::optional<std::size_t> next(const std::atomic<bool>& stop,
                                  const std::function<void(std::size_t)>& waiting) {
    constexpr auto pause = std::chrono::milliseconds(200);
    for (;; std::this_thread::sleep_for(pause)) {
      const std::lock_guard lock(mutex_);
      if (!untried_.empty()) return taken(untried_, untried_.begin());
      if (put_off_.empty()) return std::nullopt;
      const auto free =
          std::ranges::find_if(put_off_, [](const PutOff& run) { return !is_locked(run.folder); });
      if (free != put_off_.end()) return taken(put_off_, free).run;
      if (stop) return taken(put_off_, put_off_.begin()).run;
      if (!std::exchange(has_waited_, true)) waiting(put_off_.size());
    }
  }
  /// Another process is computing the run.
  void put_off(std::size_t run, fs::path folder) {
    const std::lock_guard lock(mutex_);
    put_off_.push_back({run, std::move(folder)});
  }

 private:
  struct PutOff {
    std::size_t run;
    fs::path folder;
  };
  template <class Run>
  static Run taken(std::deque<Run>& runs, typename std::deque<Run>::iterator at) {
    Run run = std::move(*at);
    runs.erase(at);
    return run;
  }

  std::mutex mutex_;
  std::deque<std::size_t> untried_;
  std::deque<PutOff> put_off_;
  bool has_waited_ = false;
};

}  // namespace

Shard shard_of(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
  const auto count = has_slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!has_slash || count.ec != std::errc{} || count.ptr != end || shard.index >= shard.count)
    throw UsageError(fmt::format("--shard: '{}' is not of the form i/n with 0 ≤ i < n, such as 0/8", text));
  return shard;
}

std::string failure_in(const fs::path& folder) {
  std::ifstream stream(folder / failure_name);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::vector<CampaignRun> plan_campaign(const std::vector<Experiment>& experiments, Shard shard) {
  std::vector<CampaignRun> runs;
  std::size_t position = 0;
  for (const Experiment& experiment : experiments)
    for (const RunConfig& config : experiment.runs)
      if (position++ % shard.count == shard.index)
        runs.push_back({.experiment = &experiment, .config = &config});
  return runs;
}

void run_campaign(std::vector<CampaignRun>& runs, const CampaignOptions& options,
                  const std::function<void(std::size_t index)>& on_ready) {
  keep_changes(options.out);
  const std::atomic<bool>& stop = options.stop ? *options.stop : stop_flag();
  const std::vector<std::size_t> executed_as = first_of_equals(runs);
  std::vector<double> works;
  for (std::size_t i = 0; i < runs.size(); ++i)
    works.push_back(executed_as[i] == i ? crude_work(*runs[i].config) : 0.0);
  MemoryBudget memory;
  Progress progress(works);
  Queue queue(order_of(works, options.short_first));
  std::mutex mutex;  // guards what follows
  std::set<std::pair<const Experiment*, std::string>> printed;
  std::vector<bool> over(runs.size(), false);
  std::size_t ready = 0;
  std::exception_ptr failure;  // thrown by on_ready

  const auto finish = [&](std::size_t index) {
    const CampaignRun& run = runs[index];
    progress.finish(index, run.outcome && !run.outcome->reused);
    const std::string& text = run.outcome ? run.outcome->message : run.error;
    const std::lock_guard lock(mutex);
    // If several runs have the same text, such as a remark on the mesh, only the first run prints the text.
    const bool implausible = run.outcome && run.outcome->status == RunStatus::implausible,
               expected = implausible && (run.exit_code == exit_ok || !options.tells_verdicts);
    if (!text.empty() && !expected && printed.emplace(run.experiment, text).second)
      progress.message(fmt::format("{}: {}", run_text(run), text));
    over[index] = true;
    for (; ready < runs.size(); ++ready) {
      const std::size_t source = executed_as[ready];
      if (!over[source]) break;
      if (source != ready) {
        runs[ready].outcome = runs[source].outcome;
        runs[ready].exit_code = runs[source].exit_code;
        runs[ready].error = runs[source].error;
      }
      progress.pause([&] { on_ready(ready); });
    }
  };

  const auto tell_wait = [&](std::size_t count) {
    progress.message(fmt::format("waiting for {} that other processes are computing", counted(count, "run")));
  };
  const auto work = [&] {
    while (const std::optional<std::size_t> next = queue.next(stop, tell_wait)) {
      const std::size_t index = *next;
      if (executed_as[index] != index) continue;
      const RunControl control{
          .stop = &stop,
          .progress = [&, index](double done_s, double total_s) { progress.update(index, done_s, total_s); },
          .minimal = options.minimal,
          .force = options.force || options.minimal,
          .checkpoint_interval_s = options.checkpoint_interval_s,
          .when_locked = WhenLocked::leave,
          .waiting =
              [&, index] {
                progress.message(
                    fmt::format("{}: waiting for a reference, which another process is computing",
                                run_text(runs[index])));
              }};
      const std::optional<Needs> needs = needs_of(*runs[index].config);
      const MemoryBudget::Reservation reservation(memory, needs ? std::round(needs->memory_bytes) : 0.0);
      if (!stop) execute(runs[index], options, control);
      if (runs[index].outcome && runs[index].outcome->left) {
        queue.put_off(index, runs[index].outcome->file.parent_path());
        runs[index].outcome.reset();
        continue;
      }
      try {
        finish(index);
      } catch (...) {  // stdout was closed: the other runs are computed all the same
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int job = 1; job < jobs_for(runs, options.jobs); ++job) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

int campaign_exit_code(const std::vector<CampaignRun>& runs) {
  if (stop_exit_code() != 0) return stop_exit_code();
  for (const int code : {exit_io, exit_mesh, exit_config, exit_numerical, exit_usage})
    if (std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.exit_code == code; }))
      return code;
  const bool failed =
      std::any_of(runs.begin(), runs.end(), [](const auto& run) { return run.exit_code != 0; });
  return failed ? exit_failed : exit_ok;
}

}  // namespace bendlab
