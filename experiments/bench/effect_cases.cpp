// Times an effect's passes during the steps of a cloth on which the effect acts, from 10³ to 10⁶ vertices.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {
namespace {

constexpr int effect_warm_up = 20;

/// An effect, and a scene in which the effect changes the cloth.
struct EffectScene {
  std::string_view effect, settings;  ///< its type, and its further settings as JSON
  std::string_view scene;             ///< the other parts of the scene, as JSON
  std::string_view before = "";       ///< effects that are listed before it, as JSON
};

// Obstacles push into the cloth from below, so that the contact lasts.
constexpr std::string_view pinned_sides = R"("pins": {"vertices": ["left", "right"], "ring": 0})";
constexpr std::string_view no_pins = R"("pins": {"vertices": []})";

constexpr std::array effect_scenes = {
    EffectScene{"gravity", R"("acceleration": [0, 0, -9.81])", pinned_sides},
    EffectScene{"rigid_damping", R"("rate": 1)", pinned_sides},
    EffectScene{"constraint_damping", R"("rate": 1)", pinned_sides},
    EffectScene{"tethers", R"("per_vertex": 1)", pinned_sides},
    EffectScene{"viscous_drag", R"("coefficient": 1)", pinned_sides},
    EffectScene{"wind", R"("velocity": [0, 5, 0])", pinned_sides},
    EffectScene{"load", R"("force": [0, 0, -1])", pinned_sides},
    EffectScene{"pressure", R"("pressure": 1)", pinned_sides},
    EffectScene{"moment", R"("vertices": ["bottom"], "moment": 0.01)", pinned_sides},
    EffectScene{"moving_pins", R"("times": [0, 1e5], "offsets": [0, 0, 0, 1e3, 0, 0])", pinned_sides},
    EffectScene{"strain_limiting", R"("min": 0.99, "max": 1.01)", pinned_sides},
    EffectScene{"plane", R"("point": [0, 0, -0.1])", no_pins},
    EffectScene{"sphere", R"("centre": [0, 0, -0.25], "radius": 0.3)", pinned_sides},
    EffectScene{"capsule", R"("a": [0, -0.5, -0.15], "b": [0, 0.5, -0.15], "radius": 0.2)", pinned_sides},
    EffectScene{"disc", R"("centre": [0, 0, -0.1], "radius": 0.3)", no_pins},
    EffectScene{"mesh_obstacle", R"("scale": 0.3, "offset": [0, 0, -0.25])", pinned_sides},
    EffectScene{"friction", R"("static": 0.5, "kinetic": 0.4)", no_pins,
                R"({"type": "plane", "point": [0, 0, -0.1]}, )"},
    EffectScene{"self_collision", "", no_pins},  // see Stack
};

/// The scenes above, and a scene for each effect that has no scene above, with default settings.
std::vector<EffectScene> all_effect_scenes() {
  std::vector<EffectScene> all(effect_scenes.begin(), effect_scenes.end());
  for (const EffectKind* effect : effects())
    if (std::ranges::find(effect_scenes, effect->name, &EffectScene::effect) == effect_scenes.end())
      all.push_back({effect->name, "", pinned_sides});
  return all;
}

/// A ball of 512 triangles around the origin, of radius 1, as a mesh file; removed at the end.
class BallFile {
 public:
  BallFile() { write_mesh(path, sphere(1, 8)); }
  ~BallFile() { std::filesystem::remove(path); }
  BallFile(const BallFile&) = delete;
  BallFile& operator=(const BallFile&) = delete;

  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("bendlab bench ball {}.obj", getpid());
};

/// Five layers on a floor. Each layer is as thick as a cell is wide, and gravity moves a layer by the same
/// part of a cell per step. So each vertex has the same contacts at any resolution.
struct Stack {
  double cell;  ///< m

  std::string settings() const { return fmt::format(R"("thickness": {})", cell); }
  std::string pose() const { return fmt::format(R"("folds": 4, "fold_gap": {})", 0.95 * cell); }
  std::string before() const {
    return fmt::format(R"({{"type": "gravity", "acceleration": [0, 0, {}]}},
                          {{"type": "plane", "point": [0, 0, {}]}}, )",
                       -100 * cell, -0.5 * cell);
  }
};

/// A cloth of `cells` by `cells` with crossover springs and 10 iterations, under gravity and the effect.
RunConfig config_of(const EffectScene& scene, int cells, const BallFile& ball) {
  const bool stacked = scene.effect == "self_collision";
  const Stack stack{1.0 / cells};
  const std::string gravity = scene.effect == "gravity" || stacked ? "" : R"({"type": "gravity"}, )";
  const std::string file =
      scene.effect == "mesh_obstacle" ? fmt::format(R"(, "file": "{}")", ball.path.string()) : "";
  const std::string before = stacked ? stack.before() : std::string(scene.before);
  const std::string settings = stacked ? stack.settings() : std::string(scene.settings);
  const std::string more = settings.empty() ? "" : ", " + settings;
  const std::string pose = stacked ? stack.pose() : R"("perturbation": 1e-6)";
  const std::string text = fmt::format(
      R"({{"name": "bench", "defaults": "paper",
          "mesh": {{"cells": {}}}, "bending": {{"model": "crossover"}}, {},
          "effects": [{}{}{{"type": "{}"{}{}}}], "initial": {{{}}},
          "solver": {{"precision": "single"}}}})",
      cells, scene.scene, gravity, before, scene.effect, file, more, pose);
  return parse_experiment(text, "bench").runs.front();
}

class TimedEffect {
 public:
  TimedEffect(const RunConfig& config, std::string_view effect) : effect_(effect) {
    const BuiltScene scene = build_scene(config.scene());
    vertices = scene.rest.vertex_count();
    simulation_ = simulation_of(scene);
    for (int step = 0; step < effect_warm_up; ++step) this->step();
    steps_ = 0, acted = 0;
  }

  /// Processor seconds of the effect's passes in a step.
  double step() {
    const PassStatistics before = effect();
    const StepSeconds took = timed_step(*simulation_);
    const PassStatistics after = effect();
    acted += (static_cast<double>(after.acted - before.acted) - acted) / ++steps_;  // mean so far
    share = (after.seconds - before.seconds) / took.wall;
    return took.cpu * share;
  }

  int vertices = 0;
  double acted = 0, share = 0;  // mean per step; of the last step

 private:
  PassStatistics effect() const {
    PassStatistics sum;
    for (const PassStatistics& pass : simulation_->passes())
      if (pass.name.starts_with(effect_)) sum.seconds += pass.seconds, sum.acted += pass.acted;
    return sum;
  }

  int steps_ = 0;
  std::string effect_;
  std::unique_ptr<Simulation> simulation_;
};

void measure(benchmark::State& state, const EffectScene& scene, const std::string& name, int cells) {
  TimedEffect& cloth = staged(
      name, [&] { return std::make_shared<TimedEffect>(config_of(scene, cells, BallFile()), scene.effect); });
  for ([[maybe_unused]] const auto _ : state) state.SetIterationTime(cloth.step());
  set_counters(state, cloth.vertices, cloth.vertices, cloth.vertices);
  state.counters["acted_per_step"] = cloth.acted;
  state.counters["share_of_step"] = cloth.share;
}

}  // namespace

void register_effect_cases(const BenchOptions& options) {
  using Sizes = std::vector<int>;
  for (const EffectScene& scene : all_effect_scenes())
    for (const int cells : options.quick ? Sizes{32} : Sizes{32, 100, 316, 1000}) {
      const bool stacked = scene.effect == "self_collision";
      // Left out: the contacts of five layers of 10⁶ vertices fill 10 GB, and a step takes most of a minute.
      if (stacked && cells == 1000) continue;
      // A repetition has a fixed number of steps. If the effect's passes had to take a least time instead, a
      // repetition would need too many steps, because the effect is a small part of a step. After more than
      // three steps, the layers of a stack would no longer have the same contacts.
      const int vertices = (cells + 1) * (cells + 1);
      const int steps = stacked ? 3 : std::clamp((options.quick ? 20'000 : 200'000) / vertices, 3, 200);
      const std::string name = fmt::format("effect/{}/{}", scene.effect, cells);
      add_benchmark(bench_id(name, "float"),
                    [=](benchmark::State& state) { measure(state, scene, name, cells); })
          ->UseManualTime()
          ->Iterations(steps);
    }
}

}  // namespace bendlab
