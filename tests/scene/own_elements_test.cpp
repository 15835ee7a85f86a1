// Elements with a user's function, compared with the same elements with kernels.
#include "bendlab/constraints/own_elements.hpp"

#include <cmath>

#include "bendlab/bending/rest_hinges.hpp"
#include "bendlab/bendlab.hpp"
#include "bendlab/constraints/corners.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "tests/catch.hpp"

namespace bendlab::own_elements_test {
namespace {

using Catch::Matchers::ContainsSubstring;

// C = θ - θ0 for the hinges of a list, or U = ½ C².
class Angles final : public ElementFunction {
 public:
  Angles(ElementList<HingeAngle> list, bool is_energy) : list_(std::move(list)), is_energy_(is_energy) {}

  std::string_view name() const override { return "angles"; }
  bool is_energy() const override { return is_energy_; }
  void evaluate(std::span<const int> which, std::span<const double> corners, std::span<double> values,
                std::span<double> gradients) const override {
    for (std::size_t i = 0; i < which.size(); ++i) {
      std::array<Vector3, 4> p;
      for (std::size_t corner = 0; corner < 4; ++corner) p[corner] = Vector3(&corners[12 * i + 3 * corner]);
      const auto c = HingeAngle::value<double>(p, list_.rest[static_cast<std::size_t>(which[i])], list_.law);
      values[i] = !c.defined ? std::nan("") : is_energy_ ? 0.5 * c.value * c.value : c.value;
      for (std::size_t corner = 0; corner < 4; ++corner)
        Eigen::Map<Vector3>{gradients.data() + 12 * i + 3 * corner} =
            (is_energy_ ? c.value : 1) * c.gradient[corner];
    }
  }

 private:
  ElementList<HingeAngle> list_;
  bool is_energy_;
};

struct Settings {
  bool own = false, is_energy = false;
};

BendingConstraints build(const Settings& settings, const BendingInput& input) {
  BendingConstraints constraints;
  ElementList<HingeAngle> list =
      angle_constraints(rest_hinges(input.rest, input.pins), HingeAngle::Law::angle,
                        [](const RestHinge& hinge) { return hinge.area / (hinge.edge * hinge.edge); });
  if (settings.own) {
    OwnElements& own = constraints.own;
    own.arity = 4, own.softness = list.softness;
    for (const auto& vertices : list.vertices)
      own.vertices.insert(own.vertices.end(), vertices.begin(), vertices.end());
    own.function = std::make_shared<Angles>(std::move(list), settings.is_energy);
  } else {
    std::get<ElementList<HingeAngle>>(constraints.elements) = std::move(list);
  }
  return constraints;
}

template <int variant>
struct Hinges : Settings {
  Hinges() : Settings{.own = variant > 0, .is_energy = variant == 2} {}
  static const BendingKind kind;
};
template <int variant>
const BendingKind Hinges<variant>::kind{.name = "hinges",
                                        .settings = table_of<Hinges<variant>>({}),
                                        .softness_needs_compliance = true,
                                        .build = [](const void* settings, const BendingInput& input) {
                                          return build(*static_cast<const Hinges<variant>*>(settings), input);
                                        }};
using Kernels = Hinges<0>;
using Own = Hinges<1>;
using OwnEnergy = Hinges<2>;

Scene sheet(Method method, BendingModel model) {
  Scene scene;
  scene.mesh = grid(1, 1, 6);
  scene.mesh.jitter = 0.2;
  scene.pins.vertices = {Place::upper_left, Place::upper_right};
  scene.initial.tilt = 30;
  scene.bending = {.model = std::move(model), .stiffness = Stiffness::compliance, .compliance = 1e3};
  scene.solver.method = std::move(method);
  if (scene.solver.method.kind().make_float) scene.solver.precision = ChosenPrecision::double_precision;
  return scene;
}

double difference(Scene a, Scene b, int steps) {
  Cloth left = simulate(std::move(a)), right = simulate(std::move(b));
  for (int i = 0; i < steps && !left.simulation().settled(); ++i) left.step(), right.step();
  return (left.positions() - right.positions()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("own elements: pbd gives the same steps as with the oracle and with kernels", "[own]") {
  const auto order = GENERATE(ConstraintOrder::mesh, ConstraintOrder::colour);
  const auto sweep = GENERATE(Sweep::forward, Sweep::symmetric);
  const bool by_k = GENERATE(false, true);
  const Pbd pbd{.sweep = sweep, .order = order};
  Scene own = sheet(pbd, Own{}), known = sheet(pbd, Kernels{});
  for (Scene* scene : {&own, &known}) {
    scene->solver.substeps = 4, scene->solver.iterations = 3;
    if (by_k) scene->bending.stiffness = Stiffness::k, scene->bending.k = 0.3;
  }
  // The oracle has the same arithmetic as Angles. Kernels have sums in another order, and the motion
  // amplifies this rounding.
  CHECK(difference(own, known, 100) < (order == ConstraintOrder::mesh ? 1e-12 : 1e-9));
}

TEST_CASE("own elements: an energy ½ C² is projected like C", "[own]") {
  const Pbd pbd{.order = ConstraintOrder::mesh};
  CHECK(difference(sheet(pbd, OwnEnergy{}), sheet(pbd, Kernels{}), 30) < 1e-9);
}

TEST_CASE("own elements: single precision agrees with double precision up to rounding", "[own]") {
  const Scene exact = sheet(Pbd{}, Kernels{});
  Scene single = sheet(Pbd{}, Own{}), known = exact;
  for (Scene* scene : {&single, &known}) scene->solver.precision = ChosenPrecision::single_precision;
  // Two different roundings differ by about the effect of rounding itself.
  CHECK(difference(single, known, 20) < 10 * difference(known, exact, 20));
}

TEST_CASE("own elements: implicit methods find the same minimum as with kernels", "[own]") {
  const double tolerance = 1e-7;  // m: the tolerance of the steps for a sheet of 1 m
  SECTION("newton") {
    Scene known = sheet(Newton{}, Kernels{});
    CHECK(difference(sheet(Newton{}, Own{}), known, 20) < 1e-12);
    CHECK(difference(sheet(Newton{}, OwnEnergy{}), known, 20) < tolerance);
  }
  SECTION("equilibrium") {
    Scene known = sheet(Equilibrium{}, Kernels{});
    CHECK(difference(sheet(Equilibrium{}, Own{}), known, 200) < tolerance);
    CHECK(difference(sheet(Equilibrium{}, OwnEnergy{}), known, 200) < 1e-6);  // within its residual
  }
  SECTION("quasi_newton") {
    const auto converged = [](BendingModel model) {
      Scene scene = sheet(QuasiNewton{.tolerance = 0}, std::move(model));
      scene.solver.iterations = 200;
      return scene;
    };
    CHECK(difference(converged(Own{}), converged(Kernels{}), 20) < 1e-6);
    CHECK(difference(converged(OwnEnergy{}), converged(Kernels{}), 20) < 1e-6);
  }
}

TEST_CASE("own elements: forces are the negative gradient of the energy", "[own]") {
  for (const bool is_energy : {false, true}) {
    Cloth cloth = is_energy ? simulate(sheet(Newton{}, OwnEnergy{})) : simulate(sheet(Newton{}, Own{}));
    const SimulationInput& input = cloth.scene().input;
    const ElasticSystem system(input);
    cloth.run(0.3);
    Positions positions = cloth.positions();
    const Points<double> forces = system.forces(positions);
    CHECK(std::abs(system.energy(positions) / elastic_energy(input, positions) - 1) < 1e-12);
    for (const int v : {5, 17, 30})
      for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-6, at = positions(v, axis);
        positions(v, axis) = at + h;
        const double ahead = system.energy(positions);
        positions(v, axis) = at - h;
        const double behind = system.energy(positions);
        positions(v, axis) = at;
        // The tolerance covers the rounding of an energy divided by the step, and the third derivative.
        const double expected = -(ahead - behind) / (2 * h);
        CHECK(std::abs(forces[static_cast<std::size_t>(v)].vector()(axis) - expected) <
              1e-5 * std::abs(expected) + 1e-15 * ahead / h);
      }
  }
}

TEST_CASE("own elements: constraint damping has the same effect as with kernels", "[own]") {
  Scene own = sheet(Pbd{.order = ConstraintOrder::mesh}, Own{}),
        known = sheet(Pbd{.order = ConstraintOrder::mesh}, Kernels{});
  for (Scene* scene : {&own, &known}) scene->effects.push_back(ConstraintDamping{.rate = 5});
  CHECK(difference(own, known, 30) < 1e-12);
}

TEST_CASE("own elements: they are calibrated to a stated rigidity, and facts report the result", "[own]") {
  Scene scene = sheet(Newton{}, Own{});
  scene.mesh = {.generator = Generator::equilateral, .cells = 20};
  scene.bending = {.model = Own{}, .flexural_rigidity = 1e-4};
  const Cloth cloth = simulate(scene);
  const auto fact = [&](std::string_view name) {
    return std::ranges::find(cloth.scene().bending_facts, name, &BendingFact::name)->value;
  };
  // Discrete shells' weights of 3 e²/A, for ½ θ² per hinge, are 1 N m on equilateral triangles, except at the
  // border.
  CHECK(std::abs(fact("large_deflection") - 1) < 0.05);
  CHECK(fact("large_deflection_most") / fact("large_deflection_least") < 1.05);
  CHECK(cloth.scene().input.own.softness.front() * cloth.scene().input.bending_stiffness.compliance > 0);
}

TEST_CASE("own elements: methods that do not support them refuse them", "[own]") {
  CHECK_THROWS_WITH(simulate(sheet(Vbd{}, Own{})),
                    ContainsSubstring("/solver/method") && ContainsSubstring("newton"));
}

}  // namespace bendlab::own_elements_test
