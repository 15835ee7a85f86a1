// The sweeps in configs/plain. Runs in a sample must be physically possible, or the program must report that
// they are not. The same scenes are also compared in two units of length.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/metrics/motion.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"
#include "tests/places.hpp"

namespace bendlab::plain_test {
namespace {

// The same limits as in analysis/plain_cases.py, which gives the reasons.
constexpr double way = 0.1, near_a_pin = 0.02, mean_strain = 0.1, stretch = 3, speed = 4, energy = 0.02,
                 fall = 1e-3, rounding = 1e-6;

Experiment plain(const std::string& name) {
  return load_experiment(std::filesystem::path(places::source) / "configs/plain" / (name + ".json"));
}

std::string text_of(const RunConfig& config) {
  std::string text;
  for (const auto& [pointer, value] : config.point)
    text += fmt::format(" --set '{}={}'", pointer, value.dump());
  return text;
}

// The shortest way along edges from every vertex to a pin, and this pin, by Bellman's algorithm.
struct Ways {
  explicit Ways(const BuiltScene& scene)
      : length(Eigen::VectorXd::Constant(scene.rest.vertex_count(), std::numeric_limits<double>::infinity())),
        pin(Eigen::VectorXi::Constant(scene.rest.vertex_count(), -1)) {
    for (const int v : scene.pins.all) length[v] = 0, pin[v] = v;
    const auto relax = [&](int from, int to) {
      const double through = length[from] + (scene.rest.position(from) - scene.rest.position(to)).norm();
      if (!(through < length[to] * (1 - 1e-12))) return false;
      length[to] = through, pin[to] = pin[from];
      return true;
    };
    for (bool shorter = !scene.pins.all.empty(); shorter;) {
      shorter = false;
      for (const auto& edge : scene.rest.edges().rowwise()) {
        shorter = relax(edge(0), edge(1)) || shorter;
        shorter = relax(edge(1), edge(0)) || shorter;
      }
    }
  }

  Eigen::VectorXd length;
  Eigen::VectorXi pin;
};

// Checks a run after every step, and keeps the value that is farthest beyond its limit.
class Bounds {
 public:
  explicit Bounds(const BuiltScene& scene)
      : scene_(scene),
        meter_(scene.rest, scene.pins),
        ways_(scene),
        gravity_(gravity_of(scene.effects)),
        start_(scene.input.positions),
        velocities_(scene.input.velocities) {
    if (velocities_.rows() == 0) velocities_ = Positions::Zero(start_.rows(), 3);
    for (const int v : scene.pins.all) velocities_.row(v).setZero();
    for (const double mass : scene.input.mass) mass_ += mass;
    energy_ = energy_of(start_, velocities_);
    pushes_ = pushes_from_the_start();
    const double weight = mass_ * gravity_.norm() * scene.rest.size();
    scale_ = motion_of(scene.input.mass, start_, velocities_).kinetic_energy + weight;
  }

  void look(double time, const Positions& now, const Positions& velocities) {
    if (!now.allFinite()) return keep("positions that are not finite", 1, 0);
    const StretchSummary strained = meter_.summarise(meter_.measure(now));
    keep("mean strain", strained.mean_strain, mean_strain);
    keep("largest stretch", strained.max_stretch, stretch);
    if (!pushes_) look_at_motion(time, now, velocities);
    if (scene_.pins.all.empty())
      look_at_fall(time, now);
    else
      look_at_pins(now);
  }

  double excess() const { return excess_; }
  const std::string& worst() const { return worst_; }

 private:
  // Prestressed springs have energy at the start, and k does not determine how much.
  bool pushes_from_the_start() const {
    const DistanceConstraints& springs = scene_.input.distance;
    for (std::size_t i = 0; i < springs.size(); ++i) {
      const double length = (start_.row(springs.vertices[i][0]) - start_.row(springs.vertices[i][1])).norm();
      if (std::abs(length / springs.rest(i) - 1) > 1e-3) return true;
    }
    return false;
  }

  void look_at_motion(double time, const Positions& now, const Positions& velocities) {
    const double fastest = velocities_.rowwise().norm().maxCoeff() + gravity_.norm() * time;
    keep("speed over v0 + g t", velocities.rowwise().norm().maxCoeff() / fastest, speed);
    keep("energy gained", (energy_of(now, velocities) - energy_) / scale_, energy);
  }

  double energy_of(const Positions& positions, const Positions& velocities) const {
    double weight = 0;
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
      weight -= scene_.input.mass[static_cast<std::size_t>(v)] * positions.row(v).dot(gravity_.transpose());
    return motion_of(scene_.input.mass, positions, velocities).kinetic_energy + weight;
  }

  Vector3 centre(const Positions& positions) const {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
      sum += scene_.input.mass[static_cast<std::size_t>(v)] * positions.row(v).transpose();
    return sum / mass_;
  }

  // Steps of h end exactly at x0 + v0 t + g t (t + h) / 2. Steps of BDF2, whose first step is backward Euler,
  // end at x0 + v0 t + g (t² / 2 + 3/4 h² (1 - 3^(-t / h))).
  void look_at_fall(double time, const Positions& now) {
    const double h = scene_.input.settings.dt / scene_.input.settings.substeps;
    const Vector3 exact = centre(start_) + time * centre(velocities_) + fallen(time, h) * gravity_;
    keep("away from free fall", (centre(now) - exact).norm(),
         fall * 0.5 * gravity_.norm() * time * time + rounding * scene_.rest.size());
  }

  // The way of a fall from rest until time t, over g.
  double fallen(double t, double h) const {
    const Field* const integrator = scene_.input.method.kind().settings.find("integrator");
    const bool second_order =
        integrator != nullptr && integrator->of(scene_.input.method.settings()) == Value("bdf2");
    return 0.5 * t * t + (second_order ? 0.75 * h * h * (1 - std::pow(3.0, -t / h)) : 0.5 * h * t);
  }

  void look_at_pins(const Positions& now) {
    for (const int v : scene_.pins.all)
      keep("way of a pin", (now.row(v) - start_.row(v)).norm(), rounding * scene_.rest.size());
    for (int v = 0; v < scene_.rest.vertex_count(); ++v)
      if (ways_.pin[v] >= 0)
        keep("beyond reach of the pins",
             (now.row(v) - start_.row(ways_.pin[v])).norm() - (1 + way) * ways_.length[v],
             near_a_pin * scene_.rest.size());
  }

  void keep(const char* what, double value, double limit) {
    const double excess =
        std::isfinite(value) && limit > 0 ? value / limit : std::numeric_limits<double>::infinity();
    if (!(excess > excess_)) return;
    excess_ = excess;
    worst_ = fmt::format("{} {:.3g}, at most {:.3g}", what, value, limit);
  }

  const BuiltScene& scene_;
  StretchMeter meter_;
  Ways ways_;
  Vector3 gravity_;
  Positions start_, velocities_;
  bool pushes_ = false;
  double mass_ = 0, energy_ = 0, scale_ = 0, excess_ = 0;
  std::string worst_;
};

// Warnings that do not concern the bounds.
constexpr std::array<std::string_view, 4> unrelated = {"inert_seed", "units", "piece_without_pin",
                                                       "softened_membrane"};

// Whether the program gives a run another verdict than complete, or a warning that concerns the bounds.
bool is_reported(const Experiment& experiment, const RunConfig& config) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("bendlab_plain_test_" + run_id(config));
  const RunOutcome outcome = execute_run(experiment, config, folder);
  std::filesystem::remove_all(folder);
  return outcome.status != RunStatus::complete ||
         std::ranges::any_of(outcome.warnings, [](const Warning& warning) {
           return std::ranges::find(unrelated, warning.code) == unrelated.end();
         });
}

// The broken bound of a run if the program does not report it; otherwise empty.
std::string silently_wrong(const Experiment& experiment, const RunConfig& config) {
  const BuiltScene scene = build_scene(config.scene());
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  Bounds bounds(scene);
  const double duration = config.scene().duration;
  bool goes_on = true;
  while (goes_on && simulation->time() < duration - 1e-9) {
    goes_on = simulation->step();
    bounds.look(simulation->time(), simulation->positions(), simulation->velocities());
  }
  return bounds.excess() <= 1 || is_reported(experiment, config) ? ""
                                                                 : bounds.worst() + ":" + text_of(config);
}

// The same for the runs 3, 3 + spacing, 3 + 2 spacing, …. Two runs are computed in parallel.
std::vector<std::string> silently_wrong(const std::string& name, std::size_t spacing) {
  const Experiment experiment = plain(name);
  const auto every = [&](std::size_t first, std::size_t step) {
    std::vector<std::string> problems;
    for (std::size_t i = first; i < experiment.runs.size(); i += step)
      if (const std::string wrong = silently_wrong(experiment, experiment.runs[i]); !wrong.empty())
        problems.push_back(fmt::format("bendlab run configs/plain/{}.json: {}", name, wrong));
    return problems;
  };
  std::future<std::vector<std::string>> other =
      std::async(std::launch::async, every, 3 + spacing, 2 * spacing);
  std::vector<std::string> problems = every(3, 2 * spacing);
  std::ranges::copy(other.get(), std::back_inserter(problems));
  return problems;
}

}  // namespace

TEST_CASE("plain: hinges hardly move a hanging sheet in the first step", "[plain]") {
  // The sheet starts in its hanging pose. In a step of h, forces and speed move a vertex by v h + g h².
  // Hinges with pinned corners once threw their free corner by 170 km.
  const std::string model = GENERATE("dihedral", "bridson", "discrete_shells");
  const std::string precision = GENERATE("single", "double");
  for (const int cells : {2, 12, 24}) {
    const Experiment experiment = parse_experiment(fmt::format(R"({{"name": "hung", "defaults": "paper",
          "mesh": {{"cells": {}, "diagonal": "alternating"}},
          "pins": {{"vertices": ["top"], "ring": 0}}, "initial": {{"tilt": 90, "velocity": [0.05, 0, 0]}},
          "bending": {{"model": "{}", "k": 0.01}}, "solver": {{"precision": "{}"}}}})",
                                                               cells, model, precision),
                                                   "test");
    const BuiltScene scene = build_scene(experiment.runs.front().scene());
    const std::unique_ptr<Simulation> simulation = simulation_of(scene);
    REQUIRE(simulation->step());
    const double h = simulation->time(), way = 0.05 * h + 9.81 * h * h;
    CAPTURE(model, precision, cells);
    // Projections pass a part of this move on to neighbours, but never multiply it.
    CHECK((simulation->positions() - scene.input.positions).rowwise().norm().maxCoeff() <= 2 * way);
  }
}

TEST_CASE("plain: no run of a sample breaks a bound without a report", "[plain][slow]") {
  const std::string name = GENERATE("first", "metres", "millimetres", "methods");
  // Newton's method takes a hundred times as long.
  CHECK(silently_wrong(name, name == "methods" ? 40 : 10) == std::vector<std::string>());
}

// A unit of length of 1/1024 changes only exponents. If no length is compared with a fixed constant, no bit
// may differ.
TEST_CASE("plain: the same cloth in two units of length gives the same bits", "[plain][slow]") {
  const Experiment small = plain("millimetres"), large = plain("millimetres_in_metres");
  REQUIRE(small.runs.size() == large.runs.size());
  constexpr double scale = 1.0 / 1024;
  int compared = 0;
  for (std::size_t i = 1; i < small.runs.size(); i += 4) {
    if (large.runs[i].scene().bending.stiffness == Stiffness::compliance)
      continue;  // scaled as springs or hinges
    INFO(text_of(large.runs[i]));
    const BuiltScene small_scene = build_scene(small.runs[i].scene()),
                     large_scene = build_scene(large.runs[i].scene());
    const std::unique_ptr<Simulation> a = simulation_of(small_scene), b = simulation_of(large_scene);
    for (int step = 0; step < 3; ++step) a->step(), b->step();
    const bool same = a->positions() == scale * b->positions();
    CHECK(same);
    ++compared;
  }
  CHECK(compared > 10);
}

}  // namespace bendlab::plain_test
