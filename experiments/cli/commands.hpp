// The commands of the command line. A command returns its exit code, or throws (see errors.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
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

/// The experiments of all configs. Throws one ConfigsError with the problems of all configs.
std::vector<Experiment> load_experiments(const ConfigArguments& configs);

/// Computes the runs of configs that belong to `shard` (text as in shard_of(); empty: all runs). `explain`:
/// prints the step plan of every run instead of the tables. `strict`: warnings are errors, and nothing is
/// computed if there are warnings before the runs begin.
int run_command(const ConfigArguments& configs, const CampaignOptions& options, const std::string& shard,
                bool json, bool explain, bool strict);
/// Lists the runs of configs, and which of them are complete, being computed, failed or missing.
int plan_command(const ConfigArguments& configs, const std::filesystem::path& out, bool json);
/// Prints the elastic energies and forces of the poses at the start of all runs, without a step.
int energy_command(const ConfigArguments& configs, bool json);
/// Checks configs. `strict`: builds every run, and treats warnings as errors.
int validate_command(const ConfigArguments& configs, bool strict);

/// What is printed on stdout about the runs.
enum class Report { tables, lines, json, explanations };

/// Computes the runs of the experiments. Prints a report of each experiment when its last run is over, or a
/// line of JSON or a step plan for each run. Leaves out runs that were not started because of a signal.
/// `strict`: warnings are errors. Returns the exit code.
int run_and_report(const std::vector<Experiment>& experiments, CampaignOptions options, Report report,
                   bool strict = false, Shard shard = {});

struct ReproduceArguments {
  std::string what = "everything";  ///< one of reproducible()
  /// Folder for runs and pages. Empty: the checkout's folder results for runs, and results/own for pages.
  std::filesystem::path out;
  bool committed = false;  ///< replace the committed page, below the checkout's results
  bool full = false;       ///< also run the configs whose names end in _full
  bool quick = false;      ///< leave out configs whose names end in _slow
};

/// The names that ReproduceArguments::what may have, the default first.
std::vector<std::string> reproducible();

/// Runs the experiments, writes their page with figures and checks into a folder with the page's name, and
/// prints what differs from the committed page.
int reproduce_command(CampaignOptions options, const ReproduceArguments& arguments);

/// Files with measurements, and the mass per area in g/m².
struct FabricsArguments {
  std::string kes_warp, kes_weft, astm, arcsim;
  std::optional<double> mass;
};
/// Lists the fabrics by name, or prints the settings that measurements mean.
int fabrics_command(const FabricsArguments& arguments, bool json);

struct FitArguments {
  std::filesystem::path config;
  std::vector<std::string> overrides;  ///< "/json/pointer=value"
  std::vector<std::string> measured;   ///< files of points, one for each run of the config
  std::vector<std::string> settings;   ///< JSON pointers
  std::optional<double> uncertainty;   ///< of a point, m
};
/// Finds settings from measured shapes. Returns 1 if the data cannot tell a setting.
int fit_command(const FitArguments& arguments, bool json);

struct ListArguments {
  std::string folder = "results";
  std::vector<std::string> where;  ///< "/json/pointer=value": list only runs with these values
  std::string sort;                ///< a metric of the summary, or a pointer into the config; empty: by path
};
int list_command(const ListArguments& arguments, bool json);

/// Prints a run. `run`: a run file, a folder with a run file, or the beginning of the id of a run in
/// `folder`.
int show_command(const std::string& run, const std::filesystem::path& folder, bool json);

struct CompareArguments {
  std::string one, other;          ///< runs as in show_command(), or two folders of sweeps
  std::string folder = "results";  ///< the folder in which to look for ids
};
/// Prints what differs between two runs, or between two sweeps point by point.
int compare_command(const CompareArguments& arguments, bool json);

struct RerunArguments {
  std::string run;
  std::string folder = "results";  ///< the folder in which to look for an id
  std::filesystem::path out;       ///< folder for the new run; empty: the new run is not kept
};
/// Computes a run again from its file. Exit code 1 if a bit differs.
int rerun_command(const RerunArguments& arguments, bool json);

struct ExportArguments {
  std::string run;
  std::string folder = "results";  ///< the folder in which to look for an id
  std::string format;              ///< one of export_formats()
  std::filesystem::path to;        ///< empty: export/<format> beside the run file
  std::string frames;              ///< "FIRST:LAST:STEP"; empty: all
  std::string up;                  ///< "y" or "z"; empty: do not turn the run
  bool force = false;              ///< replace files of an earlier export
};

/// Names and summaries of the formats.
std::vector<std::pair<std::string, std::string>> export_formats();

/// Writes a run for other programs.
int export_command(const ExportArguments& arguments, bool json);

struct PageArguments {
  std::vector<std::string>
      results;                     ///< folders with runs, run files, sweep files, configs, beginnings of ids
  std::string folder = "results";  ///< the folder in which to look for ids
  std::filesystem::path out;       ///< the page's file; empty: beside the results, for view in the cache
  std::vector<std::string> play;   ///< runs to be animated, by id or folder; empty: a selection
  std::string figures;             ///< file format of the charts (svg, pdf, png); empty: no files
  std::string x, y;      ///< axes of one more chart: metrics or pointers of settings; empty: no chart
  bool live = false;     ///< serve a run that is being computed
  bool no_open = false;  ///< print where the page is, but do not open it
};

/// Writes a page of any runs, and prints the path of the page.
int report_command(const PageArguments& arguments);

/// Writes the same page and opens it in the browser. With `live`, serves at 127.0.0.1 the page of a run that
/// is being computed.
int view_command(const PageArguments& arguments);

struct StiffnessArguments {
  std::optional<double> clamp_offset, exclude;  ///< m, see StripSettings
  std::int64_t frame = -1;                      ///< negative: from the end
  bool profile = false;                         ///< also print the slices of the strip
};

/// Prints how stiff the cantilever strip of a run is; `run` as in show_command(). Throws
/// std::invalid_argument if the run has no such strip.
int stiffness_command(const std::string& run, const std::filesystem::path& folder,
                      const StiffnessArguments& arguments, bool json);

struct AdviseArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< "/json/pointer=value"
  std::string error, budget;           ///< "5%" or "2ms"; exactly one of the two is given
  std::string what = "auto";           ///< rest, motion or auto
  std::string time_limit = "120s";
  std::vector<std::string> models;   ///< empty: every registered one
  std::vector<std::string> methods;  ///< empty: all that advise can try
  std::filesystem::path write;       ///< file for the advised config; empty: no file
};

/// Finds the model, method, substeps, iterations and precision for a scene, by runs below <out>/advise. Exit
/// code 1 if no setting meets the demand.
int advise_command(const AdviseArguments& arguments, const CampaignOptions& campaign, bool json);

struct DialectArguments {
  std::string name;                                      ///< empty: list all dialects
  std::filesystem::path file;                            ///< mesh, or config (.json); empty: a grid
  std::vector<std::string> overrides;                    ///< of the config: "/json/pointer=value"
  std::map<std::string, std::optional<double>> numbers;  ///< by the names of dialect_options()
  std::optional<double> rigidity;                        ///< N m, to be converted to the engine's number
};

/// The names of all numbers that dialects have, and their meanings.
std::vector<std::pair<std::string, std::string>> dialect_options();

/// Converts a number by which another engine states bending to a flexural rigidity on a mesh, or back.
int dialect_command(const DialectArguments& arguments, bool json);

/// Prints the diagnosis and quality of the mesh that `policy` (one of bad_triangles_names) makes of a mesh
/// file. If the policy refuses the file, prints what the other policies would do. If `write` is not empty,
/// writes the accepted mesh to this file.
int mesh_command(const std::filesystem::path& file, const QualityThresholds& thresholds,
                 std::string_view policy, const std::filesystem::path& write, bool json);

}  // namespace bendlab
