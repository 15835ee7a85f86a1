// The commands behind the command line. Each returns its exit code, or throws (see errors.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/mesh/quality.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/campaign/campaign.hpp"

namespace bendlab {

struct ConfigArguments {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> overrides;  ///< "/json/pointer=value"
  std::vector<std::string> axes;       ///< "/json/pointer=value,value", added to the sweep
};

/// All of them, or one ConfigsError with the problems of all.
std::vector<Experiment> load_experiments(const ConfigArguments& configs);

/// `explain`: the step plan of every run instead of the tables; `strict`: warnings are errors, and nothing is
/// computed if some are known before the runs.
int run_command(const ConfigArguments& configs, const CampaignOptions& options, bool json, bool explain,
                bool strict);
/// `write`: where to write the plan for work_command(); empty: nowhere.
int plan_command(const ConfigArguments& configs, const std::filesystem::path& out,
                 const std::filesystem::path& write, bool json);
int validate_command(const ConfigArguments& configs, bool strict);

/// How the runs are reported on stdout.
enum class Report { tables, lines, json, explanations };

/// Runs them; prints an experiment as soon as its last run is over, or each run as a line of JSON. Runs that
/// were not started because of a signal are left out. `strict`: warnings are errors. Returns the exit code.
int run_and_report(const std::vector<Experiment>& experiments, CampaignOptions options, Report report,
                   bool strict = false);

struct ReproduceArguments {
  std::string what = "everything";  ///< one of reproducible()
  /// For runs and pages. Empty: runs go to the checkout's results, the page to results/own there.
  std::filesystem::path out;
  bool committed = false;  ///< the page is the committed one, below the checkout's results
  bool full = false;       ///< with the configs whose names end in _full
  bool quick = false;      ///< without those whose names end in _slow
};

/// What there is to reproduce, the default first.
std::vector<std::string> reproducible();

/// Its experiments, then the page of figures and checks, in a folder of its name; then what differs from the
/// committed page.
int reproduce_command(CampaignOptions options, const ReproduceArguments& arguments);

struct WorkArguments {
  std::filesystem::path plan;
  std::string shard;  ///< "i/n"; empty: 0/1
};
/// Computes runs of a plan together with other processes.
int work_command(const WorkArguments& arguments, CampaignOptions options, bool json);

/// How far the runs of a plan are, wherever they are computed.
int status_command(const std::filesystem::path& plan, bool json);

struct SubmitArguments {
  int tasks = 0;                    ///< of the job array; 0: as many as last a minute each
  int cpus = 1;                     ///< of a task
  std::string time;                 ///< limit of a task, as sbatch takes it; empty: the cluster's own
  std::vector<std::string> sbatch;  ///< further options for sbatch
  bool dry_run = false;             ///< print the batch file, and write nothing
};
/// Writes a plan and its batch file below <out>/plans, and hands it to Slurm.
int submit_command(const ConfigArguments& configs, const std::filesystem::path& out,
                   const SubmitArguments& arguments);

struct ListArguments {
  std::string folder = "results";
  std::vector<std::string> where;  ///< "/json/pointer=value": runs whose config has these values
  std::string sort;                ///< a number of the summary, or a pointer into the config; empty: by path
};
int list_command(const ListArguments& arguments, bool json);

/// `run`: a run file, a folder with one, or the beginning of a run's id, looked for in `folder`.
int show_command(const std::string& run, const std::filesystem::path& folder, bool json);

struct CompareArguments {
  std::string one, other;          ///< runs as in show_command(), or two folders of sweeps
  std::string folder = "results";  ///< where ids are looked for
};
/// What differs between two runs, or between two sweeps point by point.
int compare_command(const CompareArguments& arguments, bool json);

struct RerunArguments {
  std::string run;
  std::string folder = "results";  ///< where an id is looked for
  std::filesystem::path out;       ///< empty: the repetition is compared and not kept
};
/// Computes a run again from its file. Exit code 1 if a bit differs.
int rerun_command(const RerunArguments& arguments, bool json);

struct ExportArguments {
  std::string run;
  std::string folder = "results";  ///< where an id is looked for
  std::string format;              ///< one of export_formats()
  std::filesystem::path to;        ///< empty: export/<format> beside the run file
  std::string frames;              ///< "FIRST:LAST:STEP"; empty: all
  std::string up;                  ///< "y" or "z"; empty: as the run has it
  bool force = false;              ///< replace what is there
};

/// Names and summaries of the formats.
std::vector<std::pair<std::string, std::string>> export_formats();

/// Writes a run for other programs.
int export_command(const ExportArguments& arguments, bool json);

struct PageArguments {
  std::vector<std::string>
      results;                     ///< folders with runs, run files, sweep files, configs, beginnings of ids
  std::string folder = "results";  ///< where ids are looked for
  std::filesystem::path out;       ///< of the page; empty: beside the results, or for view in the cache
  std::vector<std::string> play;   ///< runs to be played, by id or folder; empty: a choice
  std::string figures;             ///< format of files of the charts (svg, pdf, png); empty: none
  std::string x, y;                ///< numbers of a chart of its own, or pointers of settings; empty: none
  bool live = false;               ///< serve a run that is going on
  bool no_open = false;            ///< print where the page is, and leave the browser alone
};

/// Writes the page of any runs, and prints where it is.
int report_command(const PageArguments& arguments);

/// The same page, opened in the browser; with `live` the page of a run that is going on, served at 127.0.0.1.
int view_command(const PageArguments& arguments);

struct StiffnessArguments {
  std::optional<double> clamp_offset, exclude;  ///< m, see StripSettings
  std::int64_t frame = -1;                      ///< negative: from the end
  bool profile = false;                         ///< with the slices of the strip
};

/// How stiff the cantilever strip of a run is; `run` as above. Throws std::invalid_argument if it is none.
int stiffness_command(const std::string& run, const std::filesystem::path& folder,
                      const StiffnessArguments& arguments, bool json);

struct AdviseArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< "/json/pointer=value"
  std::string error, budget;           ///< "5%" or "2ms": one of the two
  std::string what = "auto";           ///< rest, motion or auto
  std::string time_limit = "120s";
  std::vector<std::string> models;   ///< empty: every registered one
  std::vector<std::string> methods;  ///< empty: all that advice is given on
  std::filesystem::path write;       ///< empty: the config is not written
};

/// Which model, method, substeps, iterations and precision to take for a scene, from runs below <out>/advise.
/// Exit code 1 if no setting meets the demand.
int advise_command(const AdviseArguments& arguments, const CampaignOptions& campaign, bool json);

/// Measures what the solver costs here. `list`: names the benchmarks and measures nothing.
int bench_command(const BenchOptions& options, bool list, bool json);

/// Diagnosis and quality of a mesh file as the policy (of bad_triangles_names) accepts it; if it refuses the
/// mesh, what the other policies would do. The accepted mesh is written to the file `write`, if not empty.
int mesh_command(const std::filesystem::path& file, const QualityThresholds& thresholds,
                 std::string_view policy, const std::filesystem::path& write, bool json);

}  // namespace bendlab
