// `bendlab reproduce`: runs experiments of the checkout, then makes a page with their figures and checks.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bendlab_places.hpp"
#include "experiments/cli/child_program.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/cli/shared_options.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// One stage: experiments that are run together, after which the page is made.
struct PageStage {
  std::array<std::string_view, 4> configs;  ///< folders or files below configs/
  std::string_view option{};                ///< an option for analysis/page.py
};

/// A set of experiments with a page. After the first stage the page already has a first figure.
struct Reproducible {
  std::string_view name, page;  ///< `page`: its name for analysis/page.py, and the name of its folder
  std::array<PageStage, 3> stages;
};

constexpr PageStage first_figure = {{"paper/fig1.json"}, "--figure=fig_1"};
constexpr PageStage whole_paper = {{"paper", "recommended.json"}};
constexpr std::array reproducibles = {
    Reproducible{"everything", "paper", {first_figure, whole_paper, {{"ablations", "models", "scenes"}}}},
    Reproducible{"paper", "paper", {first_figure, whole_paper}},
    Reproducible{"verification", "verification", {PageStage{{"verification"}}}},
    Reproducible{"stiffness", "stiffness", {PageStage{{"stiffness"}}}},
    Reproducible{"stability", "stability", {PageStage{{"stability", "one_pin", "methods", "fabrics"}}}},
    Reproducible{"accuracy", "accuracy", {PageStage{{"accuracy"}}}},
    Reproducible{"plain", "plain", {PageStage{{"plain"}}}},
};

struct ReproduceCommand : Command {
  std::string what{reproducibles.front().name};
  CampaignOptions campaign;
  fs::path out;  // empty: the checkout's folder results for runs, and results/own for pages
  bool committed = false, full = false, quick = false;

  ReproduceCommand() {
    std::vector<std::string_view> names;
    for (const Reproducible& set : reproducibles) names.push_back(set.name);
    add(what, fmt::format("[WHAT] {}", fmt::join(names, "|")),
        "everything: the paper, then its ablations, every model and the scenes; paper: only the figures "
        "of the paper; verification: whether the program solves its equations, compared with exact "
        "solutions; stiffness: how stiff every model is, compared with theory; stability: in which hard "
        "cases every model stays stable; accuracy: how much time accuracy costs; plain: whether plain "
        "scenes go wrong without a warning");
    add_campaign(*this, campaign);
    add(full, "--full",
        "Also run the configs whose names end in _full, such as resolution 256 (stability, accuracy and "
        "plain have no such configs)");
    add(quick, "--quick",
        "Leave out configs whose names end in _slow (everything, paper and plain have no such configs); "
        "the page says what is missing. Not with --full");
    add(out, "--out",
        "Folder for runs and pages (default: the checkout's folder results for runs, results/own for "
        "pages)");
    add(committed, "--committed",
        "For maintainers: replace the project's own page, which is committed. Not with --out");
  }
  int run() override;
};

/// Whether a config is left out because of the end of its name.
bool is_left_out(const fs::path& config, const ReproduceCommand& arguments) {
  const std::string name = config.stem().string();
  return (name.ends_with("_full") && !arguments.full) || (name.ends_with("_slow") && arguments.quick);
}

/// The JSON files in a folder, sorted by name. `folder` may also be one file.
std::vector<fs::path> configs_in(const fs::path& folder) {
  if (fs::is_regular_file(folder)) return {folder};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// The experiments of a stage. `changed` becomes true if --quick leaves out a config, or --full adds a
/// config.
std::vector<Experiment> experiments_of(const PageStage& stage, const fs::path& folder,
                                       const ReproduceCommand& arguments, bool& changed) {
  std::vector<std::string> files;
  for (const std::string_view place : stage.configs) {
    if (place.empty()) continue;
    for (const fs::path& file : configs_in(folder / place)) {
      changed |= is_left_out(file, arguments) != is_left_out(file, {});
      if (!is_left_out(file, arguments)) files.push_back(file.string());
    }
  }
  return load_experiments(files);
}

/// Runs a script of analysis/ with Python. Returns exit_ok, exit_failed, or the exit code of a stop signal.
int run_script(const fs::path& script, const std::vector<std::string>& arguments) {
  std::vector<std::string> call = {BENDLAB_PYTHON, script.string()};
  call.insert(call.end(), arguments.begin(), arguments.end());
  const int code = run_program(call);
  if (stop_exit_code() != 0) return stop_exit_code();
  if (code == 0) return exit_ok;
  print_text(stderr, "bendlab: {} ended with exit code {}\n", fmt::join(call, " "), code);
  return exit_failed;
}

int ReproduceCommand::run() {
  if (full && quick) throw UsageError("--quick excludes --full");
  if (committed && !out.empty()) throw UsageError("--committed excludes --out");
  const Reproducible& set = *std::ranges::find(reproducibles, what, &Reproducible::name);
  const fs::path source = BENDLAB_SOURCE_DIR;
  if (!fs::is_directory(source / "configs"))
    throw UsageError(
        fmt::format("reproduce needs the configs and scripts of the checkout that this program was built "
                    "from, but '{}' does not exist: run ./bendlab reproduce in a checkout",
                    source.string()));
  CampaignOptions options = campaign;
  options.out = out.empty() ? source / "results" : out;
  const fs::path pages = out.empty() && !committed ? options.out / "own" : options.out,
                 page = pages / set.page;
  std::vector<std::vector<Experiment>>
      experiments;  // of each stage; all configs are checked before the first run
  bool changed = false;
  for (const PageStage& stage : set.stages)
    experiments.push_back(experiments_of(stage, source / "configs", *this, changed));
  if ((quick || full) && !changed)
    print_text(stderr, "bendlab: --{0} changes nothing: no config of {1} has a name that ends in _{2}\n",
               quick ? "quick" : "full", set.name, quick ? "slow" : "full");

  int code = exit_ok;
  for (std::size_t i = 0; i < set.stages.size(); ++i) {
    const PageStage& stage = set.stages[i];
    if (stage.configs.front().empty()) break;
    const int runs_code = run_and_report(experiments[i], options, Report::lines);
    if (stop_exit_code() != 0) return runs_code;
    code = std::max(code, runs_code);
    print_text(stderr, "bendlab: drawing the figures\n");
    std::vector<std::string> drawing = {std::string(set.page), "--results", options.out.string(), "--out",
                                        page.string()};
    if (!stage.option.empty()) drawing.emplace_back(stage.option);
    // page.py prints the path of the page.
    if (const int drawn = run_script(source / "analysis/page.py", drawing); drawn != exit_ok) return drawn;
  }
  if (!committed)
    if (const int compared = run_script(source / "analysis/compare_pages.py", {page.string()});
        compared != exit_ok)
      return compared;
  return code;
}

}  // namespace

extern const CommandKind reproduce_command{
    "reproduce", "Run a set of the project's experiments and make the page with its figures and checks",
    "bendlab reproduce paper", make<ReproduceCommand>};

}  // namespace bendlab
