#include "experiments/config/config_tables.hpp"

#include <algorithm>
#include <array>

#include "bendlab/io/run_file.hpp"
#include "bendlab/scene/defaults.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 1> allowed = {name_in(run_status_names, RunStatus::implausible)};

constexpr auto not_of_the_run = read_when<RunSettings>([](const RunSettings&) { return false; });
constexpr auto compares = read_when<RunSettings>([](const RunSettings& s) { return s.accuracy.compares(); });

// Formatted by hand, to be read as tables.
// clang-format off
constexpr std::array top = {
    field<&RunSettings::name>({.name = "name",
              .meaning = "Name of the experiment and of its results folder: letters, digits, '_' and '-'",
              .required = true, .read_when = not_of_the_run}),
    field<&RunSettings::description>({.name = "description",
              .meaning = "What the experiment is for; does not affect the runs",
              .read_when = not_of_the_run}),
    field<&RunSettings::allow>({.name = "allow",
              .meaning = "Verdicts that do not make the command fail, but are still printed: implausible, "
                         "for a sweep that studies failure. Does not affect the runs",
              .choices = allowed, .read_when = not_of_the_run}),
    field<&RunSettings::defaults>({.name = "defaults",
              .meaning = "Defaults of the settings that a config does not state. recommended: implicit steps "
                         "(quasi_newton) of a membrane in N/m, sound at every resolution. If the config "
                         "states a setting that only projections read, such as k, recommended has pbd with "
                         "coarse levels instead. fast: fewer iterations, in less time than the paper's "
                         "settings take. reference: implicit steps that converge (newton), slow. paper: the "
                         "settings with which we repeat the paper (adaptive springs with k 0.5, the pin's "
                         "neighbours pinned, one substep of 10 iterations, published shear, gravity alone)",
              .choices = defaults_names, .read_when = not_of_the_run}),
    field<&RunSettings::settled_speed>({.name = "settled_speed", .unit = "m/s",
              .meaning = "The run ends early when no vertex has been faster than this for half a simulated "
                         "second (checked 60 times a simulated second). The summary then has settled_at. 0: "
                         "the run never ends early",
              .minimum = 0}),
};

constexpr std::array accuracy = {
    field<&Accuracy::solver>({.name = "solver",
              .meaning = "List of changes, each \"/json/pointer=value\", that turn this run into a reference "
                         "with the same energies, such as its equilibrium. The summary then has the errors "
                         "against the reference: error_solver_rms and more. The reference is a separate run, "
                         "below <results>/<experiment>/references. Runs that differ only in the settings "
                         "changed here share one reference"}),
    field<&Accuracy::solver_coarser>({.name = "solver_coarser",
              .meaning = "Further changes that make a second reference, half as fine. The distance between "
                         "the two references is error_solver_reference_gap"}),
    field<&Accuracy::physical>({.name = "physical",
              .meaning = "List of changes that turn this run into a reference for the stated cloth. The "
                         "reference may have another model or resolution, because its pose is interpolated "
                         "at this run's vertices. The summary then has error_physical_rms and more"}),
    field<&Accuracy::physical_coarser>({.name = "physical_coarser",
              .meaning = "Further changes that make a second reference, half as fine. The distance between "
                         "the two references is error_physical_reference_gap"}),
    field<&Accuracy::start_from_end>({.name = "start_from_end",
              .meaning = "true: the reference starts where this run ends. In a scene with many equilibria, "
                         "the reference then finds the equilibrium of this run. Each run has its own "
                         "reference",
              .read_when = compares}),
    field<&Accuracy::align>({.name = "align",
              .meaning = "How the reference's pose is moved onto this run's pose before the two are "
                         "compared. none: not at all; vertical: by the best rotation about the vertical "
                         "through the middle of the pins (without pins: of the mesh); rigid: by the best "
                         "rigid motion",
              .choices = align_by_names, .read_when = compares}),
    field<&Accuracy::over_time>({.name = "over_time",
              .meaning = "true: compare all frames that both runs recorded at the same time, instead of only "
                         "the last frames. The errors are then means over the frames, metrics that end in "
                         "_worst are the largest errors, and the energy has an error, too",
              .read_when = compares}),
};

constexpr std::array quality = {
    field<&QualityThresholds::needle_ratio>({.name = "needle_ratio", .unit = "1",
              .meaning = "A triangle is a needle if its longest edge is at least this many times as long as "
                         "its shortest edge",
              .minimum = 1}),
    field<&QualityThresholds::cap_angle>({.name = "cap_angle", .unit = "degrees",
              .meaning = "A triangle is a cap if one of its angles is at least this large",
              .minimum = 90, .maximum = 180}),
    field<&QualityThresholds::small_angle>({.name = "small_angle", .unit = "degrees",
              .meaning = "The metric small_angles counts triangles with an angle below this value",
              .minimum = 0, .maximum = 60}),
};

// clang-format on

std::array<Field, 3> make_output() {
  // clang-format off
  return {
      field<&OutputSettings::frames_per_second>({.name = "frames_per_second", .unit = "1/s",
                .meaning = "Recorded frames per simulated second, at most one frame per step",
                .minimum = 0, .maximum = 1e6, .above = true}),
      field<&OutputSettings::constraints>({.name = "constraints",
                .meaning = "true: the run file lists every constraint; false: only their number and hash"}),
      field<&OutputSettings::measures>({.name = "measures",
                .meaning = "Further measures, besides the measures that every run has; `bendlab measures` "
                           "lists the purpose, the metrics and the cost of each measure",
                .choices = measures_on_request()}),
  };
  // clang-format on
}

constexpr std::array lists = {
    ConfigList{"effects",
               "What acts on the cloth besides its constraints: a list of {\"type\": name, settings}. Only "
               "some types, obstacles for example, may be listed more than once. Absent: gravity, and a "
               "viscous_drag of 1 N s/m³, about the drag of air. An empty list: nothing acts"},
    ConfigList{"sweep",
               "Settings to vary: {\"/json/pointer\": [values]}; \"all\" instead of the list stands for "
               "every choice of a setting. There is one run per combination of values, and the last pointer "
               "varies fastest. A pointer may also name a whole object, or the whole list of effects"},
    ConfigList{"cover",
               "Runs only a part of a large sweep: with \"cover\": 3, every combination of values of any "
               "three axes occurs in at least one run. A greedy search keeps the number of runs small, and "
               "finds the same runs on every machine. Combinations of values that no run can have are left "
               "out, and 'bendlab plan' lists them. Give a number (the strength) or an object"},
    ConfigList{"expect", "Bounds that 'bendlab run' checks on every run, each with its reason"},
    ConfigList{
        "because",
        "Why settings have their values, with sources: {\"/json/pointer\": text}; does not affect the runs"},
};

std::vector<Section> make_sections() {
  std::vector<Section> sections;
  for (const RunPart& part : run_parts())
    sections.push_back({std::string(part.pointer), std::string(part.meaning), rows_of(part.table)});
  std::vector<SettingRow>& first = sections.front().rows;
  const std::vector<SettingRow> of_scene = rows_of(scene_table());
  first.insert(first.end() - 1, of_scene.begin(), of_scene.end());
  sections.insert(sections.begin() + 1, scene_sections().begin(), scene_sections().end());
  return sections;
}

std::array<RunPart, 4> make_run_parts() {
  return {
      RunPart{"", "The experiment", table_of<RunSettings>(top),
              [](const RunSettings& run) -> const void* { return &run; }},
      RunPart{"/output", "What is measured and recorded",
              table_of<OutputSettings>(made_of_kinds<make_output>()),
              [](const RunSettings& run) -> const void* { return &run.output; }},
      RunPart{"/accuracy", "Errors of the run, measured against references", table_of<Accuracy>(accuracy),
              [](const RunSettings& run) -> const void* { return &run.accuracy; }},
      RunPart{"/quality", "When a triangle counts as bad", table_of<QualityThresholds>(quality),
              [](const RunSettings& run) -> const void* { return &run.quality; }},
  };
}

}  // namespace

std::span<const RunPart> run_parts() {
  return made_of_kinds<make_run_parts>();
}

std::span<const Section> config_sections() {
  return made_of_kinds<make_sections>();
}

const Section* find_section(std::string_view pointer) {
  const auto found = std::ranges::find(config_sections(), pointer, &Section::pointer);
  return found == config_sections().end() ? nullptr : &*found;
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

}  // namespace bendlab
