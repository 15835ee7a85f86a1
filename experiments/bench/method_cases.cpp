// The cost of an iteration of each solver method, on one cloth. For quasi_newton, also the costs of its two
// parts: the gradient of the elastic energy, and the solve with the factor of the metric. For pbd and
// quasi_newton, also the cost with each bending law of fabrics.
#include <fmt/format.h>
#include <Eigen/CholmodSupport>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "bendlab/bending/model.hpp"
#include "bendlab/constraints/kernels.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/elastic_metric.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/one_blas_thread.hpp"
#include "bendlab/solver/ordered_constraints.hpp"
#include "bendlab/solver/sparse_factor.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/machine.hpp"

namespace bendlab {
namespace {

constexpr int method_warm_up = 6;

struct MethodCase {
  std::string method;
  int cells = 0, iterations = 0;
  std::string scalar;
  int threads = 1;
  std::string bending = R"("model": "dihedral", "flexural_rigidity": 5e-5)";
};

// The parts of /bending that a law adds to the rigidity, or has in its place.
struct BendingLaw {
  const char *name, *settings;
  bool of_moments = false;  // needs BendingKind::softens
};
constexpr std::array laws = {
    BendingLaw{"one_rigidity", R"("flexural_rigidity": 5e-5)"},
    BendingLaw{"direction", R"("rigidity": {"warp": 8e-5, "weft": 2e-5})"},
    BendingLaw{"softening", R"("flexural_rigidity": 5e-5, "softening": {"half_at": 20})", true},
    BendingLaw{"friction", R"("flexural_rigidity": 5e-5, "hysteresis": {"hb": 1e-4})", true},
    BendingLaw{"folds_that_stay",
               R"("flexural_rigidity": 5e-5, "plasticity": {"yield_at": 1, "hardening": 0.2})", true},
    BendingLaw{"over_time",
               R"("flexural_rigidity": 5e-5, "over_time": {"times": [0, 1e3], "factors": [1, 2]})"}};

// A cotton that sags between two pinned sides: Y = 10⁴ N/m, B = 5·10⁻⁵ N m. The cloth has hinges, and every
// iteration is done (tolerance 0). The few iterations of vbd leave the membrane far from the minimum of its
// energy, so vbd is stable only with the damping of backward Euler.
RunConfig config_of(const MethodCase& kind) {
  const bool implicit = kind.method != "pbd";
  const std::string text = fmt::format(
      R"({{"name": "bench", "defaults": "paper", "mesh": {{"cells": {}}}, "initial": {{"perturbation": 1e-6}},
          "bending": {{"stiffness": "physical", {}}},
          "material": {{"strain": {{"form": "angle", "stiffness": "compliance", "compliance": 1e-4}}}},
          "pins": {{"vertices": ["left", "right"], "ring": 0}},
          "solver": {{"method": "{}", "iterations": {}, "threads": {}, "precision": "{}"{}}}}})",
      kind.cells, kind.bending, kind.method, kind.iterations, kind.threads,
      kind.scalar == "float" ? "single" : "double",
      kind.method == "vbd"            ? R"(, "tolerance": 0, "integrator": "euler")"
      : kind.method == "quasi_newton" ? R"(, "tolerance": 0, "membrane": "stated", "history": 10)"
      : implicit                      ? R"(, "tolerance": 0)"
                                      : "");
  return parse_experiment(text, "bench").runs.front();
}

/// The scene of a case, in the pose after a few steps.
struct MovedScene {
  explicit MovedScene(const MethodCase& kind) : scene(build_scene(config_of(kind).scene())) {
    const auto simulation = simulation_of(scene);
    for (int step = 0; step < method_warm_up; ++step)
      if (!simulation->step()) throw std::runtime_error("the cloth of a benchmark diverged");
    scene.input.positions = simulation->positions();
    one_blas_thread();
  }

  std::int64_t vertices() const { return scene.rest.vertex_count(); }
  std::size_t triangles() const { return scene.input.strain.size(); }
  std::size_t hinges() const { return element_count(scene.input.elements); }

  BuiltScene scene;
};

// The lower triangle of quasi_newton's matrix, for BDF2.
Eigen::SparseMatrix<double> metric_of(const SimulationInput& input, std::vector<int>& vertices) {
  const ElasticMetric metric(input);
  vertices = metric.vertices();
  Eigen::SparseMatrix<double> matrix = metric.matrix(std::vector<double>(metric.triangle_count(), 1));
  const double gamma = 2.0 / 3.0 * input.settings.dt;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix.coeffRef(i, i) +=
        input.mass[static_cast<std::size_t>(vertices[static_cast<std::size_t>(i)])] / (gamma * gamma);
  return matrix;
}

// ---- the gradient

// Measures the gradient. Returns the norm of the force on the free vertices, N, which has to equal the norm
// from the oracle.
template <class Real>
double measure_fast_gradient(benchmark::State& state, const MovedScene& moved) {
  const SimulationInput& input = moved.scene.input;
  const Constraints<Real> constraints = ordered_constraints<Real>(input, nullptr);
  const auto count = static_cast<std::size_t>(moved.vertices());
  const auto slot = [&](std::size_t v) {
    return input.permutation.empty() ? v : static_cast<std::size_t>(input.permutation[v]);
  };
  Points<Real> points(count + dummy_points), forces(count + dummy_points);
  for (std::size_t v = 0; v < count; ++v)
    points[slot(v)].set(
        (input.positions.row(static_cast<Eigen::Index>(v)).transpose() - input.origin).template cast<Real>());
  const auto gradient = [&] {
    std::fill(forces.begin(), forces.end(), Point<Real>{});
    constraints.for_each([&](const auto& batch) {
      add_forces(points.data(), forces.data(), batch, 0, batch.order.stack_count());
    });
  };
  for ([[maybe_unused]] const auto _ : state) state.SetIterationTime(cpu_seconds(gradient));
  double sum = 0;
  for (std::size_t v = 0; v < count; ++v)
    if (!input.is_pinned[v]) sum += static_cast<double>(forces[slot(v)].vector().squaredNorm());
  return std::sqrt(sum);
}

double measure_scalar_gradient(benchmark::State& state, const MovedScene& moved) {
  const ElasticSystem system(moved.scene.input);
  Eigen::VectorXd gradient;
  for ([[maybe_unused]] const auto _ : state)
    state.SetIterationTime(cpu_seconds([&] { gradient = system.gradient(moved.scene.input.positions); }));
  return gradient.norm();
}

void measure_gradient(benchmark::State& state, const std::string& id, const MethodCase& kind, bool oracle) {
  const MovedScene& moved = staged(id, [&] { return std::make_shared<MovedScene>(kind); });
  state.counters["force_N"] = oracle                   ? measure_scalar_gradient(state, moved)
                              : kind.scalar == "float" ? measure_fast_gradient<float>(state, moved)
                                                       : measure_fast_gradient<double>(state, moved);
  const auto constraints = static_cast<std::int64_t>(moved.triangles() + moved.hinges());
  set_counters(state, moved.vertices(), constraints, static_cast<double>(constraints));
}

// ---- the solve

/// CHOLMOD's own solver, with the elimination order of SparseFactor.
struct Cholmod : Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> {
  explicit Cholmod(const Eigen::SparseMatrix<double>& matrix) {
    one_blas_thread();
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_AMD;
    compute(matrix);
  }
};

template <class Real>
void measure_fast_solve(benchmark::State& state, const SparseFactor<Real>& factor) {
  Points<Real> points(factor.size());
  for ([[maybe_unused]] const auto _ : state) {
    for (Point<Real>& point : points) point.set(Vector3Of<Real>::Ones());
    state.SetIterationTime(cpu_seconds([&] { factor.solve(points.data()); }));
  }
  // A solve reads each entry twice: forward and backward.
  const auto bytes = static_cast<std::int64_t>(2 * factor.entries() * sizeof(Real));
  state.SetBytesProcessed(state.iterations() * bytes);
}

void measure_scalar_solve(benchmark::State& state, const Cholmod& factor) {
  const Eigen::MatrixXd right = Eigen::MatrixXd::Ones(factor.rows(), 3);
  Eigen::MatrixXd solution;
  for ([[maybe_unused]] const auto _ : state)
    state.SetIterationTime(cpu_seconds([&] { solution = factor.solve(right); }));
}

void measure_solve(benchmark::State& state, const std::string& id, const MethodCase& kind, bool oracle) {
  const auto factor_of = [&]<class Factor>(std::type_identity<Factor>) -> const Factor& {
    return staged(id, [&] {
      std::vector<int> vertices;
      return std::make_shared<Factor>(metric_of(build_scene(config_of(kind).scene()).input, vertices));
    });
  };
  if (oracle)
    measure_scalar_solve(state, factor_of(std::type_identity<Cholmod>{}));
  else if (kind.scalar == "float")
    measure_fast_solve(state, factor_of(std::type_identity<SparseFactor<float>>{}));
  else
    measure_fast_solve(state, factor_of(std::type_identity<SparseFactor<double>>{}));
  const std::int64_t vertices = (kind.cells + 1) * (kind.cells + 1);
  set_counters(state, vertices, vertices, static_cast<double>(vertices));
}

// ---- whole steps

void measure_method(benchmark::State& state, const std::string& id, const MethodCase& kind) {
  const auto step_of = [&](Simulation& simulation) {
    const StepSeconds seconds = timed_step(simulation);
    return kind.threads == 1 ? seconds.cpu : seconds.wall;
  };
  Simulation& simulation = staged(id, [&] {
    std::shared_ptr<Simulation> made = simulation_of(MovedScene(kind).scene);
    for (int warm = 0; warm < method_warm_up; ++warm) step_of(*made);  // the first step factorises
    return made;
  });
  for ([[maybe_unused]] const auto _ : state) state.SetIterationTime(step_of(simulation));
  const std::int64_t vertices = (kind.cells + 1) * (kind.cells + 1);
  set_counters(state, vertices, vertices, static_cast<double>(kind.iterations * vertices));
}

}  // namespace

void register_method_cases(const BenchOptions& options) {
  using Sizes = std::vector<int>;
  const int usual = options.quick ? 32 : 128;
  const Sizes sizes = options.quick ? Sizes{32} : Sizes{32, 64, 128, 256, 512};
  const auto add_step = [&](const std::string& name, const MethodCase& kind) {
    const std::string id = bench_id(name, kind.scalar, kind.threads);
    add_benchmark(id, [=](benchmark::State& state) { measure_method(state, id, kind); })
        ->UseManualTime()
        ->MinTime(least_s(options));
  };
  const auto add_method = [&](const MethodCase& kind) {
    add_step(fmt::format("method/{}/{}", kind.method, kind.cells), kind);
  };
  const auto add_gradient = [&](int cells, const char* scalar, bool oracle) {
    const MethodCase kind{.method = "quasi_newton", .cells = cells, .iterations = 10, .scalar = scalar};
    const std::string id = bench_id(fmt::format("gradient{}/{}", oracle ? "_oracle" : "", cells), scalar);
    add_benchmark(id, [=](benchmark::State& state) { measure_gradient(state, id, kind, oracle); })
        ->UseManualTime()
        ->MinTime(least_s(options));
  };
  const auto add_solve = [&](int cells, const char* scalar, bool oracle) {
    const MethodCase kind{.method = "quasi_newton", .cells = cells, .iterations = 10, .scalar = scalar};
    const std::string id = bench_id(fmt::format("solve{}/{}", oracle ? "_oracle" : "", cells), scalar);
    add_benchmark(id, [=](benchmark::State& state) { measure_solve(state, id, kind, oracle); })
        ->UseManualTime()
        ->MinTime(least_s(options));
  };
  // The oracles are in double precision. One size is enough for the gradient oracle, whose cost per
  // constraint is the same on any cloth. The cost per vertex of the solve oracle depends on the size.
  add_gradient(usual, "double", true);
  for (const int cells : sizes) add_solve(cells, "double", true);
  for (const char* scalar : {"float", "double"}) {
    for (const int cells : sizes) {
      add_gradient(cells, scalar, false);
      add_solve(cells, scalar, false);
    }
    for (const char* method : {"pbd", "quasi_newton"}) {
      for (const int cells : sizes) add_method({method, cells, 10, scalar});
      for (const int threads : options.threads)
        if (threads != 1) add_method({method, usual, 10, scalar, threads});
    }
  }
  for (const int cells : options.quick ? Sizes{32} : Sizes{32, 64, 128}) {
    add_method({"newton", cells, 2, "double"});
    add_method({"vbd", cells, 5, "double"});
  }
  // The cost of a law is compared with that of one rigidity, so one small cloth is enough.
  const int small = options.quick ? 32 : 64;
  for (const std::string method : {"pbd", "quasi_newton"})
    for (const std::string model : {"discrete_shells", "mid_edge", "dkt"})
      for (const BendingLaw& law : laws) {
        const BendingKind& bending = *find_bending_model(model);
        if (bending.needs_energy && method == "pbd") continue;
        if (law.of_moments && !bending.softens) continue;
        const MethodCase kind{.method = method,
                              .cells = small,
                              .iterations = 10,
                              .scalar = "float",
                              .bending = fmt::format(R"("model": "{}", {})", model, law.settings)};
        add_step(fmt::format("law/{}/{}/{}/{}", method, model, law.name, small), kind);
      }
}

}  // namespace bendlab
