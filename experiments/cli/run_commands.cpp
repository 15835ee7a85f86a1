#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <unordered_map>

#include "bendlab/io/claim.hpp"
#include "experiments/campaign/errors.hpp"
#include "experiments/campaign/plan_file.hpp"
#include "experiments/campaign/run_index.hpp"
#include "experiments/campaign/run_labels.hpp"
#include "experiments/campaign/sweep_file.hpp"
#include "experiments/campaign/work.hpp"
#include "experiments/cli/child_program.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/explain.hpp"
#include "experiments/cli/load_experiments.hpp"
#include "experiments/cli/look_before.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/config/counted.hpp"
#include "experiments/config/in_parallel.hpp"
#include "experiments/config/json_text.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/forecast.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// Says once, before anything is computed, that the results can't be kept.
void check_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && access(folder.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
  if (error)
    throw RunFileError(fmt::format("results can't be written to '{}': {}. Name another folder with --out",
                                   folder.string(), error.message()));
}

/// What runs need: "about 3 min of CPU time, up to 1.2 GB of memory for a run, 400 MB of disk".
std::string needs_text(const Needs& needs) {
  return fmt::format("about {} of CPU time, up to {} of memory for a run, {} of disk",
                     duration_text(needs.cpu_s), bytes_text(needs.most_memory_bytes),
                     bytes_text(needs.disk_bytes));
}

/// Says on stderr what the runs need if that is much. (`plan` always says it.)
void tell_large_needs(const std::vector<CampaignRun>& runs) {
  constexpr double long_s = 60, large_bytes = 1e9;
  Needs needs;
  for (const CampaignRun& run : runs)
    if (const std::optional<Forecast> of_run = forecast(*run.config)) needs.add(*of_run);
  if (needs.cpu_s < long_s && needs.most_memory_bytes < large_bytes && needs.disk_bytes < large_bytes) return;
  print_text(stderr, "bendlab: {}: {}, if none is there yet\n", counted(runs.size(), "run"),
             needs_text(needs));
}

/// How the runs are reported on stdout.
enum class Report { tables, lines, json, explanations };

/// Runs them; prints an experiment as soon as its last run is over, or each run as a line of JSON. Runs that
/// were not started because of a signal are left out.
int run_and_report(const std::vector<Experiment>& experiments, const CampaignOptions& options, Report report,
                   bool strict = false) {
  if (const KnownBefore known = strict ? look_before(experiments, true) : KnownBefore{};
      known.exit_code != exit_ok) {
    return known.exit_code;
  } else if (known.warnings > 0) {
    print_text(stderr, "bendlab: nothing was computed, because --strict makes these warnings errors\n");
    return exit_failed;
  }
  check_writable(options.out);
  for (const Experiment& experiment : experiments) write_sweep_file(options.out, experiment);
  catch_stop_signals();
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  tell_large_needs(runs);
  std::vector<CampaignRun> of_experiment;
  bool first = true;
  // Messages go to stderr while the runs go on. Who reads both on one terminal need not read them twice.
  const bool one_terminal = isatty(STDOUT_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  run_campaign(runs, options, [&](std::size_t index) {
    if (runs[index].started()) of_experiment.push_back(runs[index]);
    if (report == Report::json && runs[index].started()) print_text("{}\n", json_text(run_json(runs[index])));
    if (report == Report::explanations && runs[index].started())
      print_text("{}\n", explain_text(runs[index]));
    const bool last = index + 1 == runs.size() || runs[index + 1].experiment != runs[index].experiment;
    if (last && !of_experiment.empty()) {
      if (report != Report::lines && !(report == Report::tables && one_terminal))
        tell_warnings(of_experiment);
      if (report == Report::tables)
        print_text("{}{}", first ? "" : "\n", experiment_text(of_experiment, !one_terminal));
      if (report == Report::lines) print_text("{}", experiment_line(of_experiment));
      first = false;
    }
    if (last) of_experiment.clear();
    std::fflush(stdout);
  });

  if (const int code = stop_exit_code(); code != 0) {
    const auto complete = std::ranges::count_if(
        runs, [](const CampaignRun& run) { return run.outcome && is_whole(run.outcome->status); });
    print_text(stderr, "bendlab: stopped; {} of {} complete; the same command again does the rest\n",
               complete, counted(runs.size(), "run"));
    return code;
  }
  const int code = campaign_exit_code(runs);
  const bool warned = strict && !collected_warnings(runs).empty();
  return code == exit_ok && (warned || !expectations_hold(runs)) ? int{exit_failed} : code;
}

/// The JSON files of a folder, by name; those that end in `_full` only where asked for, those in `_slow`
/// unless it has to be quick. Of a file, itself.
std::vector<fs::path> configs_in(const fs::path& folder, const ReproduceArguments& arguments) {
  std::vector<fs::path> files;
  if (fs::is_regular_file(folder)) return {folder};
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const std::string name = file.stem().string();
    if (file.extension() == ".json" && (arguments.full || !name.ends_with("_full")) &&
        !(arguments.quick && name.ends_with("_slow")))
      files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

/// Experiments, and the script that draws them when they are there.
struct PageStage {
  std::array<std::string_view, 3> configs;  ///< folders or files below configs/
  std::string_view script;                  ///< below analysis/
  std::string_view option{};                ///< of the script
};

/// Something to reproduce, in stages: a picture is there while the later stages still run.
struct Reproducible {
  std::string_view name, page;  ///< the folder of its page
  std::array<PageStage, 3> stages;
};

constexpr PageStage first_figure = {{"paper/fig1.json"}, "page.py", "--only=first"};
constexpr PageStage whole_paper = {{"paper", "recommended.json"}, "page.py", "--only=paper"};
constexpr std::array reproducibles = {
    Reproducible{
        "everything", "paper", {first_figure, whole_paper, {{"ablations", "models", "scenes"}, "page.py"}}},
    Reproducible{"paper", "paper", {first_figure, whole_paper}},
    Reproducible{"stiffness", "stiffness", {PageStage{{"stiffness"}, "stiffness_page.py"}}},
    Reproducible{
        "stability", "stability", {PageStage{{"stability", "one_pin", "methods"}, "stability_page.py"}}},
    Reproducible{"accuracy", "accuracy", {PageStage{{"accuracy"}, "accuracy_page.py"}}},
    Reproducible{"plain", "plain", {PageStage{{"plain"}, "plain_page.py"}}},
};

/// What lies in the folders of an experiment's runs, by folder. (As text: comparing paths is slow.)
using StatesByFolder = std::unordered_map<std::string, RunRecord>;

StatesByFolder states_in(const fs::path& out, const Experiment& experiment) {
  StatesByFolder states;
  const fs::path folder = out / experiment.name;
  if (!fs::is_directory(folder)) return states;
  for (RunRecord& run : read_runs(
           folder, [](const std::string&) {}, Part::state))
    states.emplace(run.file.parent_path().string(), std::move(run));  // a folder's finished file comes first
  return states;
}

/// "complete", "implausible", "diverged, 12 frames", "running", "unreadable" or "new".
std::string state_on_disk(const StatesByFolder& states, const fs::path& folder, const std::string& id) {
  const auto with_frames = [](RunStatus status, std::uint64_t frames) {
    return fmt::format("{}, {}", to_string(status), counted(frames, "frame"));
  };
  const auto found = states.find(folder.string());
  if (found != states.end() && is_whole(found->second.status))
    return found->second.id == id ? to_string(found->second.status) : "unreadable";
  if (found == states.end() && !fs::exists(folder)) return "new";
  if (!owner_of(folder).empty()) return "running";
  if (found == states.end())
    if (const auto record = ended_since(folder); record && record->id == id) return to_string(record->status);
  if (found != states.end())
    return with_frames(
        found->second.status == RunStatus::running ? RunStatus::interrupted : found->second.status,
        found->second.frames);
  if (fs::exists(folder / "run.vtkhdf") || !unfinished_files(folder).empty()) return "unreadable";
  return "new";
}

/// What is known of a run without computing it.
struct KnownRun {
  std::string id;
  fs::path folder;
  std::string state;
  std::optional<Forecast> needs;
};

std::vector<KnownRun> look_at_runs(const Experiment& experiment, const fs::path& out) {
  const StatesByFolder states = states_in(out, experiment);
  std::vector<KnownRun> known(experiment.runs.size());
  in_parallel(known.size(), 200, [&](std::size_t i) {
    const RunConfig& config = experiment.runs[i];
    auto& [id, folder, state, needs] = known[i];
    id = run_id(config);
    folder = run_folder(out, experiment, config, id);
    state = state_on_disk(states, folder, id);
    needs = forecast(config);
  });
  return known;
}

Json known_run_json(const Experiment& experiment, const RunConfig& config, const KnownRun& run) {
  Json line = {
      {"experiment", experiment.name}, {"point", point_json(config)}, {"id", run.id}, {"state", run.state},
      {"folder", run.folder.string()}, {"config", config.resolved()}};
  if (run.needs)
    line["needs"] = {{"cpu_s", run.needs->cpu_s},
                     {"memory_bytes", run.needs->memory_bytes},
                     {"disk_bytes", run.needs->disk_bytes}};
  return line;
}

/// Which combinations a covering array has and lacks, in a few lines; empty for a whole sweep.
std::string cover_text(const Covered& cover) {
  if (cover.strength == 0) return "";
  std::string text =
      fmt::format("has {} of {} combinations of the values of any {}\n", cover.tuples - cover.missing,
                  cover.tuples, counted(cover.strength, "swept setting"));
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(cover.refused.size(), shown); ++i)
    text += fmt::format("left out, because no run can have these together: {}\n", cover.refused[i]);
  if (cover.refused.size() > shown) text += fmt::format("and {} more\n", cover.refused.size() - shown);
  return text;
}

}  // namespace

int run_command(const ConfigArguments& configs, const CampaignOptions& options, bool json, bool explain,
                bool strict) {
  return run_and_report(load_experiments(configs), options,
                        json      ? Report::json
                        : explain ? Report::explanations
                                  : Report::tables,
                        strict);
}

int plan_command(const ConfigArguments& configs, const fs::path& out, const fs::path& write, bool json) {
  const std::vector<Experiment> experiments = load_experiments(configs);
  if (!write.empty()) write_plan(write, experiments, out);
  for (const Experiment& experiment : experiments) {
    const std::vector<KnownRun> known = look_at_runs(experiment, out);
    if (json) {
      for (std::size_t i = 0; i < known.size(); ++i)
        print_text("{}\n", json_text(known_run_json(experiment, experiment.runs[i], known[i])));
      continue;
    }
    std::vector<std::string> headings = axis_headings(experiment);
    headings.insert(headings.end(), {"id", "state", "CPU time", "memory", "disk"});
    Table table(headings);
    std::size_t complete = 0, over = 0;
    Needs left;
    for (std::size_t i = 0; i < known.size(); ++i) {
      const auto& [id, folder, state, needs] = known[i];
      if (state == "complete") ++complete;
      if (state == "complete" || state == "implausible")
        ++over;
      else if (needs)
        left.add(*needs);
      std::vector<std::string> cells = axis_cells(experiment, experiment.runs[i]);
      cells.insert(cells.end(), {id, state});
      if (needs)
        cells.insert(cells.end(), {duration_text(needs->cpu_s), bytes_text(needs->memory_bytes),
                                   bytes_text(needs->disk_bytes)});
      else
        cells.insert(cells.end(), 3, "-");
      table.add_row(std::move(cells));
    }
    print_text("{}: {}, {} complete; {}\n{}\n{}\n", experiment.name, counted(known.size(), "run"), complete,
               over == known.size() ? "nothing is left to do" : "left are " + needs_text(left),
               cover_text(experiment.cover), table.text());
  }
  return exit_ok;
}

int validate_command(const ConfigArguments& configs, bool strict) {
  const std::vector<Experiment> experiments = load_experiments(configs);
  const KnownBefore known = look_before(experiments, strict);
  if (known.exit_code != exit_ok) return known.exit_code;
  if (strict && known.warnings > 0) return exit_failed;
  for (const Experiment& experiment : experiments)
    print_text("{}: {} ({})\n{}", coloured("ok", Colour::green, stdout), experiment.source.string(),
               counted(experiment.runs.size(), "run"), cover_text(experiment.cover));
  return exit_ok;
}

std::vector<std::string> reproducible() {
  std::vector<std::string> names;
  for (const Reproducible& each : reproducibles) names.emplace_back(each.name);
  return names;
}

int reproduce_command(CampaignOptions options, const ReproduceArguments& arguments) {
  const Reproducible& what = *std::ranges::find(reproducibles, arguments.what, &Reproducible::name);
  const fs::path source = BENDLAB_SOURCE_DIR;
  if (!fs::is_directory(source / "configs"))
    throw UsageError(
        fmt::format("reproduce needs the configs and scripts of the checkout that this program was "
                    "built from, and '{}' is not there: run ./bendlab reproduce in a checkout",
                    source.string()));
  options.out = arguments.out.empty() ? source / "results" : arguments.out;
  const fs::path page = options.out / what.page;
  std::vector<std::vector<Experiment>>
      experiments;  // of each stage; every config is read before the first run
  for (const PageStage& stage : what.stages) {
    ConfigArguments configs;
    for (const std::string_view place : stage.configs)
      if (!place.empty())
        std::ranges::copy(configs_in(source / "configs" / place, arguments),
                          std::back_inserter(configs.files));
    experiments.push_back(load_experiments(configs));
  }

  int code = exit_ok;
  for (std::size_t i = 0; i < what.stages.size(); ++i) {
    const PageStage& stage = what.stages[i];
    if (stage.script.empty()) break;
    const int runs_code = run_and_report(experiments[i], options, Report::lines);
    if (stop_exit_code() != 0) return runs_code;
    code = std::max(code, runs_code);
    print_text(stderr, "bendlab: drawing the figures\n");
    const fs::path script = source / "analysis" / stage.script;
    std::vector<std::string> drawing = {BENDLAB_PYTHON,       script.string(), "--results",
                                        options.out.string(), "--out",         page.string()};
    if (!stage.option.empty()) drawing.emplace_back(stage.option);
    const int page_code = run_program(drawing);  // says where what it drew is
    if (stop_exit_code() != 0) return stop_exit_code();
    if (page_code != 0) {
      print_text(stderr, "bendlab: {} ended with exit code {}\n", fmt::join(drawing, " "), page_code);
      return exit_failed;
    }
  }
  return code;
}

}  // namespace bendlab
