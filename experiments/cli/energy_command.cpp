// `bendlab energy`: the elastic energies and forces of the poses at the start of runs, without a step.
#include <fmt/format.h>

#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/start_after.hpp"
#include "experiments/campaign/run_labels.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

struct Forces {
  Vector3 sum = Vector3::Zero();  // N
  double largest = 0;             // N
};

Forces forces_of(const Positions& forces) {
  Forces result;
  result.sum = forces.colwise().sum().transpose();
  for (const auto force : forces.rowwise()) result.largest = std::max(result.largest, force.norm());
  return result;
}

struct Evaluated {
  std::vector<EnergyPart> parts;
  bool leaves_out = false;  // whether the scene has laws that the energies leave out
};

constexpr std::string_view left_out = "hysteresis, plasticity, over_time";

Evaluated evaluated(const RunConfig& config) {
  BuiltScene scene = build_scene(config.scene());
  start_after(config.scene(), scene);
  return {energy_parts(scene.input, scene.input.positions), has_history(scene.input)};
}

Json json_of(const Experiment& experiment, const RunConfig& config, const Evaluated& evaluated) {
  Json entry = {
      {"name", experiment.name}, {"run", place_text(experiment, config)}, {"parts", Json::object()}};
  if (evaluated.leaves_out) entry["left_out"] = left_out;
  if (config.scene().bending.flexural_rigidity)
    entry["flexural_rigidity"] = *config.scene().bending.flexural_rigidity;
  for (const EnergyPart& part : evaluated.parts) {
    const Forces forces = forces_of(part.forces);
    entry["parts"][part.name] = {{"energy", part.energy},
                                 {"force_sum", {forces.sum.x(), forces.sum.y(), forces.sum.z()}},
                                 {"largest_force", forces.largest}};
  }
  return entry;
}

}  // namespace

int energy_command(const ConfigArguments& configs, bool json) {
  for (const Experiment& experiment : load_experiments(configs)) {
    std::vector<std::string> headings = axis_headings(experiment);
    headings.insert(headings.end(), {"part", "energy (J)", "energy / B", "sum of forces (N)", "largest (N)"});
    Table table(std::move(headings));
    bool leaves_out = false;
    for (const RunConfig& config : experiment.runs) {
      const Evaluated start = evaluated(config);
      leaves_out |= start.leaves_out;
      if (json) {
        print_text("{}\n", json_text(json_of(experiment, config, start)));
        continue;
      }
      for (const EnergyPart& part : start.parts) {
        const Forces forces = forces_of(part.forces);
        const auto& rigidity = config.scene().bending.flexural_rigidity;
        std::vector<std::string> cells = axis_cells(experiment, config);
        cells.insert(cells.end(),
                     {part.name, format_number(part.energy),
                      part.name == "strain" || !rigidity ? "" : format_number(part.energy / *rigidity),
                      fmt::format("{:.2g}", forces.sum.norm()), format_number(forces.largest)});
        table.add_row(std::move(cells));
      }
    }
    if (!json)
      print_text("{}: elastic energies and forces of the pose at the start\n\n{}\n", experiment.name,
                 table.text());
    if (!json && leaves_out)
      print_text("These are energies and forces at the stated stiffness, without {}\n\n", left_out);
  }
  return exit_ok;
}

}  // namespace bendlab
