// `bendlab fit`: finds settings of a config from measured shapes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "bendlab/scene/built_scene.hpp"
#include "bendlab/scene/json_text.hpp"
#include "experiments/cli/shared_options.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/fit/fit.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

struct FitCommand : Command {
  std::filesystem::path config;
  std::vector<std::string> overrides, measured, settings;
  std::optional<double> uncertainty;  // of a point, m

  FitCommand() {
    add(config, "CONFIG", "Config of the experiment, with a run for each specimen");
    add(measured, "--measured!",
        "File of points on a specimen, in m, in the coordinates of the mesh (the middle of a grid is the "
        "origin): columns x and z along its middle, or x, y and z. Once for each run of the config");
    add(settings, "--find!", "JSON pointer of a setting to find; its value in the config is the first guess");
    add(uncertainty, "--uncertainty",
        "Standard uncertainty of a measured point in m (default and least: from the distances that "
        "remain, and from the size of the cells)",
        positive);
    add_set(*this, overrides);
    add(json, "--json", "Print the result as JSON");
  }
  FitProblem problem() const;
  int run() override;
};

FitProblem FitCommand::problem() const {
  const Experiment experiment = load_experiment(config, overrides);
  FitProblem problem{.runs = experiment.runs, .shapes = {}, .pointers = settings, .uncertainty = uncertainty};
  if (problem.runs.size() != measured.size())
    throw UsageError(fmt::format(
        "the config has {} runs, but {} files are measured: give --measured once for each specimen, in "
        "the order of the sweep",
        problem.runs.size(), measured.size()));
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const RestMesh rest(rest_mesh_of(problem.runs[r].scene().mesh, problem.runs[r].folder()).mesh);
    try {
      problem.shapes.push_back(read_shape(measured[r], rest.centre().y()));
    } catch (const std::exception& error) {
      throw UsageError(fmt::format("{}: {}", measured[r], error.what()));
    }
  }
  return problem;
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.2g} %", 100 * share) : "not known";
}

int FitCommand::run() {
  const FitProblem problem = this->problem();
  Fitted fitted;
  try {
    fitted = fit(problem);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  Json entry = {{"rms", fitted.rms},
                {"evaluations", fitted.evaluations},
                {"known", fitted.is_known()},
                {"correlation", fitted.correlation},
                {"settings", Json::object()}};
  Table table({"setting", "value", "standard uncertainty", "largest change if a specimen moves by 1 mm"});
  for (const FittedSetting& setting : fitted.settings) {
    entry["settings"][setting.pointer] = {
        {"value", setting.value},
        {"relative_uncertainty",
         std::isfinite(setting.uncertainty) ? Json(setting.uncertainty) : Json(nullptr)},
        {"relative_change_per_metre", setting.change_per_metre}};
    table.add_row({setting.pointer, fmt::format("{:.5g}", setting.value), percent(setting.uncertainty),
                   percent(1e-3 * setting.change_per_metre)});
  }
  if (const auto misplaced = fitted.misplaced()) {
    const Vector3& move = fitted.moves[*misplaced];
    entry["misplaced"] = {{"specimen", *misplaced + 1},
                          {"move", {move.x(), move.y(), move.z()}},
                          {"rms_if_moved", fitted.rms_if_moved}};
  }
  if (json)
    print_text("{}\n", json_text(entry));
  else
    print_text(
        "{}\nThe measured points are {:.3g} mm from the cloth (root mean square), after {} simulations of "
        "all specimens.\n",
        table.text(), 1e3 * fitted.rms, fitted.evaluations);
  if (const auto misplaced = fitted.misplaced()) {
    const Vector3 move = 1e3 * fitted.moves[*misplaced];
    print_text(
        stderr,
        "bendlab: the points of specimen {} probably have another origin than the mesh. If the points "
        "of every specimen may move, and the settings are fitted again, the distance falls from {:.2g} "
        "to {:.2g} mm (root mean square), and this specimen moves by ({:.2g}, {:.2g}, {:.2g}) mm. Check "
        "where the clamp is in the measured coordinates\n",
        *misplaced + 1, 1e3 * fitted.rms, 1e3 * fitted.rms_if_moved, move.x(), move.y(), move.z());
  }
  if (fitted.is_known()) return exit_ok;
  std::vector<std::string> unknown;
  for (const FittedSetting& setting : fitted.settings)
    if (!(setting.uncertainty <= Fitted::known)) unknown.push_back(setting.pointer);
  print_text(stderr,
             "bendlab: the measured points do not determine {}: the uncertainty is above {:.0f} %. Measure a "
             "specimen whose shape depends on it, or fit fewer settings\n",
             fmt::join(unknown, ", "), 100 * Fitted::known);
  return exit_failed;
}

}  // namespace

extern const CommandKind fit_command{
    "fit", "Find settings of a config, such as rigidities, from measured shapes of cloth at rest",
    "bendlab fit strip.json --measured warp.csv --find /bending/flexural_rigidity", make<FitCommand>};

}  // namespace bendlab
