#include "experiments/run/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bendlab/solver/method.hpp"
#include "experiments/run/warning_messages.hpp"

namespace bendlab {
namespace {

// A run that failed has the code "apart", or "fall" if free cloth did not fall as forces demand.
struct Remedy {
  std::string_view code, text;
  bool (*helps)(const BuiltScene& scene);
};

const MethodKind& method_of(const BuiltScene& scene) {
  return scene.input.method.kind();
}

// Whether the method has a setting `name` with this value.
bool has(const BuiltScene& scene, std::string_view name, const Value& value) {
  const Field* const setting = method_of(scene).settings.find(name);
  return setting != nullptr && setting->of(scene.input.method.settings()) == value;
}

bool factorises(const BuiltScene& scene, Factorised what) {
  return method_of(scene).factorised == what;
}

bool lacks_tethers(const BuiltScene& scene) {
  return !scene.pins.all.empty() && std::ranges::none_of(scene.effects, [](const Effect& effect) {
    return effect.kind().helps_projection;
  });
}

// Whether any spring is longer at rest than the distance of its vertices in the rest shape.
bool is_prestressed(const BuiltScene& scene) {
  constexpr double longer = 1.001;
  const DistanceConstraints& springs = scene.input.distance;
  for (std::size_t c = 0; c < springs.size(); ++c) {
    const auto [a, b] = springs.vertices[c];
    if (springs.rest(c) > longer * (scene.rest.position(a) - scene.rest.position(b)).norm()) return true;
  }
  return false;
}

// experiments/measure_remedies.py has a trial of each remedy, except of double precision and of the last two.
// In trials by hand, a strip gained 0.21 of its energy scale with bdf2 and 10 iterations. With euler it
// gained 0.06 in 3 iterations, 0.015 in 10, and nothing in 30.
constexpr std::array all_remedies = {
    Remedy{"unconverged", "{projections} /solver/substeps × 1 iteration, which make as many projections",
           [](const BuiltScene& scene) { return scene.input.settings.iterations > 1; }},
    Remedy{"unconverged", "twice the /solver/substeps, which leave about a third of the strain",
           [](const BuiltScene& scene) { return scene.input.settings.iterations <= 1; }},
    Remedy{"unconverged", "the effect tethers", lacks_tethers},

    Remedy{"lagging", "more /solver/iterations, or the method quasi_newton, which needs fewer",
           [](const BuiltScene& scene) { return factorises(scene, Factorised::nothing); }},
    Remedy{"lagging", "more /solver/iterations",
           [](const BuiltScene& scene) {
             return !factorises(scene, Factorised::nothing) && !has_obstacle(scene);
           }},
    Remedy{"lagging", "/solver/membrane: auto",
           [](const BuiltScene& scene) {
             return has(scene, "membrane", "stated") && scene.input.strain.size() > 0 && !has_obstacle(scene);
           }},
    Remedy{
        "lagging", "more /solver/substeps, because the cloth may touch something",
        [](const BuiltScene& scene) { return factorises(scene, Factorised::blocks) && has_obstacle(scene); }},
    Remedy{"lagging", "more /solver/substeps and iterations, because the cloth may touch something",
           [](const BuiltScene& scene) {
             return factorises(scene, Factorised::scalars) && has_obstacle(scene);
           }},

    Remedy{"fall", "/solver/precision: auto or double",
           [](const BuiltScene& scene) {
             return method_of(scene).projects && scene.precision == Precision::single_precision;
           }},

    // Forward sweeps add energy if substeps are short; in a trial they did with 256 substeps per step.
    Remedy{"apart", "/solver/sweep: symmetric",
           [](const BuiltScene& scene) {
             return has(scene, "sweep", "forward") && scene.input.settings.substeps >= 200;
           }},
    Remedy{"apart", "/bending/k: 0.1, or another /bending/model such as isometric",
           [](const BuiltScene& scene) { return method_of(scene).projects && is_prestressed(scene); }},
    Remedy{"apart", "the effect tethers",
           [](const BuiltScene& scene) { return method_of(scene).projects && lacks_tethers(scene); }},
    // The limit does not help in steps of 1/60 s, but in steps of 1/15 s.
    Remedy{"apart", "/solver/flight_limit: 0.25",
           [](const BuiltScene& scene) {
             const SolverSettings& solver = scene.input.settings;
             return has(scene, "flight_limit", 0.0) && solver.dt / solver.substeps > 1.0 / 20;
           }},
    Remedy{"apart", "/material/strain/form: angle",
           [](const BuiltScene& scene) {
             return method_of(scene).projects && scene.pins.all.empty() &&
                    scene.input.strain_stiffness.form == StrainForm::normalised;
           }},
    Remedy{"apart", "/solver/substeps: 10, with the same /solver/iterations",
           [](const BuiltScene& scene) {
             return method_of(scene).projects && !scene.pins.all.empty() &&
                    scene.input.settings.substeps < 10;
           }},
    Remedy{"apart", "/solver/integrator: euler, which damps more",
           [](const BuiltScene& scene) {
             return factorises(scene, Factorised::scalars) && has(scene, "integrator", "bdf2");
           }},
    Remedy{"apart", "/solver/iterations: 30",
           [](const BuiltScene& scene) {
             return factorises(scene, Factorised::scalars) && scene.input.settings.iterations < 30;
           }},
};

}  // namespace

std::string remedies_for(std::string_view code, const BuiltScene& scene) {
  std::vector<std::string> texts;
  const SolverSettings& solver = scene.input.settings;
  for (const Remedy& remedy : all_remedies)
    if (remedy.code == code && remedy.helps(scene))
      texts.push_back(fmt::format(fmt::runtime(remedy.text),
                                  fmt::arg("projections", solver.substeps * solver.iterations)));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string remedies_for(Bound bound, const BuiltScene& scene) {
  return remedies_for(bound == Bound::momentum || bound == Bound::fall ? "fall" : "apart", scene);
}

}  // namespace bendlab
