#include "cloth.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bendlab/metrics/motion.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/warnings.hpp"

namespace py = pybind11;

namespace bendlab {
namespace {

Scene scene_of(const std::string& text, const std::string& folder, std::optional<TriangleMesh> mesh) {
  ConfigProblems problems;
  constexpr std::array<std::string_view, 1> of_experiment = {"name"};
  Scene scene = read_scene(parse_strict_json(text, "the scene"), of_experiment, problems);
  if (!problems.empty()) throw ConfigError("the scene", std::move(problems));
  scene.folder = folder;
  if (mesh) scene.mesh.given = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return scene;
}

// A read-only view of `numbers`, which belong to `owner`. The view keeps `owner` alive.
template <class Matrix>
py::array view_of(const Matrix& numbers, const std::shared_ptr<const void>& owner) {
  const py::capsule base(new std::shared_ptr<const void>(owner),
                         [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  py::array view(py::dtype::of<typename Matrix::Scalar>(), {numbers.rows(), numbers.cols()}, numbers.data(),
                 base);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

// Writes into the memory of `numbers`, because there may be views of this memory.
void fill(Positions& numbers, const Positions& now) {
  std::copy_n(now.data(), now.size(), numbers.data());
}

}  // namespace

struct PythonCloth::Arrays {
  Positions positions, velocities;
  Triangles triangles;
  Eigen::VectorXd masses;
  Eigen::VectorXi pinned;
};

// Marks the cloth as in use, so that a second thread gets an error instead of a race.
class PythonCloth::Use {
 public:
  explicit Use(PythonCloth& cloth) : in_use_(cloth.in_use_) {
    if (in_use_.exchange(true))
      throw std::runtime_error(
          "this cloth is in the middle of a step: give each thread its own cloth, and let models and effects "
          "read only the arrays that they are given");
  }
  ~Use() { in_use_ = false; }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  std::atomic<bool>& in_use_;
};

PythonCloth::PythonCloth(const std::string& scene, const std::string& folder,
                         std::optional<TriangleMesh> mesh)
    : cloth_(simulate(scene_of(scene, folder, std::move(mesh)))), arrays_(std::make_shared<Arrays>()) {
  const BuiltScene& built = cloth_.scene();
  const auto is_added = [](const auto& added, const auto& kind) {
    return std::ranges::find(added, &kind) != added.end();
  };
  const Experiment experiment = parse_experiment(scene, "the scene");
  for (const Warning& warning : warnings_of(WarningInput{experiment, experiment.runs.front(), built}))
    warnings_.emplace_back(warning.code, warning.message);
  has_python_parts_ =
      built.input.own.size() > 0 || std::ranges::any_of(built.effects, [&](const Effect& effect) {
        return is_added(added_effects(), effect.kind());
      });
  arrays_->positions = cloth_.positions(), arrays_->velocities = cloth_.velocities();
  arrays_->triangles = cloth_.triangles();
  arrays_->masses = Eigen::Map<const Eigen::VectorXd>(built.input.mass.data(),
                                                      static_cast<Eigen::Index>(built.input.mass.size()));
  arrays_->pinned = Eigen::Map<const Eigen::VectorXi>(built.pins.all.data(),
                                                      static_cast<Eigen::Index>(built.pins.all.size()));
}

void PythonCloth::step() {
  const Use use(*this);
  const py::gil_scoped_release without_gil;
  step_once();
}

void PythonCloth::step_once() {
  if (hand_) {
    if (!hand_->to.allFinite())
      throw std::invalid_argument("pins: a coordinate is not finite; the step was not taken");
    const Positions now = cloth_.positions();
    for (std::size_t i = 0; i < hand_->vertices.size(); ++i)
      hand_->from.row(static_cast<Eigen::Index>(i)) = now.row(hand_->vertices[i]);
    hand_->start = time();
    // A step simulates dt of the scene.
    hand_->duration = cloth_.scene().input.settings.dt;
  }
  if (!has_python_parts_) return cloth_.step();
  Archive before;
  cloth_.simulation().archive(before);
  try {
    cloth_.step();
  } catch (...) {
    Archive back(before.bytes());
    cloth_.simulation().archive(back);
    throw;
  }
}

py::array PythonCloth::pins() {
  const Use use(*this);
  const MethodKind& method = cloth_.scene().input.method.kind();
  if (!method.has_motion || !method.takes_effect(Hand::kind.needs_projection, Hand::kind.acts_in_iterations))
    throw std::invalid_argument(std::string(method.name) +
                                " leaves pinned vertices where they are: choose another method to move them");
  if (!hand_) {
    // The scene gets another effect, which needs a new simulation with the same state.
    hand_ = std::make_shared<HandMotion>();
    hand_->vertices = cloth_.scene().pins.all;
    const auto count = static_cast<Eigen::Index>(hand_->vertices.size());
    hand_->from.resize(count, 3), hand_->to.resize(count, 3);
    const Positions now = cloth_.positions();
    for (Eigen::Index i = 0; i < count; ++i)
      hand_->to.row(i) = now.row(hand_->vertices[static_cast<std::size_t>(i)]);
    Archive state;
    cloth_.simulation().archive(state);
    BuiltScene scene = cloth_.scene();
    scene.effects.push_back(Hand{hand_});
    cloth_ = Cloth(std::move(scene));
    Archive back(state.bytes());
    cloth_.simulation().archive(back);
  }
  const py::capsule base(new std::shared_ptr<const void>(hand_),
                         [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  return py::array_t<double>({hand_->to.rows(), hand_->to.cols()}, hand_->to.data(), base);
}

void PythonCloth::run(double seconds, const py::object& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr double rounding = 1e-6;  // of a step
  constexpr std::chrono::milliseconds pause(50);
  if (!(seconds >= 0 && std::isfinite(seconds)))
    throw std::invalid_argument("run: expected seconds of at least 0, got " + std::to_string(seconds));
  const Use use(*this);
  const double start = time(), end = start + seconds, dt = cloth_.scene().input.settings.dt;
  Clock::time_point looked = Clock::now();
  while (time() < end - rounding * dt && !cloth_.simulation().settled()) {
    {
      const py::gil_scoped_release without_gil;
      while (time() < end - rounding * dt && !cloth_.simulation().settled()) {
        step_once();
        if (Clock::now() - looked > pause) break;
      }
    }
    looked = Clock::now();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress((time() - start) / seconds);
  }
}

py::array PythonCloth::positions() {
  const Use use(*this);
  fill(arrays_->positions, cloth_.positions());
  return view_of(arrays_->positions, arrays_);
}

py::array PythonCloth::velocities() {
  const Use use(*this);
  fill(arrays_->velocities, cloth_.velocities());
  return view_of(arrays_->velocities, arrays_);
}

py::array PythonCloth::triangles() const {
  return view_of(arrays_->triangles, arrays_);
}

py::array PythonCloth::masses() const {
  return view_of(arrays_->masses, arrays_).attr("reshape")(-1);
}

py::array PythonCloth::pinned() const {
  return view_of(arrays_->pinned, arrays_).attr("reshape")(-1);
}

// Energies and forces follow from the pose alone only without state of elements and without schedules.
void expect_no_history(const BuiltScene& scene) {
  if (has_history(scene.input))
    throw std::invalid_argument(
        "the energies and forces of this cloth are not known, because they depend on how it moved "
        "(hysteresis, plasticity) or on time (over_time)");
}

py::dict PythonCloth::energies() {
  const Use use(*this);
  const BuiltScene& scene = cloth_.scene();
  expect_no_history(scene);
  const Positions positions = cloth_.positions();
  py::dict by_kind;
  by_kind["kinetic"] = motion_of(scene.input.mass, positions, cloth_.velocities()).kinetic_energy;
  by_kind["weight"] = potential_energy(scene, positions) - elastic_energy(scene.input, positions);
  for (const EnergyPart& part : energy_parts(scene.input, positions))
    by_kind[py::str(part.name)] = part.energy;
  return by_kind;
}

py::dict PythonCloth::forces() {
  const Use use(*this);
  expect_no_history(cloth_.scene());
  const Positions positions = cloth_.positions();
  py::dict by_kind;
  for (const EnergyPart& part : energy_parts(cloth_.scene().input, positions)) {
    py::array_t<double> rows({positions.rows(), positions.cols()});
    Positions forces = part.forces;
    for (const int v : arrays_->pinned) forces.row(v).setZero();
    std::copy_n(forces.data(), forces.size(), rows.mutable_data());
    by_kind[py::str(part.name)] = std::move(rows);
  }
  return by_kind;
}

}  // namespace bendlab
