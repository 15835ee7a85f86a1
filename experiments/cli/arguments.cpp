#include "experiments/cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/completion.hpp"
#include "experiments/config/schema.hpp"
#include "experiments/export/exported_run.hpp"
#include "experiments/measures/metrics.hpp"
#include "experiments/run/checked_read.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/version.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

constexpr std::string_view footer =
    "Exit codes: 0 success; 1 a run or an expectation failed, or a run is implausible; 2 wrong usage;\n3 "
    "error in a config; 4 error in a mesh; 5 a file cannot be read or written; 6 a run diverged;\n130 and "
    "143 stopped by a signal.\nThe first Ctrl-C stops after the current frame, which is kept; the second "
    "Ctrl-C stops at once.\nData goes to stdout, messages to stderr. NO_COLOR=1 turns colours off.";

/// The values of the arguments, and the chosen command.
struct Arguments {
  ConfigArguments configs;
  CampaignOptions options;
  bool json = false, list = false, explain = false, strict = false;
  std::string run = "", folder = "results";
  std::filesystem::path mesh_file;
  ReproduceArguments reproduce;
  QualityThresholds thresholds;
  std::string bad_triangles = "refuse";
  std::filesystem::path mesh_copy;
  StiffnessArguments stiffness;
  AdviseArguments advise;
  DialectArguments dialect;
  FabricsArguments fabrics;
  FitArguments fit;
  BenchOptions bench;
  ListArguments listed;
  CompareArguments compared;
  RerunArguments repeated;
  WorkArguments work;
  SubmitArguments submitted;
  std::filesystem::path plan;
  ExportArguments exported;
  PageArguments page;
  std::function<int()> command;
};

// Examples for --help: complete commands for a checkout with results.
constexpr std::array<std::pair<std::string_view, std::string_view>, 29> examples = {{
    {"run", "bendlab run configs/plain/first.json --set /mesh/cells=24 --out results/try"},
    {"plan", "bendlab plan configs/plain/first.json"},
    {"validate", "bendlab validate configs/recommended.json"},
    {"energy", "bendlab energy configs/verification/half_cylinder.json"},
    {"reproduce", "bendlab reproduce paper"},
    {"work", "bendlab work results/plans/first-0a1b2c3d.plan.json --shard 0/8"},
    {"status", "bendlab status results/plans/first-0a1b2c3d.plan.json"},
    {"submit", "bendlab submit configs/plain/first.json --time 30:00 --sbatch=--partition=short --dry-run"},
    {"list", "bendlab list results --where /bending/model=adaptive --sort drop"},
    {"show", "bendlab show results/first"},
    {"compare", "bendlab compare results/first results/second"},
    {"rerun", "bendlab rerun results/first/cells=16"},
    {"export", "bendlab export results/first/cells=16 --format usda --to first.usda"},
    {"report", "bendlab report results/first results/second -o both.html"},
    {"view", "bendlab view results/first --play cells=16"},
    {"stiffness", "bendlab stiffness results/strip"},
    {"advise", "bendlab advise configs/advise/strip.json --error 5%"},
    {"dialect", "bendlab dialect newton --edge-ke 10 garment.obj"},
    {"mesh", "bendlab mesh garment.obj --bad-triangles repair"},
    {"bench", "bendlab bench --quick --filter strain"},
    {"models", "bendlab models --json"},
    {"effects", "bendlab effects"},
    {"fit", "bendlab fit strip.json --measured warp.csv --find /bending/flexural_rigidity"},
    {"fabrics", "bendlab fabrics --kes-warp warp.csv --kes-weft weft.csv --mass 124"},
    {"measures", "bendlab measures"},
    {"methods", "bendlab methods"},
    {"schema", "bendlab schema --json > schema.json"},
    {"completion", "source <(bendlab completion bash)"},
    {"test", "./bendlab test -R config"},
}};

CLI::App* add_command(CLI::App& app, Arguments& arguments, const char* name, const char* summary,
                      std::function<int()> command) {
  CLI::App* added = app.add_subcommand(name, summary);
  const auto example =
      std::ranges::find(examples, name, &std::pair<std::string_view, std::string_view>::first);
  if (example != examples.end()) added->footer(fmt::format("Example: {}", example->second));
  added->callback([&arguments, command = std::move(command)] { arguments.command = command; });
  return added;
}

// An option whose default is shown by --help.
template <class Value>
CLI::Option* add_shown(CLI::App* command, const char* name, Value& value, const std::string& what) {
  return command->add_option(name, value, what)->capture_default_str();
}

// An option that may be given several times, each time with one value.
void add_repeatable(CLI::App* command, const char* type, const char* name, std::vector<std::string>& values,
                    const char* what) {
  command->add_option(name, values, what)->type_name(type)->allow_extra_args(false);
}

void add_results(CLI::App* command, std::string& folder) {
  add_shown(command, "--results", folder, "Folder in which to look for a run's id");
}

void add_configs(CLI::App* command, Arguments& arguments) {
  command->add_option("CONFIG", arguments.configs.files, "Config files (JSON)")->required();
  add_repeatable(command, "/POINTER=VALUE", "--set", arguments.configs.overrides,
                 "Change a setting, such as /mesh/cells=64. If the config sweeps this setting, the value (or "
                 "a list of values) replaces the swept values. Repeatable");
  add_repeatable(command, "/POINTER=VALUES", "--sweep", arguments.configs.axes,
                 "Vary one more setting, such as /bending/k=0.1,0.2. Repeatable");
}

void add_json(CLI::App* command, Arguments& arguments, const char* what) {
  command->add_flag("--json", arguments.json, what);
}

void add_jobs(CLI::App* command, Arguments& arguments) {
  command
      ->add_option("--jobs,-j", arguments.options.jobs,
                   "Number of runs to compute at a time (default: number of cores / threads per run)")
      ->check(CLI::Range(1, 1024));
}

void add_checkpoint(CLI::App* command, Arguments& arguments) {
  add_shown(
      command, "--checkpoint", arguments.options.checkpoint_interval_s,
      "Seconds between two checkpoints of a run, from which the run continues after a crash. Checkpoints "
      "take at most 1 % of a run's time. 0: write a checkpoint only when the run is stopped")
      ->check(CLI::NonNegativeNumber);
}

void add_campaign(CLI::App* command, Arguments& arguments) {
  add_jobs(command, arguments);
  command->add_flag("--force", arguments.options.force,
                    "Compute complete runs again; each old file stays until the new file replaces it");
  add_checkpoint(command, arguments);
}

void add_run_commands(CLI::App& app, Arguments& a) {
  CLI::App* run =
      add_command(app, a, "run", "Compute the runs of the configs, except the runs that are complete",
                  [&a] { return run_command(a.configs, a.options, a.json, a.explain, a.strict); });
  add_configs(run, a);
  add_campaign(run, a);
  add_shown(run, "--out", a.options.out, "Folder for the results");
  run->add_flag("--minimal", a.options.minimal,
                "Leave out effects that cannot act, and check that no bit of the result changes");
  CLI::Option* explain =
      run->add_flag("--explain", a.explain,
                    "Instead of the tables of results, print what a step consists of: each pass (part of a "
                    "step) with its purpose, its time, and how much it changed");
  run->add_flag("--strict", a.strict,
                "Treat warnings as errors; if there are warnings before the runs begin, nothing is computed");
  add_json(run, a, "Print one JSON object per run to stdout");
  run->get_option("--json")->excludes(explain);

  CLI::App* plan = add_command(
      app, a, "plan",
      "List the runs of the configs: swept values, id, state, memory and disk, and the time by finished runs",
      [&a] { return plan_command(a.configs, a.options.out, a.plan, a.json); });
  add_configs(plan, a);
  plan->add_option("--write", a.plan, "Also write the plan to this file, for 'bendlab work'")
      ->type_name("PLAN");
  add_shown(plan, "--out", a.options.out, "Folder of the results");
  add_json(plan, a, "Print one JSON object per run");

  CLI::App* energy = add_command(
      app, a, "energy", "Print the elastic energies and forces of the pose at the start of every run",
      [&a] { return energy_command(a.configs, a.json); });
  add_configs(energy, a);
  add_json(energy, a, "Print one JSON object per run");

  CLI::App* validate = add_command(app, a, "validate", "Check configs and report every problem",
                                   [&a] { return validate_command(a.configs, a.strict); });
  add_configs(validate, a);
  validate->add_flag(
      "--strict", a.strict,
      "Build the scene of every run, and treat warnings that are known before the first step as "
      "errors");

  CLI::App* reproduce =
      add_command(app, a, "reproduce",
                  "Run a set of the project's experiments and make the page with its figures and checks",
                  [&a] { return reproduce_command(a.options, a.reproduce); });
  add_shown(reproduce, "WHAT", a.reproduce.what,
            "everything: the paper, then its ablations, every model and the scenes; paper: only the figures "
            "of the paper; verification: whether the program solves its equations, compared with exact "
            "solutions; stiffness: how stiff every model is, compared with theory; stability: in which "
            "hard cases every model stays stable; accuracy: how much time accuracy costs; plain: whether "
            "plain scenes go wrong without a warning")
      ->check(CLI::IsMember(reproducible()));
  add_campaign(reproduce, a);
  CLI::Option* full = reproduce->add_flag(
      "--full", a.reproduce.full,
      "Also run the configs whose names end in _full, such as resolution 256 (stability, accuracy "
      "and plain have no such configs)");
  reproduce
      ->add_flag("--quick", a.reproduce.quick,
                 "Leave out configs whose names end in _slow (everything, paper and plain have no such "
                 "configs); the page says what is missing")
      ->excludes(full);
  CLI::Option* out = reproduce->add_option(
      "--out", a.reproduce.out,
      "Folder for runs and pages (default: the checkout's folder results for runs, results/own for pages)");
  reproduce
      ->add_flag("--committed", a.reproduce.committed,
                 "For maintainers: replace the project's own page, which is committed")
      ->excludes(out);
}

void add_plan_file(CLI::App* command, std::filesystem::path& file) {
  command->add_option("PLAN", file, "File that 'submit' or 'plan --write' wrote")->required();
}

void add_work_commands(CLI::App& app, Arguments& a) {
  CLI::App* work =
      add_command(app, a, "work", "Compute the runs of a plan, together with other processes and machines",
                  [&a] { return work_command(a.work, a.options, a.json); });
  add_plan_file(work, a.work.plan);
  work->add_option("--shard", a.work.shard,
                   "Begin with the runs of part i of n, 0 ≤ i < n; then compute the other runs that no "
                   "process has begun (default: 0/1)")
      ->type_name("i/n");
  add_jobs(work, a);
  add_checkpoint(work, a);
  add_json(work, a, "Print one JSON object per run that was computed here");

  CLI::App* status =
      add_command(app, a, "status", "Show the progress of the runs of a plan, from any machine",
                  [&a] { return status_command(a.work.plan, a.json); });
  add_plan_file(status, a.work.plan);
  add_json(status, a, "Print one JSON object per run");

  CLI::App* submit =
      add_command(app, a, "submit", "Write a plan, and submit it to Slurm as a job array of workers",
                  [&a] { return submit_command(a.configs, a.options.out, a.submitted); });
  add_configs(submit, a);
  add_shown(submit, "--out", a.options.out, "Folder for the results, on a disk that all machines share");
  submit
      ->add_option("--tasks", a.submitted.tasks,
                   "Number of tasks of the job array (default: so many that every run has a CPU at once, but "
                   "at most 1000)")
      ->check(CLI::Range(1, 100000));
  add_shown(submit, "--cpus", a.submitted.cpus,
            "Cores per task, and number of runs that a task computes at a time")
      ->check(CLI::Range(1, 1024));
  submit
      ->add_option("--time", a.submitted.time,
                   "Time limit of a task, in the notation of sbatch; a task that reaches the limit is queued "
                   "again and continues")
      ->type_name("TIME");
  add_repeatable(submit, "OPTION", "--sbatch", a.submitted.sbatch,
                 "Further option for sbatch, such as --sbatch=--mem=4G. Repeatable");
  submit->add_flag("--dry-run", a.submitted.dry_run, "Only print the batch file; write and submit nothing");
}

void add_read_commands(CLI::App& app, Arguments& a) {
  CLI::App* list = add_command(app, a, "list", "List the runs below a folder",
                               [&a] { return list_command(a.listed, a.json); });
  add_shown(list, "DIR", a.listed.folder, "Folder of results");
  add_repeatable(list, "/POINTER=VALUE", "--where", a.listed.where,
                 "Only runs whose config has this value, such as /mesh/cells=64. Repeatable");
  list->add_option("--sort", a.listed.sort,
                   "Sort by a metric of the summary, such as drop, or by a setting, such as /mesh/cells; "
                   "smallest first")
      ->type_name("NAME");
  add_json(list, a, "Print one JSON object per run");

  CLI::App* show = add_command(app, a, "show", "Show a run: summary, time per pass, provenance, config",
                               [&a] { return show_command(a.run, a.folder, a.json); });
  show->add_option("RUN", a.run, "A run file, the folder of a run file, or the beginning of a run's id")
      ->required();
  add_results(show, a.folder);
  add_json(show, a, "Print one JSON object");
}

void add_compare_command(CLI::App& app, Arguments& a) {
  CLI::App* compare = add_command(app, a, "compare", "Show what differs between two runs, or two sweeps",
                                  [&a] { return compare_command(a.compared, a.json); });
  compare
      ->add_option(
          "ONE", a.compared.one,
          "A run file, the folder of a run file, the beginning of a run's id, or the folder of a sweep")
      ->required();
  compare->add_option("OTHER", a.compared.other, "The run or sweep to compare with, named in the same way")
      ->required();
  add_results(compare, a.compared.folder);
  add_json(compare, a, "Print one JSON object per pair of runs");
}

void add_rerun_command(CLI::App& app, Arguments& a) {
  CLI::App* rerun =
      add_command(app, a, "rerun", "Compute a run again from its file, and say whether the bits agree",
                  [&a] { return rerun_command(a.repeated, a.json); });
  rerun
      ->add_option("RUN", a.repeated.run,
                   "A run file, the folder of a run file, or the beginning of a run's id")
      ->required();
  rerun->add_option("--out", a.repeated.out,
                    "Keep the new run in this folder (default: the new run is not kept)");
  add_results(rerun, a.repeated.folder);
  add_json(rerun, a, "Print one JSON object");
}

void add_page(CLI::App* command, Arguments& a, const char* name, const char* out) {
  command
      ->add_option(name, a.page.results,
                   "Folders of results, run files, .sweep.json files, configs, or the beginnings of run ids")
      ->required();
  command->add_option("-o,--out", a.page.out, out)->type_name("FILE");
  add_repeatable(command, "RUN", "--play", a.page.play,
                 "A run to be shown as an animation: the beginning of its id, or a part of its folder's "
                 "name. Repeatable (default: at most 8 runs, with every value of one swept setting and the "
                 "middle value of the other swept settings)");
  add_results(command, a.page.folder);
}

void add_page_commands(CLI::App& app, Arguments& a) {
  CLI::App* report =
      add_command(app, a, "report", "Make a page of any runs, with animations, charts and tables",
                  [&a] { return report_command(a.page); });
  add_page(report, a, "RESULT", "The page's file (default: report.html in the folder of the results)");
  report
      ->add_option("--figures", a.page.figures,
                   "Also write each chart to a file, in the folder 'figures' beside the page")
      ->check(CLI::IsMember({"svg", "pdf", "png"}));
  const char* number =
      "a metric of the summary, such as ms_per_frame, vertices or error_physical_rms, or the pointer of a "
      "setting";
  CLI::Option* x = report->add_option(
      "--x", a.page.x, fmt::format("With --y, the horizontal axis of one more chart: {}", number));
  CLI::Option* y = report->add_option(
      "--y", a.page.y, fmt::format("With --x, the vertical axis of one more chart: {}", number));
  x->needs(y), y->needs(x);

  CLI::App* view =
      add_command(app, a, "view", "Watch runs in the browser", [&a] { return view_command(a.page); });
  add_page(view, a, "RUN", "The page's file (default: a file in ~/.cache/bendlab)");
  view->add_flag("--live", a.page.live,
                 "Show a run while it is being computed: serve the run's page at 127.0.0.1, under an address "
                 "that nobody can guess, and add new frames to the page. Ctrl-C ends the server");
  view->add_flag("--no-open", a.page.no_open, "Only print where the page is, and do not open the browser");
}

void add_export_command(CLI::App& app, Arguments& a) {
  CLI::App* exported =
      add_command(app, a, "export", "Write a run for Blender, Houdini, a spreadsheet or other programs",
                  [&a] { return export_command(a.exported, a.json); });
  exported
      ->add_option("RUN", a.exported.run,
                   "A run file, the folder of a run file, or the beginning of a run's id")
      ->required();
  std::vector<std::string> names;
  std::string meanings = "Formats:\n";
  for (const auto& [name, summary] : export_formats()) {
    names.push_back(name);
    meanings += fmt::format("  {:<5} {}\n", name, summary);
  }
  exported->footer(
      meanings +
      "Every format except csv also has the obstacles. In Houdini, Maya and the defaults of Blender's\nOBJ "
      "importer the y axis is up: give --up y, or choose forward axis Y and up axis Z in Blender.\n" +
      exported->get_footer());
  exported->add_option("--format", a.exported.format, "Format of the files, see below")
      ->required()
      ->check(CLI::IsMember(names));
  exported
      ->add_option("--to", a.exported.to,
                   "Folder to write into, or the file for a format that needs only one file (default: "
                   "export/FORMAT beside the run file)")
      ->type_name("DIR|FILE");
  exported
      ->add_option("--frames", a.exported.frames,
                   "Which frames to write, such as 10:20, ::5 or -1; the first frame is 0, the last is -1 "
                   "(default: all)")
      ->type_name("FIRST:LAST:STEP");
  exported
      ->add_option(
          "--up", a.exported.up,
          "Turn the run so that this axis points up (default: do not turn the run; the file states y "
          "or z as up, by the direction of gravity)")
      ->check(CLI::IsMember(std::vector<std::string>(up_axis_names.begin(), up_axis_names.end())));
  exported->add_flag("--force", a.exported.force, "Replace the files of an earlier export");
  add_results(exported, a.exported.folder);
  add_json(exported, a, "Print one JSON object");
}

void add_stiffness_command(CLI::App& app, Arguments& a) {
  CLI::App* stiffness = add_command(app, a, "stiffness", "Measure how stiff the cantilever strip of a run is",
                                    [&a] { return stiffness_command(a.run, a.folder, a.stiffness, a.json); });
  stiffness->add_option("RUN", a.run, "A run file, the folder of a run file, or the beginning of a run's id")
      ->required();
  add_results(stiffness, a.folder);
  stiffness
      ->add_option("--clamp-offset", a.stiffness.clamp_offset,
                   "How far behind the clamp's edge the strip begins to bend, in m (default: a quarter of "
                   "the reach of the bending constraints along the strip: h/2 for hinges on rows h apart, t "
                   "h/4 for springs of ring t; 0 with physical stiffness)")
      ->check(CLI::NonNegativeNumber);
  stiffness
      ->add_option("--exclude", a.stiffness.exclude,
                   "Length at the clamp and at the free end that the fit of moment m to curvature κ leaves "
                   "out, in m (default: the reach of the bending constraints)")
      ->check(CLI::NonNegativeNumber);
  add_shown(stiffness, "--frame", a.stiffness.frame,
            "Which frame to measure; negative numbers count from the end");
  stiffness->add_flag("--profile", a.stiffness.profile,
                      "Also print angle, curvature and moment along the strip");
  add_json(stiffness, a, "Print one JSON object");
}

void add_advise_command(CLI::App& app, Arguments& a) {
  CLI::App* advise =
      add_command(app, a, "advise", "Find the model, method, substeps, iterations and precision for a scene",
                  [&a] { return advise_command(a.advise, a.options, a.json); });
  advise
      ->add_option("CONFIG", a.advise.file,
                   "Config of the scene (JSON), which states the cloth's bending stiffness")
      ->required();
  advise
      ->add_option("--error", a.advise.error,
                   "Find the fastest settings with at most this error, in sizes of the mesh")
      ->type_name("5%");
  advise
      ->add_option("--budget", a.advise.budget,
                   "Find the most accurate settings with at most this CPU time per frame of 1/60 s")
      ->type_name("2ms");
  add_repeatable(advise, "/POINTER=VALUE", "--set", a.advise.overrides,
                 "Change a setting, such as /mesh/cells=64. Repeatable");
  add_shown(advise, "--what", a.advise.what,
            "Which error counts. rest: error of the pose at rest; motion: error of the motion; auto: rest "
            "for a pinned cloth with only loads and damping, motion for other scenes")
      ->check(CLI::IsMember({"auto", "rest", "motion"}));
  advise->add_option("--models", a.advise.models, "Try only these models, separated by commas")
      ->delimiter(',');
  advise->add_option("--methods", a.advise.methods, "Try only these solver methods, separated by commas")
      ->delimiter(',');
  add_shown(advise, "--time-limit", a.advise.time_limit,
            "Time limit of the whole search, including the reference: 90s or 5min. Settings that were not "
            "tried in this time are listed");
  advise->add_option("--write", a.advise.write, "Write the config with the advised settings to this file")
      ->type_name("FILE");
  add_shown(advise, "--out", a.options.out, "Folder for the results; the runs go to its subfolder advise");
  add_jobs(advise, a);
  add_json(advise, a, "Print one JSON object");
}

void add_dialect_command(CLI::App& app, Arguments& a) {
  CLI::App* dialect = add_command(
      app, a, "dialect", "Convert a bending number of another engine to a flexural rigidity B, or back",
      [&a] { return dialect_command(a.dialect, a.json); });
  dialect->add_option("NAME", a.dialect.name, "Dialect: a formula of an engine (default: list all dialects)");
  dialect->add_option("FILE", a.dialect.file,
                      "Mesh (.obj, .ply, .off or .stl), or config with a mesh (.json) (default: a grid)");
  dialect->add_option("--rigidity", a.dialect.rigidity,
                      "B in N m: print the engine's number that has this rigidity");
  for (const auto& [name, meaning] : dialect_options())
    dialect->add_option("--" + name, a.dialect.numbers[name], meaning);
  add_repeatable(dialect, "/POINTER=VALUE", "--set", a.dialect.overrides,
                 "Change a setting of the config, such as /mesh/cells=64. Repeatable");
  add_json(dialect, a, "Print one JSON object");
}

void add_mesh_command(CLI::App& app, Arguments& a) {
  CLI::App* mesh = add_command(
      app, a, "mesh", "Check a mesh file and print the quality of its triangles",
      [&a] { return mesh_command(a.mesh_file, a.thresholds, a.bad_triangles, a.mesh_copy, a.json); });
  mesh->add_option("FILE", a.mesh_file, "Mesh: .obj, .ply, .off or .stl")->required();
  mesh->add_option("--bad-triangles", a.bad_triangles,
                   "What to do with a bad mesh: a value of the setting /mesh/bad_triangles")
      ->check(CLI::IsMember(std::vector<std::string>(bad_triangles_names.begin(), bad_triangles_names.end())))
      ->capture_default_str();
  mesh->add_option("--write", a.mesh_copy, "Write the accepted mesh to this file (.obj, .ply or .off)")
      ->type_name("FILE");
  add_shown(
      mesh, "--needle-ratio", a.thresholds.needle_ratio,
      "A triangle is a needle if its longest edge is at least this many times as long as its shortest edge")
      ->check(CLI::Range(1.0, 1e9));
  add_shown(mesh, "--cap-angle", a.thresholds.cap_angle,
            "A triangle is a cap if one of its angles is at least this many degrees")
      ->check(CLI::Range(90.0, 180.0));
  add_shown(mesh, "--small-angle", a.thresholds.small_angle,
            "An angle is small if it is below this many degrees")
      ->check(CLI::Range(0.0, 60.0));
  add_json(mesh, a, "Print one JSON object");
}

void add_fit_command(CLI::App& app, Arguments& a) {
  CLI::App* fit = add_command(
      app, a, "fit", "Find settings of a config, such as rigidities, from measured shapes of cloth at rest",
      [&a] { return fit_command(a.fit, a.json); });
  FitArguments& f = a.fit;
  fit->add_option("config", f.config, "Config of the experiment, with a run for each specimen")->required();
  fit->add_option(
         "--measured", f.measured,
         "File of points on a specimen, in m, in the coordinates of the mesh (the middle of a grid is the "
         "origin): columns x and z along its middle, or x, y and z. Once for each run of the config")
      ->required();
  fit->add_option("--find", f.settings,
                  "JSON pointer of a setting to find; its value in the config is the first guess")
      ->required();
  fit->add_option("--uncertainty", f.uncertainty,
                  "Standard uncertainty of a measured point in m (default and least: from the distances that "
                  "remain, and from the size of the cells)")
      ->check(CLI::PositiveNumber);
  fit->add_option("--set", f.overrides, "Change a setting: /json/pointer=value");
  add_json(fit, a, "Print the result as JSON");
}

void add_fabrics_command(CLI::App& app, Arguments& a) {
  CLI::App* fabrics =
      add_command(app, a, "fabrics",
                  "List fabrics with measured numbers, or read measurements into the settings of a config",
                  [&a] { return fabrics_command(a.fabrics, a.json); });
  FabricsArguments& f = a.fabrics;
  fabrics->add_option(
      "--kes-warp", f.kes_warp,
      "Curve of KES-FB2 along the warp: curvature in 1/cm and moment in gf cm/cm, two columns");
  fabrics->add_option("--kes-weft", f.kes_weft, "Curve of KES-FB2 along the weft");
  fabrics->add_option("--astm", f.astm,
                      "Overhangs of ASTM D1388 at 41.5 degrees: warp, weft or bias, and the overhang in mm");
  fabrics->add_option("--arcsim", f.arcsim, "Material file of ARCSim (JSON)");
  fabrics->add_option("--mass", f.mass, "Mass per area in g/m²")->check(CLI::PositiveNumber);
  add_json(fabrics, a, "Print the list as JSON, with the sources");
}

void add_bench_command(CLI::App& app, Arguments& a) {
  CLI::App* bench = add_command(app, a, "bench", "Measure what the solver costs on this machine",
                                [&a] { return bench_command(a.bench, a.list, a.json); });
  bench
      ->add_option("--filter", a.bench.filter,
                   "Only benchmarks whose names match, and their oracles (the scalar code)")
      ->type_name("REGEX");
  bench->add_flag("--quick", a.bench.quick,
                  "Small meshes and short repetitions: takes seconds instead of minutes");
  add_shown(bench, "--repetitions", a.bench.repetitions, "Number of repetitions; the median is reported")
      ->check(CLI::Range(1, 1000));
  add_shown(bench, "--threads", a.bench.threads,
            "Numbers of threads for benchmarks of whole steps, besides one thread")
      ->check(CLI::Range(1, 256));
  bench->add_flag("--list", a.list, "Only print the names of the benchmarks; measure nothing");
  add_json(bench, a, "Print JSON: the context, and one object per row");
}

void add_documentation(CLI::App& app, Arguments& a, const char* name, const char* summary,
                       std::string (*text)(), Json (*json)()) {
  CLI::App* command = add_command(app, a, name, summary, [&a, text, json] {
    print_text("{}\n", a.json ? json().dump(2) : text());
    return int{exit_ok};
  });
  add_json(command, a, "Print JSON");
}

// The command that checked_read.hpp runs in a separate process.
void add_read_file_command(CLI::App& app, Arguments& a) {
  CLI::App* read = add_command(app, a, "read-file", "Print the record of a run file",
                               [&a] { return print_record(a.run); });
  read->group("");  // --help does not list it
  read->add_option("FILE", a.run)->required();
}

void add_completion_command(CLI::App& app, Arguments& a) {
  CLI::App* completion = add_command(app, a, "completion",
                                     "Print a script that completes the command line in a shell", [&app, &a] {
                                       print_text("{}", completion_script(app, a.run));
                                       return int{exit_ok};
                                     });
  completion->add_option("SHELL", a.run, "The shell, in which to type: source <(bendlab completion bash)")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
}

int test_command() {
  throw UsageError(
      "only the start script in the checkout builds and runs the tests: ./bendlab test [ctest arguments]");
}

/// Prints CLI11's message; for an unknown command, the command that was probably meant.
int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> names;
    for (const CLI::App* command :
         app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); }))
      names.push_back(command->get_name());
    if (std::ranges::find(names, argv[1]) == names.end()) {
      print_text(stderr, "bendlab: there is no command '{}'{}\nCommands: {}\n", argv[1],
                 suggestion(argv[1], names), fmt::join(names, ", "));
      return exit_usage;
    }
  }
  print_text(stderr, "bendlab: {}\nRun with --help for the usage.\n", error.what());
  return exit_usage;
}

}  // namespace

int parsed_command(int argc, char** argv) {
  CLI::App app("Bending models for strain-based cloth simulation, compared by experiment.", "bendlab");
  app.footer(std::string(footer));
  app.set_version_flag("--version", std::string(version_text()));
  app.require_subcommand(1);
  Arguments arguments;
  add_run_commands(app, arguments);
  add_work_commands(app, arguments);
  add_read_commands(app, arguments);
  add_compare_command(app, arguments);
  add_rerun_command(app, arguments);
  add_export_command(app, arguments);
  add_page_commands(app, arguments);
  add_stiffness_command(app, arguments);
  add_advise_command(app, arguments);
  add_dialect_command(app, arguments);
  add_mesh_command(app, arguments);
  add_bench_command(app, arguments);
  add_documentation(app, arguments, "models", "List the bending models: settings, defaults, sources",
                    models_text, models_json);
  add_documentation(app, arguments, "effects", "List the effects: settings, defaults, sources", effects_text,
                    effects_json);
  add_fabrics_command(app, arguments);
  add_fit_command(app, arguments);
  add_documentation(app, arguments, "measures", "List the measures: their metrics, units, meanings and cost",
                    measures_text, measures_json);
  add_documentation(app, arguments, "methods", "List the solver methods: settings, defaults, sources",
                    methods_text, methods_json);
  add_documentation(app, arguments, "schema",
                    "List the settings of a config: units, defaults, ranges, meanings", schema_text,
                    schema_json);
  add_completion_command(app, arguments);
  add_read_file_command(app, arguments);
  add_command(app, arguments, "test", "Build and run the tests (./bendlab test)", test_command)
      ->allow_extras();
  if (argc == 1) {
    print_text(stderr, "{}", app.help());
    return exit_usage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, argc, argv);
  }
  return arguments.command();
}

}  // namespace bendlab
