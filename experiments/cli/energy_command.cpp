// `bendlab energy`: the elastic energies and forces of the poses at the start of runs, without a step.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/json_text.hpp"
#include "bendlab/scene/start_after.hpp"
#include "experiments/campaign/run_labels.hpp"
#include "experiments/cli/shared_options.hpp"
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

std::vector<EnergyPart> parts_of(const RunConfig& config) {
  BuiltScene scene = build_scene(config.scene());
  start_after(config.scene(), scene);
  return energy_parts(scene.input, scene.input.positions);
}

// The flexural rigidity that the scene's bending follows, N m.
std::optional<double> rigidity_of(const Scene& scene) {
  return scene.bending.stiffness == Stiffness::physical ? scene.bending.flexural_rigidity : std::nullopt;
}

// The settings of the scene that its energies leave out.
std::vector<std::string> left_out(const Scene& scene) {
  std::vector<std::string> pointers;
  for (const auto& [pointer, is_given] :
       {std::pair{"/bending/hysteresis", scene.bending.hysteresis.is_given()},
        std::pair{"/bending/plasticity", scene.bending.plasticity.is_given()},
        std::pair{"/bending/over_time", scene.bending.over_time.is_given()},
        std::pair{"/material/strain/over_time", scene.material.strain.over_time.is_given()}})
    if (is_given) pointers.emplace_back(pointer);
  return pointers;
}

Json json_of(const Experiment& experiment, const RunConfig& config, const std::vector<EnergyPart>& parts) {
  Json entry = {
      {"name", experiment.name}, {"run", place_text(experiment, config)}, {"parts", Json::object()}};
  if (const std::vector<std::string> pointers = left_out(config.scene()); !pointers.empty())
    entry["left_out"] = pointers;
  if (const auto rigidity = rigidity_of(config.scene())) entry["flexural_rigidity"] = *rigidity;
  for (const EnergyPart& part : parts) {
    const Forces forces = forces_of(part.forces);
    entry["parts"][part.name] = {{"energy", part.energy},
                                 {"force_sum", {forces.sum.x(), forces.sum.y(), forces.sum.z()}},
                                 {"largest_force", forces.largest}};
  }
  return entry;
}

struct EnergyCommand : Command {
  ConfigArguments configs{*this};

  EnergyCommand() { add(json, "--json", "Print one JSON object per run"); }

  int run() override {
    for (const Experiment& experiment : configs.experiments()) {
      std::vector<std::string> headings = axis_headings(experiment);
      headings.insert(headings.end(),
                      {"part", "energy (J)", "energy / B", "sum of forces (N)", "largest (N)"});
      Table table(std::move(headings));
      std::set<std::string> omitted;
      for (const RunConfig& config : experiment.runs) {
        const std::vector<EnergyPart> parts = parts_of(config);
        for (std::string& pointer : left_out(config.scene())) omitted.insert(std::move(pointer));
        if (json) {
          print_text("{}\n", json_text(json_of(experiment, config, parts)));
          continue;
        }
        for (const EnergyPart& part : parts) {
          const Forces forces = forces_of(part.forces);
          const std::optional<double> rigidity = rigidity_of(config.scene());
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
      if (!json && !omitted.empty())
        print_text("The energies and forces leave out {}.\n\n", fmt::join(omitted, ", "));
    }
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind energy_command{
    "energy", "Print the elastic energies and forces of the pose at the start of every run",
    "bendlab energy configs/verification/half_cylinder.json", make<EnergyCommand>};

}  // namespace bendlab
