// The cost of an iteration of each solver method, on one cloth. For quasi_newton, also the costs of its two
// parts: the gradient of the elastic energy, and the solve with the factor of the metric. For pbd and
// quasi_newton, also the cost with each bending law of fabrics.
#include <fmt/format.h>
#include <Eigen/CholmodSupport>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "bendlab/bending/model.hpp"
#include "bendlab/constraints/kernels.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/elastic_metric.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/one_blas_thread.hpp"
#include "bendlab/solver/ordered_constraints.hpp"
#include "bendlab/solver/sparse_factor.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/roofline.hpp"
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

std::size_t scalar_bytes(const std::string& scalar) {
  return scalar == "float" ? sizeof(float) : sizeof(double);
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

template <class Work>
double cpu_seconds(const Work& work) {
  const double start = thread_cpu_s();
  work();
  return thread_cpu_s() - start;
}

double least_s(const BenchOptions& options) {
  return options.quick ? 0.005 : 0.15;
}

// ---- the gradient

double least_gradient_seconds(const MovedScene& moved, std::size_t scalar, std::size_t scene_bytes) {
  const double vertices = static_cast<double>(moved.vertices());
  const auto least = [&](const ConstraintCost& cost, std::size_t constraints) {
    const auto count = static_cast<double>(constraints);
    return count * roofline_seconds(cost, scalar, vertices / count, scene_bytes);
  };
  return least(strain_force_cost, moved.triangles()) + least(hinge_force_cost, moved.hinges());
}

std::size_t gradient_bytes(const MovedScene& moved, std::size_t scalar) {
  return moved.triangles() * streamed_bytes(strain_force_cost, scalar) +
         moved.hinges() * streamed_bytes(hinge_force_cost, scalar) +
         static_cast<std::size_t>(moved.vertices()) * 8 * scalar;
}

// Measures the gradient. Returns the norm of the force on the free vertices, N, which has to equal the norm
// from the oracle.
template <class Real>
double force_of_gradient(const MovedScene& moved, const std::string& id, const BenchOptions& options,
                         Spread& seconds) {
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
  seconds = repeated(id, options.repetitions, least_s(options), [&] { return cpu_seconds(gradient); });
  double sum = 0;
  for (std::size_t v = 0; v < count; ++v)
    if (!input.is_pinned[v]) sum += static_cast<double>(forces[slot(v)].vector().squaredNorm());
  return std::sqrt(sum);
}

BenchRow measure_gradient(const std::string& name, const MethodCase& kind, bool oracle,
                          const BenchOptions& options) {
  const MovedScene moved(kind);
  BenchRow row{.name = name,
               .scalar = kind.scalar,
               .vertices = moved.vertices(),
               .constraints = static_cast<std::int64_t>(moved.triangles() + moved.hinges()),
               .repetitions = options.repetitions};
  Spread seconds;
  if (oracle) {
    const ElasticSystem system(moved.scene.input);
    Eigen::VectorXd gradient;
    seconds = repeated(bench_id(name, kind.scalar), options.repetitions, least_s(options), [&] {
      return cpu_seconds([&] { gradient = system.gradient(moved.scene.input.positions); });
    });
    row.more["force_N"] = gradient.norm();
  } else {
    const std::string id = bench_id(name, kind.scalar);
    row.more["force_N"] = kind.scalar == "float" ? force_of_gradient<float>(moved, id, options, seconds)
                                                 : force_of_gradient<double>(moved, id, options, seconds);
    const std::size_t scalar = scalar_bytes(kind.scalar);
    row.roofline_fraction =
        least_gradient_seconds(moved, scalar, gradient_bytes(moved, scalar)) / seconds.median;
  }
  row.ns = ns_per(static_cast<double>(row.constraints), seconds);
  return row;
}

// ---- the solve

/// CHOLMOD's own solver, with the elimination order of SparseFactor.
struct Cholmod : Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> {
  Cholmod() {
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_AMD;
  }
};

template <class Real>
BenchRow solved_by_factor(BenchRow row, const Eigen::SparseMatrix<double>& matrix,
                          const BenchOptions& options) {
  const double start = thread_cpu_s();
  const SparseFactor<Real> factor(matrix);
  row.more["factorise_ms"] = 1e3 * (thread_cpu_s() - start);
  row.more["entries_per_vertex"] = static_cast<double>(factor.entries()) / static_cast<double>(row.vertices);
  Points<Real> points(factor.size());
  const Spread seconds = repeated(bench_id(row.name, row.scalar), options.repetitions, least_s(options), [&] {
    for (Point<Real>& point : points) point.set(Vector3Of<Real>::Ones());
    return cpu_seconds([&] { factor.solve(points.data()); });
  });
  row.ns = ns_per(static_cast<double>(row.vertices), seconds);
  row.roofline_fraction = solve_roofline_seconds(factor.entries(), sizeof(Real)) / seconds.median;
  return row;
}

BenchRow measure_solve(const std::string& name, const MethodCase& kind, bool oracle,
                       const BenchOptions& options) {
  const BuiltScene scene = build_scene(config_of(kind).scene());
  std::vector<int> vertices;
  const Eigen::SparseMatrix<double> matrix = metric_of(scene.input, vertices);
  BenchRow row{.name = name,
               .scalar = kind.scalar,
               .vertices = scene.rest.vertex_count(),
               .constraints = scene.rest.vertex_count(),
               .repetitions = options.repetitions};
  if (!oracle)
    return kind.scalar == "float" ? solved_by_factor<float>(row, matrix, options)
                                  : solved_by_factor<double>(row, matrix, options);
  one_blas_thread();
  Cholmod factor;
  factor.compute(matrix);
  const Eigen::MatrixXd right = Eigen::MatrixXd::Ones(matrix.rows(), 3);
  Eigen::MatrixXd solution;
  const Spread seconds = repeated(bench_id(name, kind.scalar), options.repetitions, least_s(options),
                                  [&] { return cpu_seconds([&] { solution = factor.solve(right); }); });
  row.ns = ns_per(static_cast<double>(row.vertices), seconds);
  return row;
}

// ---- whole steps

/// Least seconds of an iteration of quasi_newton: gradient, solve, and reading the history of vectors.
double least_iteration_seconds(const MethodCase& kind, const MovedScene& moved) {
  const std::size_t scalar = scalar_bytes(kind.scalar);
  std::vector<int> vertices;
  const std::size_t entries = SparseFactor<double>(metric_of(moved.scene.input, vertices)).entries();
  constexpr double pairs = 10, passes = 4;  // passes over each pair: two products, two sums
  const double streamed =
      passes * pairs * 4 * static_cast<double>(moved.vertices()) * static_cast<double>(scalar);
  const std::size_t all =
      gradient_bytes(moved, scalar) + entries * scalar + static_cast<std::size_t>(streamed / 2);
  return least_gradient_seconds(moved, scalar, all) + solve_roofline_seconds(entries, scalar) +
         streamed / triad_bandwidth(all);
}

BenchRow measure_method(const std::string& name, const MethodCase& kind, const BenchOptions& options) {
  BenchRow row{
      .name = name, .scalar = kind.scalar, .threads = kind.threads, .repetitions = options.repetitions};
  MovedScene moved(kind);
  row.vertices = row.constraints = moved.vertices();
  const auto simulation = simulation_of(moved.scene);
  const auto step = [&] {
    const StepSeconds seconds = timed_step(*simulation);
    return kind.threads == 1 ? seconds.cpu : seconds.wall;
  };
  for (int warm = 0; warm < method_warm_up; ++warm) step();  // the first step factorises
  const Spread seconds =
      repeated(bench_id(name, kind.scalar, kind.threads), options.repetitions, least_s(options), step);
  row.ns = ns_per(kind.iterations * static_cast<double>(row.vertices), seconds);
  row.more["step_ms"] = 1e3 * seconds.median;
  row.more["iterations"] = kind.iterations;
  if (kind.method == "quasi_newton" && name.starts_with("method/"))  // the bound is that of hinges
    row.roofline_fraction =
        kind.iterations * least_iteration_seconds(kind, moved) / kind.threads / seconds.median;
  return row;
}

}  // namespace

std::vector<BenchCase> method_cases(const BenchOptions& options) {
  using Sizes = std::vector<int>;
  std::vector<BenchCase> cases;
  const int usual = options.quick ? 32 : 128;
  const Sizes sizes = options.quick ? Sizes{32} : Sizes{32, 64, 128, 256, 512};
  const auto add_method = [&](const MethodCase& kind) {
    const std::string name = fmt::format("method/{}/{}", kind.method, kind.cells);
    cases.push_back({.id = bench_id(name, kind.scalar, kind.threads),
                     .run = [=] { return measure_method(name, kind, options); }});
  };
  const auto add_part = [&](const char* part, auto measure, int cells, const char* scalar,
                            const std::string& oracle) {
    const std::string name = fmt::format("{}/{}", part, cells);
    const MethodCase kind{.method = "quasi_newton", .cells = cells, .iterations = 10, .scalar = scalar};
    cases.push_back({.id = bench_id(name, scalar), .oracle = oracle, .run = [=] {
                       return measure(name, kind, oracle.empty(), options);
                     }});
  };
  // The oracles are in double precision. One size is enough for the gradient oracle, whose cost per
  // constraint is the same on any cloth. The cost per vertex of the solve oracle depends on the size.
  add_part("gradient_oracle", measure_gradient, usual, "double", "");
  for (const int cells : sizes) add_part("solve_oracle", measure_solve, cells, "double", "");
  for (const char* scalar : {"float", "double"}) {
    for (const int cells : sizes) {
      add_part("gradient", measure_gradient, cells, scalar,
               bench_id(fmt::format("gradient_oracle/{}", usual), "double"));
      add_part("solve", measure_solve, cells, scalar,
               bench_id(fmt::format("solve_oracle/{}", cells), "double"));
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
        const std::string name = fmt::format("law/{}/{}/{}/{}", method, model, law.name, small);
        cases.push_back(
            {.id = bench_id(name, kind.scalar), .run = [=] { return measure_method(name, kind, options); }});
      }
  return cases;
}

}  // namespace bendlab
