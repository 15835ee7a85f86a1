// Times kernels during the steps of a moving cloth, so that positions, branches and caches are as in a run.
#include <fmt/format.h>

#include <memory>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {
namespace {

constexpr int iterations = 10, cloth_warm_up = 30;

struct ClothKind {
  int cells = 0;
  std::string model;
  std::string scalar;
  int threads = 1;
  bool oracle = false;
  double compliance = 0;            // of bending; 0: k
  std::string form = "normalised";  // of strain
};

std::string config_text(const ClothKind& kind) {
  return fmt::format(
      R"({{"name": "bench", "defaults": "paper", "mesh": {{"cells": {}}}, "bending": {{"model": "{}"{}}},
          "material": {{"strain": {{"form": "{}"}}}}, "initial": {{"perturbation": 1e-6}},
          "pins": {{"vertices": ["left", "right"], "ring": 0}},
          "solver": {{"dt": 0.002, "iterations": {}, "precision": "{}", "threads": {}, "order": "{}"}}}})",
      kind.cells, kind.model,
      kind.compliance > 0 ? fmt::format(R"(, "stiffness": "compliance", "compliance": {})", kind.compliance)
                          : std::string(),
      kind.form, iterations, kind.scalar == "float" ? "single" : "double", kind.threads,
      kind.oracle ? "mesh" : "colour");
}

/// Seconds of a step, and of its two projection passes.
struct StepTime {
  double strain = 0, bending = 0, all = 0;
};

/// A square that falls from the horizontal, pinned along two opposite sides, in short steps. Such a square
/// sags without tearing. A square that hung from a corner would tear, and torn triangles cost up to three
/// times as much.
class MovingCloth {
 public:
  MovingCloth(const std::string& config, int threads) : threads_(threads) {
    const BuiltScene scene = build_scene(parse_experiment(config, "bench").runs.front().scene());
    vertices = scene.rest.vertex_count();
    triangles = static_cast<std::int64_t>(scene.input.strain.size());
    bending = static_cast<std::int64_t>(scene.input.distance.size() + element_count(scene.input.elements));
    simulation_ = simulation_of(scene);
    for (int step = 0; step < cloth_warm_up; ++step) this->step();
  }

  /// The processor time of a step with one thread, or the wall time with several, and the parts of this
  /// time that the two passes take.
  StepTime step() {
    const StepTime before = passes();
    const StepSeconds took = timed_step(*simulation_);
    const double all = threads_ == 1 ? took.cpu : took.wall;
    const StepTime after = passes();
    return {all * (after.strain - before.strain) / took.wall,
            all * (after.bending - before.bending) / took.wall, all};
  }

  double mean_speed() const { return simulation_->velocities().rowwise().norm().mean(); }  // m/s

  int vertices = 0;
  std::int64_t triangles = 0, bending = 0;

 private:
  StepTime passes() const {
    StepTime time;
    for (const PassStatistics& pass : simulation_->passes()) {
      if (pass.name == "strain") time.strain = pass.seconds;
      if (pass.name == "bending") time.bending = pass.seconds;
    }
    return time;
  }

  int threads_;
  std::unique_ptr<Simulation> simulation_;
};

enum class Part { strain, bending, step };

std::string name_of(Part part, const ClothKind& kind) {
  const char* what = part == Part::strain       ? "strain"
                     : part == Part::step       ? "step"
                     : kind.model == "adaptive" ? "dense"
                                                : kind.model.c_str();
  const std::string form = kind.form == "normalised" ? "" : "_" + kind.form;
  return fmt::format("{}{}{}{}/{}", what, form, kind.compliance > 0 ? "_compliance" : "",
                     kind.oracle ? "_oracle" : "", kind.cells);
}

void measure(benchmark::State& state, Part part, const ClothKind& kind) {
  const std::string config = config_text(kind);
  MovingCloth& cloth = staged(config, [&] { return std::make_shared<MovingCloth>(config, kind.threads); });
  for ([[maybe_unused]] const auto _ : state) {
    const StepTime time = cloth.step();
    state.SetIterationTime(part == Part::strain    ? time.strain
                           : part == Part::bending ? time.bending
                                                   : time.all);
  }
  const std::int64_t constraints =
      (part != Part::bending ? cloth.triangles : 0) + (part != Part::strain ? cloth.bending : 0);
  set_counters(state, cloth.vertices, constraints, static_cast<double>(iterations * constraints));
  state.counters["mean_speed_m_per_s"] = cloth.mean_speed();
}

}  // namespace

void register_cloth_cases(const BenchOptions& options) {
  const int usual = options.quick ? 32 : 128;  // cells of oracle and steps
  const auto add = [&](Part part, const ClothKind& kind) {
    add_benchmark(bench_id(name_of(part, kind), kind.scalar, kind.threads),
                  [=](benchmark::State& state) { measure(state, part, kind); })
        ->UseManualTime()
        ->MinTime(least_s(options));
  };
  using Sizes = std::vector<int>;
  for (const char* scalar : {"float", "double"}) {
    for (const std::string model : {"crossover", "adaptive", "dihedral", "bridson", "isometric", "choi_ko",
                                    "laplacian", "mid_edge_average", "corotational_face", "mid_edge"}) {
      const bool first = model == "crossover";  // its cloth also serves for strain and steps
      const auto add_all = [&](const ClothKind& kind) {
        if (first) add(Part::strain, kind);
        add(Part::bending, kind);
        if (first && kind.cells == usual) add(Part::step, kind);
      };
      add_all({.cells = usual, .model = model, .scalar = scalar, .oracle = true});
      // Springs of dense rings take much memory on 10⁶ vertices, and setting up the normals of mid_edge takes
      // minutes.
      for (const int cells : options.quick                                ? Sizes{32}
                             : first                                      ? Sizes{32, 64, 128, 256, 512, 1024}
                             : model == "adaptive" || model == "mid_edge" ? Sizes{128, 256}
                                                                          : Sizes{128, 1024})
        add_all({.cells = cells, .model = model, .scalar = scalar});
    }
    add(Part::strain,
        {.cells = usual, .model = "crossover", .scalar = scalar, .oracle = true, .form = "angle"});
    add(Part::strain, {.cells = usual, .model = "crossover", .scalar = scalar, .form = "angle"});
    // With a compliance, choi_ko is solved by Newton's method. The oracle of choi_ko bisects, which is too
    // slow for a comparison. k_b is 10⁻⁷ N m².
    add(Part::bending, {.cells = usual, .model = "choi_ko", .scalar = scalar, .compliance = 1e7});
    for (const int threads : options.threads)
      if (threads != 1)
        add(Part::step, {.cells = usual, .model = "crossover", .scalar = scalar, .threads = threads});
  }
}

}  // namespace bendlab
