// `bendlab report` and `bendlab view`: a page of any runs, made by Python (analysis/report.py, live.py).
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "bendlab/scene/nearest_name.hpp"
#include "bendlab_places.hpp"
#include "experiments/campaign/run_index.hpp"
#include "experiments/campaign/sweep_file.hpp"
#include "experiments/cli/child_program.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// The options of both commands.
struct PageCommand : Command {
  std::vector<std::string> results;  ///< folders with runs, run files, sweep files, configs, ids
  std::string folder = "results";    ///< in which to look for ids
  fs::path out;                      ///< empty: beside the results, for view in the cache
  std::vector<std::string> play;     ///< empty: a selection
  std::string figures, x, y;         ///< of report; empty: no files, no further chart

  PageCommand(const char* name, const char* what_out) {
    add(results, name,
        "Folders of results, run files, .sweep.json files, configs, or the beginnings of run ids");
    add(out, "--out,-o FILE", what_out);
    add(play, "--play RUN...",
        "A run to be shown as an animation: the beginning of its id, or a part of its folder's name. "
        "Repeatable (default: at most 8 runs, with every value of one swept setting and the middle "
        "value of the other swept settings)");
    add_results(*this, folder);
  }
};

bool is_sweep_file(const fs::path& file) {
  return file.filename().string().ends_with(".sweep.json");
}

bool has_sweep_file(const fs::path& folder) {
  return std::ranges::any_of(fs::directory_iterator(folder),
                             [](const fs::directory_entry& entry) { return is_sweep_file(entry.path()); });
}

/// "; did you mean 'results/first'?" Suggests the most similar name beside `result` or in `folder`.
std::string nearest_result(const fs::path& result, const fs::path& folder) {
  const std::string name = result.filename().string();
  for (const fs::path& place : {result.parent_path(), folder}) {
    if (!fs::is_directory(place)) continue;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place))
      if (entry.is_directory() || is_sweep_file(entry.path()))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    const std::string nearest = nearest_name(name, names);
    if (!nearest.empty()) return fmt::format("; did you mean '{}'?", (place / nearest).string());
  }
  return "";
}

/// The sweep file that `bendlab run` wrote for a config, or the folder of the config's runs.
fs::path sweep_of(const fs::path& config, const fs::path& folder) {
  const Experiment experiment = load_experiment(config);
  const fs::path sweep = sweep_file(folder, experiment), runs = folder / experiment.name;
  if (fs::is_regular_file(sweep)) return sweep;
  if (fs::is_directory(runs) && has_sweep_file(runs)) return runs;  // runs with other settings (--set)
  throw UsageError(fmt::format("there are no runs of the config '{}' in '{}'; 'bendlab run {}' computes them",
                               config.string(), runs.string(), config.string()));
}

/// What an argument names: a folder with runs, a sweep file, a config, a run file or a run's id.
fs::path found_result(const std::string& result, const fs::path& folder) {
  const fs::path path = result;
  if (fs::is_regular_file(path) && path.extension() == ".json" && !is_sweep_file(path))
    return sweep_of(path, folder);
  if (fs::is_regular_file(path)) return path;
  if (fs::is_directory(path)) {
    if (has_sweep_file(path) || !find_run_files(path).empty()) return path;
    throw UsageError(fmt::format(
        "there are no runs in '{}'; 'bendlab run CONFIG --out DIR' computes runs into DIR", result));
  }
  const bool may_be_id = !result.empty() && std::ranges::all_of(result, [](unsigned char character) {
    return std::isxdigit(character) != 0;
  });
  if (may_be_id)
    if (const std::optional<fs::path> file = only_run(result, files_by_id(result, folder))) return *file;
  throw UsageError(fmt::format(
      "'{}' is not a folder of results, not a run file, and not the beginning of the id of a run in '{}'{} "
      "'bendlab list {}' lists the runs in this folder",
      result, folder.string(), nearest_result(path, folder).empty() ? ";" : nearest_result(path, folder),
      folder.string()));
}

/// The default file of the page, in the result's folder, or in the innermost folder that contains all
/// results.
fs::path default_page(const std::vector<fs::path>& results) {
  const auto home = [](const fs::path& result) {
    const fs::path whole = fs::canonical(result);
    return fs::is_directory(whole) ? whole : whole.parent_path();
  };
  fs::path common = home(results.front());
  for (const fs::path& result : results)
    while (home(result).lexically_relative(common).string().starts_with("..")) common = common.parent_path();
  const fs::path page = common / "report.html", near = page.lexically_proximate(fs::current_path());
  return near.string().starts_with("..") ? page : near;
}

/// The command, as printed on the page.
std::string command_text(const char* command, const PageCommand& arguments) {
  std::string text = fmt::format("./bendlab {}", command);
  for (const std::string& result : arguments.results) text += " " + shell_quoted(result);
  for (const std::string& run : arguments.play) text += " --play " + shell_quoted(run);
  if (!arguments.out.empty()) text += " -o " + shell_quoted(arguments.out.string());
  if (!arguments.figures.empty()) text += " --figures " + arguments.figures;
  if (!arguments.x.empty())
    text += fmt::format(" --x {} --y {}", shell_quoted(arguments.x), shell_quoted(arguments.y));
  return text;
}

/// The command line that runs a Python script of the checkout with the arguments that every page needs.
std::vector<std::string> script_call(const char* script, const char* command, const PageCommand& arguments,
                                     const std::vector<fs::path>& results) {
  const fs::path path = fs::path(BENDLAB_SOURCE_DIR) / "analysis" / script;
  if (!fs::is_regular_file(path))
    throw UsageError(
        fmt::format("{} needs the scripts of the checkout that this program was built from, but '{}' does "
                    "not exist: run ./bendlab {} in a checkout",
                    command, path.string(), command));
  std::vector<std::string> call = {BENDLAB_PYTHON, path.string(), "--command",
                                   command_text(command, arguments)};
  for (const std::string& run : arguments.play) call.push_back("--play=" + run);
  if (!arguments.figures.empty()) call.push_back("--figures=" + arguments.figures);
  if (!arguments.x.empty()) call.insert(call.end(), {"--x=" + arguments.x, "--y=" + arguments.y});
  call.emplace_back("--");
  for (const fs::path& result : results) call.push_back(result.string());
  return call;
}

int page_code(const std::vector<std::string>& call) {
  const int code = run_program(call);  // prints where the page is, or what was wrong
  if (code == exit_ok || code == exit_usage || code == exit_io || code >= 128) return code;
  if (code == 127) print_text(stderr, "bendlab: Python could not be started: {}\n", fmt::join(call, " "));
  return exit_failed;
}

std::vector<fs::path> found_results(const PageCommand& arguments) {
  std::vector<fs::path> results;
  for (const std::string& result : arguments.results)
    results.push_back(found_result(result, arguments.folder));
  return results;
}

struct ReportCommand : PageCommand {
  ReportCommand()
      : PageCommand("RESULT", "The page's file (default: report.html in the folder of the results)") {
    add(figures, "--figures svg|pdf|png",
        "Also write each chart to a file, in the folder 'figures' beside the page");
    const std::string number =
        "a metric of the summary, such as ms_per_frame, vertices or error_physical_rms, or the pointer of a "
        "setting";
    add(x, "--x", "With --y, the horizontal axis of one more chart: " + number);
    add(y, "--y", "With --x, the vertical axis of one more chart: " + number);
  }

  int run() override {
    if (x.empty() != y.empty()) throw UsageError("--x and --y need each other");
    const std::vector<fs::path> found = found_results(*this);
    std::vector<std::string> call = script_call("report.py", "report", *this, found);
    const fs::path page = out.empty() ? default_page(found) : out;
    call.insert(call.begin() + 2, "--out=" + page.string());
    return page_code(call);
  }
};

struct ViewCommand : PageCommand {
  bool live = false, no_open = false;

  ViewCommand() : PageCommand("RUN", "The page's file (default: a file in ~/.cache/bendlab)") {
    add(live, "--live",
        "Show a run while it is being computed: serve the run's page at 127.0.0.1, under an address "
        "that nobody can guess, and add new frames to the page. Ctrl-C ends the server");
    add(no_open, "--no-open", "Only print where the page is, and do not open the browser");
  }

  int run() override {
    const std::vector<fs::path> found = found_results(*this);
    if (live && found.size() != 1)
      throw UsageError("--live shows one run: name the folder of a run that is being computed");
    std::vector<std::string> call = script_call(live ? "live.py" : "report.py", "view", *this, found);
    if (!live) call.insert(call.begin() + 2, out.empty() ? "--cached" : "--out=" + out.string());
    if (!no_open) call.insert(call.begin() + 2, "--open");
    if (!live) return page_code(call);
    std::vector<char*> argv;  // the server replaces this process, and so receives Ctrl-C
    for (std::string& argument : call) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(argv.front(), argv.data());
    print_text(stderr, "bendlab: Python could not be started: {}\n", fmt::join(call, " "));
    return exit_failed;
  }
};

}  // namespace

extern const CommandKind report_command{
    "report", "Make a page of any runs, with animations, charts and tables",
    "bendlab report results/first results/second -o both.html", make<ReportCommand>};
extern const CommandKind view_command{"view", "Watch runs in the browser",
                                      "bendlab view results/first --play cells=16", make<ViewCommand>};

}  // namespace bendlab
