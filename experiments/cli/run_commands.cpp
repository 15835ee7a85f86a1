#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <stdexcept>
#include <system_error>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "experiments/campaign/run_labels.hpp"
#include "experiments/campaign/run_times.hpp"
#include "experiments/campaign/runs_on_disk.hpp"
#include "experiments/campaign/sweep_file.hpp"
#include "experiments/cli/collected_texts.hpp"
#include "experiments/cli/look_before.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/cli/shared_options.hpp"
#include "experiments/config/in_parallel.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// Throws if the results can't be written, before anything is computed.
void check_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && access(folder.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
  if (error)
    throw RunFileError(fmt::format("results can't be written to '{}': {}. Name another folder with --out",
                                   folder.string(), error.message()));
}

/// Memory and disk space of several runs.
class TotalNeeds {
 public:
  void add(const Needs& run) {
    most_memory_bytes_ = std::max(most_memory_bytes_, run.memory_bytes);
    disk_bytes_ += run.disk_bytes;
  }
  bool are_large() const { return std::max(most_memory_bytes_, disk_bytes_) >= 1e9; }
  /// "up to 1.2 GB of memory for a run, 400 MB of disk"
  std::string text() const {
    return fmt::format("up to {} of memory for a run, {} of disk", bytes_text(most_memory_bytes_),
                       bytes_text(disk_bytes_));
  }

 private:
  double most_memory_bytes_ = 0, disk_bytes_ = 0;
};

/// Prints the needs of the runs on stderr, if the needs are large. (`plan` always prints them.)
void print_large_needs(const std::vector<CampaignRun>& runs) {
  TotalNeeds total;
  for (const CampaignRun& run : runs)
    if (const std::optional<Needs> needs = needs_of(*run.config)) total.add(*needs);
  if (total.are_large())
    print_text(stderr, "bendlab: {}: {}, if no run is complete yet\n", counted(runs.size(), "run"),
               total.text());
}

}  // namespace

int run_and_report(const std::vector<Experiment>& experiments, CampaignOptions options, Report report,
                   bool strict, Shard shard) {
  if (const KnownBefore known = strict ? look_before(experiments, true) : KnownBefore{};
      known.exit_code != exit_ok) {
    return known.exit_code;
  } else if (known.warnings > 0) {
    print_text(stderr, "bendlab: nothing was computed, because --strict turns these warnings into errors\n");
    return exit_failed;
  }
  const std::vector<SweepFile> sweeps = sweep_files(options.out, experiments);  // before anything is created
  check_writable(options.out);
  write(sweeps);
  catch_stop_signals();
  std::vector<CampaignRun> runs = plan_campaign(experiments, shard);
  print_large_needs(runs);
  std::vector<CampaignRun> of_experiment;
  options.tells_verdicts = report != Report::tables;  // experiment_text() prints each kind once
  bool first = true;
  run_campaign(runs, options, [&](std::size_t index) {
    if (runs[index].started()) of_experiment.push_back(runs[index]);
    if (report == Report::json && runs[index].started()) print_text("{}\n", json_text(run_json(runs[index])));
    if (report == Report::explanations && runs[index].started())
      print_text("{}\n", explain_text(runs[index]));
    const bool last = index + 1 == runs.size() || runs[index + 1].experiment != runs[index].experiment;
    if (last && !of_experiment.empty()) {
      if (report == Report::json || report == Report::explanations) tell_warnings(of_experiment);
      if (report == Report::tables) print_text("{}{}", first ? "" : "\n", experiment_text(of_experiment));
      if (report == Report::lines) print_text("{}", experiment_line(of_experiment));
      first = false;
    }
    if (last) of_experiment.clear();
    std::fflush(stdout);
  });

  if (const int code = stop_exit_code(); code != 0) {
    const auto complete = std::ranges::count_if(
        runs, [](const CampaignRun& run) { return run.outcome && is_whole(run.outcome->status); });
    print_text(stderr,
               "bendlab: stopped; {} of {} complete; the same command, run again, computes the other runs\n",
               complete, counted(runs.size(), "run"));
    return code;
  }
  const int code = campaign_exit_code(runs);
  const bool warned = strict && !collected_warnings(runs).empty();
  return code == exit_ok && (warned || !expectations_hold(runs)) ? int{exit_failed} : code;
}

namespace {

/// "complete", "implausible", "diverged", "running", "failed", "interrupted", "unreadable" or "missing".
std::string name_of(const RunState& state) {
  constexpr std::array names = {"over", "running", "failed", "interrupted", "unreadable", "missing"};
  return state.kind == RunState::Kind::over ? to_string(state.record.status)
                                            : names.at(static_cast<std::size_t>(state.kind));
}

/// The name, and how many frames an unfinished run has.
std::string text_of(const RunState& state) {
  const bool unfinished = state.kind == RunState::Kind::interrupted ||
                          (state.kind == RunState::Kind::over && !is_whole(state.record.status));
  return name_of(state) + (unfinished ? ", " + counted(state.record.frames, "frame") : "");
}

/// What is known about a run without computing it.
struct KnownRun {
  std::string id;
  fs::path folder;
  RunState state;
  std::optional<Needs> needs;
  double took_s = 0;                       ///< CPU time that the run took; 0: the run is not over
  std::optional<RunTimes::Expected> time;  ///< of a run that is not over

  bool over() const { return state.kind == RunState::Kind::over; }
};

std::vector<KnownRun> look_at_runs(const Experiment& experiment, const fs::path& out) {
  const RunsOnDisk on_disk({out / experiment.name}, [](const std::string&) {});
  std::vector<KnownRun> known(experiment.runs.size());
  in_parallel(known.size(), 200, [&](std::size_t i) {
    const RunConfig& config = experiment.runs[i];
    auto& [id, folder, state, needs, took_s, time] = known[i];
    id = run_id(config);
    folder = run_folder(out, experiment, config, id);
    state = on_disk.state_of(folder, id);
    if (state.kind == RunState::Kind::over) took_s = state.record.cpu_s;
    needs = needs_of(config);
  });
  RunTimes times;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i].over() && is_whole(known[i].state.record.status) && known[i].took_s > 0)
      times.add(experiment.runs[i], known[i].took_s);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i].over()) known[i].time = times.expected(experiment.runs[i]);
  return known;
}

Json known_run_json(const Experiment& experiment, const RunConfig& config, const KnownRun& run) {
  Json line = {
      {"experiment", experiment.name}, {"point", point_json(config)},   {"id", run.id},
      {"state", text_of(run.state)},   {"folder", run.folder.string()}, {"config", config.resolved()}};
  if (!run.state.reason.empty()) line["reason"] = run.state.reason;
  if (run.needs)
    line["needs"] = {{"memory_bytes", run.needs->memory_bytes}, {"disk_bytes", run.needs->disk_bytes}};
  if (run.time) line["expected"] = {{"cpu_s", run.time->cpu_s}, {"finished_runs", run.time->finished}};
  return line;
}

/// The CPU time of the runs that are left, estimated from finished runs.
std::string time_text(const std::vector<KnownRun>& runs) {
  double cpu_s = 0;
  std::size_t left = 0, told = 0;
  for (const KnownRun& run : runs) {
    left += !run.over();
    if (run.time) cpu_s += run.time->cpu_s, ++told;
  }
  if (told == 0) return "CPU time unknown until a run is finished";
  const std::string by = "estimated from finished runs";
  return told == left ? fmt::format("about {} of CPU time {}", duration_text(cpu_s), by)
                      : fmt::format("about {} of CPU time {} for {} of {}", duration_text(cpu_s), by, told,
                                    counted(left, "run"));
}

/// A few lines about a cover: the number of combinations of values in its runs, and the missing combinations.
/// Empty for a sweep without cover.
std::string cover_text(const Covered& cover) {
  if (cover.strength == 0) return "";
  std::string text =
      fmt::format("covers {} of {} combinations of the values of any {}\n", cover.tuples - cover.missing,
                  cover.tuples, counted(cover.strength, "swept setting"));
  constexpr std::size_t most_listed = 5;
  for (std::size_t i = 0; i < std::min(cover.refused.size(), most_listed); ++i)
    text += fmt::format("left out, because no run can have these values together: {}\n", cover.refused[i]);
  if (cover.refused.size() > most_listed)
    text += fmt::format("and {} more\n", cover.refused.size() - most_listed);
  return text;
}

struct RunCommand : Command {
  ConfigArguments configs{*this};
  CampaignOptions campaign;
  std::string shard;
  bool explain = false, strict = false;

  RunCommand() {
    add_campaign(*this, campaign);
    add(campaign.out, "--out", "Folder for the results");
    add(shard, "--shard i/n",
        "Compute only part i of n, 0 ≤ i < n: the runs whose position in the sweep, modulo n, is i");
    add(campaign.minimal, "--minimal",
        "Leave out effects that cannot act, and check that no bit of the result changes");
    add(explain, "--explain",
        "Instead of the tables of results, print what a step consists of: each pass (part of a step) "
        "with its purpose, its time, and how much it changed. Not with --json");
    add(strict, "--strict",
        "Treat warnings as errors; if there are warnings before the runs begin, nothing is computed");
    add(json, "--json", "Print one JSON object per run to stdout. Not with --explain");
  }

  int run() override {
    if (json && explain) throw UsageError("--json excludes --explain");
    const Report report = json ? Report::json : explain ? Report::explanations : Report::tables;
    return run_and_report(configs.experiments(), campaign, report, strict,
                          shard.empty() ? Shard{} : shard_of(shard));
  }
};

struct PlanCommand : Command {
  ConfigArguments configs{*this};
  fs::path out = "results";

  PlanCommand() {
    add(out, "--out", "Folder of the results");
    add(json, "--json", "Print one JSON object per run");
  }
  int run() override;
};

int PlanCommand::run() {
  for (const Experiment& experiment : configs.experiments()) {
    const std::vector<KnownRun> known = look_at_runs(experiment, out);
    if (json) {
      for (std::size_t i = 0; i < known.size(); ++i)
        print_text("{}\n", json_text(known_run_json(experiment, experiment.runs[i], known[i])));
      continue;
    }
    std::vector<std::string> headings = axis_headings(experiment);
    headings.insert(headings.end(), {"id", "state", "CPU time", "memory", "disk"});
    Table table(headings);
    std::size_t over = 0;
    std::map<std::string, std::size_t> count;  // of runs, by state
    std::string reasons;
    TotalNeeds left;
    for (std::size_t i = 0; i < known.size(); ++i) {
      const KnownRun& run = known[i];
      ++count[name_of(run.state)];
      over += run.over();
      if (!run.over() && run.needs) left.add(*run.needs);
      if (!run.state.reason.empty())
        reasons +=
            fmt::format("failed: {}: {}\n", run_text(experiment, experiment.runs[i]), run.state.reason);
      std::vector<std::string> cells = axis_cells(experiment, experiment.runs[i]);
      cells.insert(cells.end(), {run.id, text_of(run.state),
                                 run.over() ? duration_text(run.took_s)
                                 : run.time ? fmt::format("about {} (by {})", duration_text(run.time->cpu_s),
                                                          counted(run.time->finished, "run"))
                                            : "-",
                                 run.needs ? bytes_text(run.needs->memory_bytes) : "-",
                                 run.needs ? bytes_text(run.needs->disk_bytes) : "-"});
      table.add_row(std::move(cells));
    }
    std::vector<std::string> counts;
    for (const auto& [name, runs] : count) counts.push_back(fmt::format("{} {}", runs, name));
    print_text("{}: {}, {}; {}\n{}\n{}{}\n", experiment.name, counted(known.size(), "run"),
               fmt::join(counts, ", "),
               over == known.size() ? "no run is left to compute"
                                    : fmt::format("left to compute: {}, {}", time_text(known), left.text()),
               cover_text(experiment.cover), table.text(), reasons);
  }
  return exit_ok;
}

struct ValidateCommand : Command {
  ConfigArguments configs{*this};
  bool strict = false;

  ValidateCommand() {
    add(strict, "--strict",
        "Build the scene of every run, and treat warnings that are known before the first step as "
        "errors");
  }
  int run() override;
};

int ValidateCommand::run() {
  const std::vector<Experiment> experiments = configs.experiments();
  const KnownBefore known = look_before(experiments, strict);
  if (known.exit_code != exit_ok) return known.exit_code;
  if (strict && known.warnings > 0) return exit_failed;
  for (const Experiment& experiment : experiments)
    print_text("{}: {} ({})\n{}", coloured("ok", Colour::green, stdout), experiment.source.string(),
               counted(experiment.runs.size(), "run"), cover_text(experiment.cover));
  return exit_ok;
}

}  // namespace

extern const CommandKind run_command{
    "run", "Compute the runs of the configs, except the runs that are complete",
    "bendlab run configs/plain/first.json --set /mesh/cells=24 --out results/try", make<RunCommand>};
extern const CommandKind plan_command{"plan",
                                      "List the runs of the configs: swept values, id, state, memory, disk, "
                                      "and time estimated from finished runs",
                                      "bendlab plan configs/plain/first.json", make<PlanCommand>};
extern const CommandKind validate_command{"validate", "Check configs and report every problem",
                                          "bendlab validate configs/recommended.json", make<ValidateCommand>};

}  // namespace bendlab
