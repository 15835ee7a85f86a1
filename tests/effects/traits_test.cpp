// Every effect has the traits that it declares: whether it does work, and whether it keeps momentum.
#include "bendlab/bendlab.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/metrics/motion.hpp"
#include "tests/catch.hpp"

namespace bendlab::traits_test {
namespace {

// A sheet with this effect alone. The sheet is free, or pinned at two corners if the effect needs pins.
Scene scene_with(const EffectKind& kind, bool moves) {
  Scene scene;
  scene.mesh = grid(1, 1, 6);
  scene.pins.vertices.clear();
  if (kind.needs_pins) scene.pins.vertices = {Place::upper_left, Place::upper_right};
  scene.effects = {Effect(kind)};
  scene.solver.method = Pbd{};
  scene.solver.precision = ChosenPrecision::double_precision;
  scene.solver.substeps = 8;
  scene.initial.perturbation = 1e-3;
  if (moves) scene.initial.velocity = {0.1, 0.2, 0.3}, scene.initial.spin = {0, 0, 1};
  return scene;
}

struct Change {
  double energy, momentum;  // J and N s, between the first step and the 30th
};

Change change_in(const Scene& scene) {
  Cloth cloth = simulate(scene);
  const std::vector<double>& mass = cloth.scene().input.mass;
  const auto energy = [&] { return motion_of(mass, cloth.positions(), cloth.velocities()).kinetic_energy; };
  const auto momentum = [&] {
    Vector3 sum = Vector3::Zero();
    for (std::size_t v = 0; v < mass.size(); ++v)
      sum += mass[v] * cloth.velocities().row(static_cast<Eigen::Index>(v)).transpose();
    return sum;
  };
  cloth.step();
  const double energy_before = energy();
  const Vector3 momentum_before = momentum();
  for (int step = 0; step < 30; ++step) cloth.step();
  return {energy() - energy_before, (momentum() - momentum_before).norm()};
}

// The energy, J, that an effect without declared work may add. A uniform 0.1 m/s² would give five times as
// much to the sheet of 0.2 kg in these steps.
constexpr double tolerated = 5e-5;

// An effect that does work but does not declare it.
struct Liar {
  static const EffectKind kind;
};

template <class Real>
std::vector<Pass<Real>> push(const Liar&, const EffectInput&) {
  return {{"liar", Stage::force, [](PassContext<Real>& context) {
             for (std::size_t v = 0; v < static_cast<std::size_t>(context.state.vertex_count); ++v)
               context.state.accelerate(v, Vector3Of<Real>(0, 0, Real(0.1) * context.substep));
           }}};
}

const EffectKind Liar::kind{.name = "liar",
                            .settings = table_of<Liar>({}),
                            .compile_float = erased<push<float>>,
                            .compile_double = erased<push<double>>};

bool can_stand_alone(const EffectKind& kind) {
  for (const Field& field : kind.settings.fields)
    if (field.required) return false;
  return !kind.uses_contacts;  // it acts where an obstacle is
}

}  // namespace

TEST_CASE("effects without declared work or acceleration do no work", "[effects]") {
  int checked = 0;
  for (const EffectKind* kind : effects()) {
    if (!can_stand_alone(*kind)) continue;
    INFO(kind->name);
    ++checked;
    const Scene scene = scene_with(*kind, false);
    const Effect& effect = scene.effects.front();
    const bool may_drive = does_work(effect) || kind->acceleration != nullptr || kind->is_obstacle();
    const Change change = change_in(scene);
    // The perturbed sheet springs back. This gives at most the energy of a stretch of 1e-3 m, and damping
    // reduces it.
    const double of_the_sheet = change_in([&] {
                                  Scene alone = scene;
                                  alone.effects.clear();
                                  return alone;
                                }())
                                    .energy;
    if (!may_drive) CHECK(change.energy < std::abs(of_the_sheet) + tolerated);
  }
  CHECK(checked > 8);
  CHECK_FALSE(does_work(Effect(Liar::kind)));
  // Its force adds 2.5e-4 J, and the perturbed sheet loses a part of this.
  CHECK(change_in(scene_with(Liar::kind, false)).energy > 2 * tolerated);
}

TEST_CASE("effects that declare to keep momentum keep it", "[effects]") {
  for (const EffectKind* kind : effects()) {
    if (!can_stand_alone(*kind) || kind->needs_pins || !kind->keeps_momentum || kind->acceleration != nullptr)
      continue;
    INFO(kind->name);
    CHECK(change_in(scene_with(*kind, true)).momentum < 1e-9);  // N s, of 0.07 N s
  }
}

}  // namespace bendlab::traits_test
