// Without a driving force, the total energy never exceeds the energy at the start.
#include "bendlab/constraints/energy.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::energy_test {
namespace {

constexpr double membrane_compliance = 1e-3;  // m/N

// Springs have 100 N/m. Other models have a flexural rigidity of the order of 10⁻⁴ N m, like a stiff cotton.
// (The iterations of a step do not converge for far stiffer cloth, and the remaining error counts as energy:
// |C|² / 2α.)
double bending_compliance(const BendingKind& model) {
  return model.springs_only ? 1e-2 : 1e4;
}

double total_energy(const SimulationInput& input, const Simulation& simulation) {
  const Positions x = simulation.positions(), v = simulation.velocities(), points = input.points_at(x);
  double energy = elastic_energy(input.strain, input.strain_stiffness.form, x) / membrane_compliance +
                  (elastic_energy(input.distance, x) + elastic_energy(input.elements, points) +
                   elastic_energy(input.own, points)) /
                      input.bending_stiffness.compliance;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const double mass = input.mass[static_cast<std::size_t>(i)];
    energy += mass * (0.5 * v.row(i).squaredNorm() + 9.81 * x(i, 2));
  }
  return energy;
}

}  // namespace

TEST_CASE("energy without driving never rises above its start", "[solver]") {
  // A sheet swings down from its corner. The method is XPBD, for which elastic energy is defined. The energy
  // may rise in single steps, which the test counts.
  const RestMesh rest(grid(1, 1, 8, 8));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 1);
  std::string counts;
  for (const BendingKind* model : bending_models())
    for (const bool damped : {false, true}) {
      if (model->needs_energy) continue;  // not for XPBD
      SimulationInput input = test::sheet(rest, pins, model->name);
      input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = membrane_compliance};
      input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = bending_compliance(*model)};
      input.settings.substeps = 4;
      std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
      if (damped) passes.push_back(test::effect_passes<double>("rigid_damping").front());
      const auto simulation = make_simulation<double>(input, std::move(passes));
      const double start = total_energy(input, *simulation),
                   scale = 0.2 * 9.81 * 0.5;  // J: it falls by half its size
      double last = start, highest = start;
      int rises = 0;
      for (int step = 0; step < 240; ++step) {
        REQUIRE(simulation->step());
        const double now = total_energy(input, *simulation);
        if (now > last + 1e-9 * scale) ++rises;
        last = now, highest = std::max(highest, now);
      }
      INFO(model->name << (damped ? ", damped" : ""));
      // v += h g, x += h v loses ½ m g² h² per step compared with the exact fall, and projections dissipate
      // energy. So only rounding can exceed the energy at the start.
      CHECK(highest <= start + 1e-9 * scale);
      counts += std::string(model->name) + (damped ? " (damped) " : " ") + std::to_string(rises) + ", ";
    }
  WARN("steps of 240 in which energy rose: " << counts);
}

TEST_CASE("the energy of a triangle agrees with the closed form of every strain form", "[solver]") {
  // Warp is along x and weft along y, both sides are 1 m long: A = 1/2. The triangle is stretched by s and
  // sheared by the angle φ.
  const RestMesh rest({(Positions(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished(),
                       (Triangles(1, 3) << 0, 1, 2).finished(),
                       {}});
  const Pins pins{.seeds = {}, .all = {}, .is_pinned = {0, 0, 0}};
  const StrainConstraints list = test::sheet(rest, pins, "none").strain;
  const double s = 1.3, phi = 0.4, area = 0.5;
  const Positions stretched = (Positions(3, 3) << 0, 0, 0, s, 0, 0, 0, 1, 0).finished();
  const Positions sheared = (Positions(3, 3) << 0, 0, 0, 1, 0, 0, std::sin(phi), std::cos(phi), 0).finished();
  const auto energy = [&](StrainForm form, const Positions& x) { return elastic_energy(list, form, x); };
  const auto is = [](double expected) { return Catch::Matchers::WithinRel(expected, 1e-13); };  // roundings
  const double stretch = 0.5 * area * (s - 1) * (s - 1);
  CHECK_THAT(energy(StrainForm::normalised, stretched), is(stretch));
  CHECK_THAT(energy(StrainForm::angle, stretched), is(stretch));
  CHECK_THAT(energy(StrainForm::green, stretched), is(0.5 * area * (s * s - 1) * (s * s - 1) / 4));
  CHECK_THAT(energy(StrainForm::normalised, sheared), is(0.5 * area * std::sin(phi) * std::sin(phi)));
  CHECK_THAT(energy(StrainForm::green, sheared), is(0.5 * area * std::sin(phi) * std::sin(phi)));
  CHECK_THAT(energy(StrainForm::angle, sheared), is(0.5 * area * phi * phi));
}

}  // namespace bendlab::energy_test
