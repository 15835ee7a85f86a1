#include "experiments/config/config_tables.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "bendlab/parameters/names.hpp"
#include "bendlab/scene/defaults.hpp"
#include "experiments/config/cover.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {
namespace {

constexpr std::array listed_measures_on_request = {
#define BENDLAB_MEASURE(name)
#define BENDLAB_MEASURE_ON_REQUEST(name) std::string_view(#name),
#include "experiments/measures/measures.def"
#undef BENDLAB_MEASURE
#undef BENDLAB_MEASURE_ON_REQUEST
};

std::vector<std::string_view>& measures_on_request() {
  static std::vector<std::string_view> names(listed_measures_on_request.begin(),
                                             listed_measures_on_request.end());
  return names;
}

constexpr std::array<std::string_view, 1> allowed = {name_in(run_status_names, RunStatus::implausible)};

constexpr double seed_limit = 4294967295;  // 2³² - 1: fits every generator

constexpr auto not_of_the_run = read_when<RunSettings>([](const RunSettings&) { return false; });
constexpr auto compares = read_when<RunSettings>([](const RunSettings& s) { return s.accuracy.compares(); });

// Formatted by hand, to be read as tables.
// clang-format off
constexpr std::array top = {
    field<&RunSettings::name>({.name = "name",
              .meaning = "Name of the experiment and of its results folder: letters, digits, '_' and '-'",
              .required = true, .read_when = not_of_the_run}),
    field<&RunSettings::description>({.name = "description",
              .meaning = "What the experiment is for; does not affect its runs",
              .read_when = not_of_the_run}),
    field<&RunSettings::allow>({.name = "allow",
              .meaning = "Verdicts that do not fail the command: implausible, for a sweep that studies "
                         "failure. The verdict is still printed; does not affect the runs",
              .choices = allowed, .read_when = not_of_the_run}),
    field<&RunSettings::defaults>({.name = "defaults",
              .meaning = "Which settings a config gets that it does not state. recommended: implicit steps "
                         "(quasi_newton) of a membrane in N/m, sound at every resolution; "
                         "pbd with coarse levels where a config states what only projections take, k for "
                         "example; fast: fewer iterations, in less time than the paper's settings take; "
                         "reference: implicit steps that converge (newton), slow; paper: those with which we "
                         "repeat the paper (adaptive springs with k 0.5, the pin's neighbours pinned, one "
                         "substep of 10 iterations, published shear, gravity alone)",
              .choices = defaults_names, .read_when = not_of_the_run}),
    field<&RunSettings::settled_speed>({.name = "settled_speed", .unit = "m/s",
              .meaning = "The run ends early when no vertex has been faster than this for half a simulated "
                         "second (checked 60 times a simulated second); its summary then has settled_at. "
                         "0: it never ends early",
              .minimum = 0}),
};

constexpr std::array accuracy = {
    field<&Accuracy::solver>({.name = "solver",
              .meaning = "Changes, each \"/json/pointer=value\", that turn this run into a reference with "
                         "the same energies, its equilibrium for example; the summary then has the errors "
                         "against it, error_solver_rms and others. The reference is a separate run, below "
                         "<results>/<experiment>/references, computed once for all runs that differ only in "
                         "what is changed here"}),
    field<&Accuracy::solver_coarser>({.name = "solver_coarser",
              .meaning = "Further changes that make a second reference, half as fine; its distance from the "
                         "first one is error_solver_reference_gap"}),
    field<&Accuracy::physical>({.name = "physical",
              .meaning = "Changes that turn this run into the stated cloth, even with another model or "
                         "resolution; the summary then has error_physical_rms and others. The reference's "
                         "pose is interpolated at this run's vertices"}),
    field<&Accuracy::physical_coarser>({.name = "physical_coarser",
              .meaning = "Further changes that make a second reference, half as fine; its distance from the "
                         "first one is error_physical_reference_gap"}),
    field<&Accuracy::start_from_end>({.name = "start_from_end",
              .meaning = "true: the reference starts where this run ends, so that both come to the same "
                         "equilibrium if the scene has many. Each run then has its own reference",
              .read_when = compares}),
    field<&Accuracy::align>({.name = "align",
              .meaning = "How the reference's pose is moved onto this run's before they are compared. none: "
                         "not at all; vertical: by the best rotation about the vertical through the middle "
                         "of the pins (without pins: of the mesh); rigid: by the best rigid motion",
              .choices = align_by_names, .read_when = compares}),
    field<&Accuracy::over_time>({.name = "over_time",
              .meaning = "true: compare all frames that both recorded at the same time, instead of the last "
                         "frame of each. The errors are then means over these frames, with the largest as "
                         "…_worst, and the error of the energy is among them", .read_when = compares}),
};

constexpr std::array quality = {
    field<&QualityThresholds::needle_ratio>({.name = "needle_ratio", .unit = "1",
              .meaning = "A triangle is a needle if its longest edge is at least this many times its "
                         "shortest",
              .minimum = 1}),
    field<&QualityThresholds::cap_angle>({.name = "cap_angle", .unit = "degrees",
              .meaning = "A triangle is a cap if one of its angles is at least this large",
              .minimum = 90, .maximum = 180}),
    field<&QualityThresholds::small_angle>({.name = "small_angle", .unit = "degrees",
              .meaning = "The metric small_angles counts triangles with an angle below this",
              .minimum = 0, .maximum = 60}),
};

constexpr std::array cover_fields = {
    field<&Cover::strength>({.name = "strength", .unit = "1",
              .meaning = "Every combination of the values of this many axes occurs in some run: 2 covers "
                         "every pair of values",
              .minimum = 1, .maximum = 6, .required = true}),
    field<&Cover::seed>({.name = "seed", .unit = "1",
              .meaning = "Another seed gives other runs that cover as much",
              .minimum = 0, .maximum = seed_limit}),
};

constexpr std::array expectation = {
    field<&Expectation::metric>({.name = "metric",
              .meaning = "Name of a number in the run's summary",
              .required = true}),
    field<&Expectation::minimum>({.name = "min",
              .meaning = "Smallest value that is right, in the metric's unit; give min, max or both"}),
    field<&Expectation::maximum>({.name = "max",
              .meaning = "Largest value that is right, in the metric's unit"}),
    field<&Expectation::why>({.name = "why",
              .meaning = "Where the bound comes from",
              .required = true}),
};
// clang-format on

const std::array<Field, 3>& output() {
  // clang-format off
  static const std::array<Field, 3> table = {
      field<&OutputSettings::frames_per_second>({.name = "frames_per_second", .unit = "1/s",
                .meaning = "Recorded frames per simulated second, at most one a step",
                .minimum = 0, .maximum = 1e6, .above = true}),
      field<&OutputSettings::constraints>({.name = "constraints",
                .meaning = "true: the run file lists every constraint; false: only their counts and hash"}),
      field<&OutputSettings::measures>({.name = "measures",
                .meaning = "Measures to take in addition to those that every run has; `bendlab measures` "
                           "says what each finds out, the names of its numbers, and its cost",
                .choices = measures_on_request()}),
  };
  // clang-format on
  return table;
}

constexpr std::array lists = {
    ConfigList{"effects",
               "What acts on the cloth besides its constraints: a list of {\"type\": name, settings}. Only "
               "some types, obstacles for example, may be listed more than once. Absent: gravity and "
               "viscous_drag of 1 N s/m³, about that of air; an empty list: nothing"},
    ConfigList{"sweep",
               "What to vary: {\"/json/pointer\": [values]}; \"all\" instead of the list stands for every "
               "choice of a setting. There is one run per combination, and the last pointer varies fastest. "
               "A pointer may also name a whole object, or the whole list of effects"},
    ConfigList{"cover",
               "Runs a part of a large sweep: with \"cover\": 3 every combination of values of any three "
               "axes occurs in at least one run. A greedy search keeps the runs few; they are the same on "
               "every machine. Values that do not go together are left out, and 'bendlab plan' lists them. "
               "A number (the strength), or an object"},
    ConfigList{"expect", "Bounds that 'bendlab run' checks on every run, each with its reason"},
    ConfigList{"because",
               "Why settings are as they are, with sources: {\"/json/pointer\": text}; does not affect the "
               "runs"},
};

std::vector<Section> make_sections() {
  std::vector<Section> sections = {{"", "The experiment", rows_of(run_table())}};
  std::vector<SettingRow>& first = sections.front().rows;
  const std::vector<SettingRow> of_scene = rows_of(scene_table());
  first.insert(first.end() - 1, of_scene.begin(), of_scene.end());
  std::ranges::copy(scene_sections(), std::back_inserter(sections));
  sections.push_back({"/output", "What is measured and recorded", rows_of(output_table())});
  sections.push_back(
      {"/accuracy", "Errors of the run, measured against references", rows_of(accuracy_table())});
  sections.push_back({"/quality", "When a triangle counts as bad", rows_of(quality_table())});
  return sections;
}

}  // namespace

const FieldTable& run_table() {
  static const FieldTable table = table_of<RunSettings>(top);
  return table;
}

const FieldTable& output_table() {
  static const FieldTable table = table_of<OutputSettings>(output());
  return table;
}

const FieldTable& accuracy_table() {
  static const FieldTable table = table_of<Accuracy>(accuracy);
  return table;
}

const FieldTable& quality_table() {
  static const FieldTable table = table_of<QualityThresholds>(quality);
  return table;
}

const FieldTable& cover_table() {
  static const FieldTable table = table_of<Cover>(cover_fields);
  return table;
}

const FieldTable& expectation_table() {
  static const FieldTable table = table_of<Expectation>(expectation);
  return table;
}

std::span<const Section> config_sections() {
  static const std::vector<Section> sections = make_sections();
  return sections;
}

const Section* find_section(std::string_view pointer) {
  const auto found = std::ranges::find(config_sections(), pointer, &Section::pointer);
  return found == config_sections().end() ? nullptr : &*found;
}

void add_measure_on_request(std::string_view name) {
  measures_on_request().push_back(name);
}

std::string_view section_key(const Section& section) {
  return std::string_view(section.pointer).substr(section.pointer.rfind('/') + 1);
}

std::vector<const Section*> child_sections(std::string_view pointer) {
  std::vector<const Section*> children;
  for (const Section& section : config_sections())
    if (!section.pointer.empty() && section.pointer.substr(0, section.pointer.rfind('/')) == pointer)
      children.push_back(&section);
  return children;
}

std::span<const ConfigList> config_lists() {
  return lists;
}

std::string_view expectation_where_meaning() {
  return "Checks only runs that have these values: {\"/json/pointer\": value}; absent: every run";
}

}  // namespace bendlab
