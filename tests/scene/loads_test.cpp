// Loads: the momentum and the angular momentum that they give to a free cloth, against statics.
#include <cmath>
#include <numbers>

#include "bendlab/metrics/motion.hpp"
#include "bendlab/scene/simulate.hpp"
#include "tests/catch.hpp"

namespace bendlab::loads_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double step = 1e-4;  // s: so short that the cloth does not deform

Scene free_sheet(Effect load) {
  Scene scene;
  scene.mesh = grid(1, 0.5, 8, Diagonal::alternating);
  scene.pins.vertices = {};
  scene.effects = {std::move(load)};
  scene.solver.method = Newton{};
  scene.solver.dt = step, scene.solver.substeps = 1;
  scene.duration = step;
  return scene;
}

struct Gained {
  Vector3 momentum, angular_momentum;  // per second: N and N m, about the centre of mass
};

Gained gained(const Scene& scene) {
  Cloth cloth = simulate(scene);
  cloth.step();
  const Motion motion = motion_of(cloth.scene().input.mass, cloth.positions(), cloth.velocities());
  return {motion.linear_momentum / step, motion.angular_momentum / step};
}

}  // namespace

TEST_CASE("a load adds its force to the momentum, however it is spread", "[scene]") {
  for (const Load::Spread spread : {Load::Spread::equal, Load::Spread::length, Load::Spread::area}) {
    const Gained sum =
        gained(free_sheet(Load{.vertices = {Place::right}, .force = {1, -2, 3}, .spread = spread}));
    CHECK((sum.momentum - Vector3(1, -2, 3)).norm() < 1e-6);  // of the solver's tolerance
    // The force acts at the middle of the right side, 0.5 m from the centre.
    CHECK((sum.angular_momentum - Vector3(0.5, 0, 0).cross(Vector3(1, -2, 3))).norm() < 1e-4);
  }
}

TEST_CASE("a load is spread equally, by length or by area", "[scene]") {
  // The right side has 4 cells, so 5 vertices. A corner has half the length of an inner vertex, and masses
  // are in proportion to areas. The cloth is so soft that its forces are below 1e-6 of the load.
  for (const Load::Spread spread : {Load::Spread::equal, Load::Spread::length, Load::Spread::area}) {
    Scene scene = free_sheet(Load{.vertices = {Place::right}, .force = {0, 0, 1}, .spread = spread});
    scene.material.strain.membrane_stiffness = 1e-6, scene.bending.flexural_rigidity = 1e-12;
    Cloth cloth = simulate(scene);
    const std::vector<double> mass = cloth.scene().input.mass;
    const std::vector<int> side = select_vertices(cloth.scene().rest, Place::right),
                           corner = select_vertices(cloth.scene().rest, Place::upper_right);
    double of_side = 0;
    for (const int v : side) of_side += mass[static_cast<std::size_t>(v)];
    cloth.step();
    const double own = mass[static_cast<std::size_t>(corner.front())],
                 share = own * cloth.velocities()(corner.front(), 2) / step;
    const double expected = spread == Load::Spread::equal    ? 1.0 / 5
                            : spread == Load::Spread::length ? 1.0 / 8
                                                             : own / of_side;
    CHECK(side.size() == 5);
    CHECK_THAT(share, WithinRel(expected, 1e-5));  // rounding of positions, over a step of 1e-4 s
  }
}

TEST_CASE("a load that follows turns with the cloth, a dead load does not", "[scene]") {
  for (const bool follows : {false, true}) {
    Scene scene = free_sheet(Load{.vertices = {Place::right}, .force = {0, 0, 2}, .follows = follows});
    scene.initial.tilt = 90;  // z becomes -y
    const Vector3 expected = follows ? Vector3(0, -2, 0) : Vector3(0, 0, 2);
    CHECK((gained(scene).momentum - expected).norm() < 1e-6);
  }
}

TEST_CASE("a load grows during its ramp", "[scene]") {
  Load load{.vertices = {Place::right}, .force = {0, 0, 2}};
  load.ramp = 4 * step;
  CHECK_THAT(gained(free_sheet(load)).momentum.z(), WithinRel(0.5, 1e-6));  // a quarter after a step
}

TEST_CASE("pressure pushes along the normals", "[scene]") {
  const Gained sum = gained(free_sheet(Pressure{.pressure = 3}));
  CHECK((sum.momentum - Vector3(0, 0, 3 * 0.5)).norm() < 1e-6);
  Scene scene = free_sheet(Pressure{.pressure = 3});
  scene.initial.tilt = 90;
  CHECK((gained(scene).momentum - Vector3(0, -1.5, 0)).norm() < 1e-6);
}

TEST_CASE("a moment at a border is a pure couple about the border", "[scene]") {
  const Gained sum = gained(free_sheet(EdgeMoment{.vertices = {Place::right}, .moment = 0.7}));
  CHECK(sum.momentum.norm() < 1e-6);
  CHECK_THAT(sum.angular_momentum.y(), WithinRel(0.7, 1e-4));  // turns the border to -z
  CHECK_THAT(sum.angular_momentum.x(), WithinAbs(0, 1e-4));
}

TEST_CASE("loads that cannot act say what to do", "[scene]") {
  Scene pinned = free_sheet(Load{.vertices = {Place::left}, .force = {0, 0, 1}});
  pinned.pins.vertices = {Place::left};
  CHECK_THROWS_WITH(simulate(pinned), ContainsSubstring("only on pinned vertices") &&
                                          ContainsSubstring("remove them from /pins"));
  CHECK_THROWS_WITH(simulate(free_sheet(EdgeMoment{.vertices = {Place::upper_right}, .moment = 1})),
                    ContainsSubstring("no border edge") && ContainsSubstring("a whole side"));
  CHECK_THROWS_WITH(simulate(free_sheet(Load{.indices = {1000}, .force = {0, 0, 1}})),
                    ContainsSubstring("1000 is not a vertex"));
  CHECK_THROWS_WITH(simulate(free_sheet(Load{
                        .vertices = {Place::centre}, .force = {0, 0, 1}, .spread = Load::Spread::length})),
                    ContainsSubstring("no length"));
}

TEST_CASE("held vertices keep their coordinate with every method that can hold them", "[scene]") {
  for (const MethodKind* method : methods()) {
    Scene scene;
    scene.mesh = grid(1, 1, 6);
    scene.pins.vertices = {Place::upper_left};
    scene.pins.hold_z = {Place::right};
    scene.pins.hold_x_indices = {0};
    scene.effects = {Gravity{}, ViscousDrag{}};
    scene.solver.method = Method(*method);
    scene.duration = 0.5;
    INFO(method->name);
    if (!method->holds_axes) {
      CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("hold_x") || ContainsSubstring("compliance") ||
                                             ContainsSubstring("springs"));
      continue;
    }
    if (!method->has_motion) scene.effects = {Gravity{}}, scene.duration = 2;
    Cloth cloth = simulate(scene);
    const Positions start = cloth.positions();
    cloth.run(scene.duration);
    const Positions end = cloth.positions();
    const std::vector<int> right = select_vertices(cloth.scene().rest, Place::right);
    double moved = 0;
    for (const int v : right) {
      CHECK_THAT(end(v, 2), WithinAbs(start(v, 2), 1e-7));  // rounding of single precision
      moved = std::max(moved, (end.row(v) - start.row(v)).norm());
    }
    CHECK(moved > 1e-4);  // along the other axes they are free
    CHECK_THAT(end(0, 0), WithinAbs(start(0, 0), 1e-7));
    CHECK(std::abs(end(0, 2) - start(0, 2)) > 1e-3);
  }
}

TEST_CASE("axes hold a sheet without pins, also on a tilted plane and with a disturbed start", "[scene]") {
  for (const MethodKind* method : methods()) {
    if (!method->holds_axes || !method->has_motion) continue;
    Scene scene;
    scene.mesh = grid(1, 1, 6);
    scene.pins.vertices = {};
    scene.pins.hold_z = {Place::left, Place::right};
    scene.initial.perturbation = 1e-3;
    scene.solver.method = Method(*method);
    for (const bool on_plane : {false, true}) {
      scene.effects = {Gravity{}, ViscousDrag{}};
      if (on_plane) {  // a millimetre below the left side, which the load pushes into the plane
        scene.effects.push_back(Plane{.point = {0, 0, -0.101}, .normal = {0.2, 0, 1}});
        scene.effects.push_back(Load{.vertices = {Place::left}, .force = {-0.5, 0, 0}});
      }
      if (method->projects) scene.effects.push_back(StrainLimiting{});
      INFO(method->name << (on_plane ? ", on a plane" : ""));
      Cloth cloth = simulate(scene);
      const Positions start = cloth.positions();
      CHECK((start - cloth.scene().rest.positions()).cwiseAbs().maxCoeff() > 1e-4);
      cloth.run(0.3);
      for (const Place side : {Place::left, Place::right})
        for (const int v : select_vertices(cloth.scene().rest, side)) {
          CHECK(start(v, 2) == 0);
          CHECK_THAT(cloth.positions()(v, 2), WithinAbs(0, 1e-7));  // rounding of single precision
        }
    }
  }
}

TEST_CASE("a surface at the start lies where the mesh lies", "[scene]") {
  Scene scene;
  scene.mesh = grid(1, 1, 8);
  scene.initial.surface = {.shape = SurfaceShape::cylinder, .radius = 0.4};
  const Positions pose = simulate(scene).positions();
  scene.mesh.offset = {5, -2, 3};
  CHECK((simulate(scene).positions() - (pose.rowwise() + Eigen::RowVector3d(5, -2, 3))).norm() < 1e-5);
  scene.mesh.offset = {0, 0, 0};
  scene.mesh.scale = 0.5;  // the radius stays
  const Positions half = simulate(scene).positions();
  for (const auto p : half.rowwise())
    CHECK_THAT(std::hypot(p(0), p(2) - 0.4), WithinRel(0.4, 1e-5));  // rounding of single precision
}

TEST_CASE("a shell's stiffnesses follow from its material", "[scene]") {
  Scene scene;
  scene.mesh = grid(1, 1, 4);
  scene.bending.model = MidEdge{};
  scene.material.youngs_modulus = 2e6, scene.material.thickness = 0.01, scene.material.poisson_ratio = 0.25;
  const Cloth cloth = simulate(scene);
  const SimulationInput& input = cloth.scene().input;
  CHECK(input.strain_stiffness.form == StrainForm::stvk);
  // E h = 2e4, so the compliance is (1 + ν) / E h, and the flexural rigidity E h³ / 12 (1 - ν²).
  CHECK_THAT(input.strain_stiffness.compliance, WithinRel(1.25 / 2e4, 1e-12));
  CHECK_THAT(input.strain_stiffness.area, WithinRel(0.25 / 0.75, 1e-12));
  const auto& list = std::get<ElementList<MidEdgeBend>>(input.elements);
  CHECK_THAT(1 / list.softness.at(0), WithinRel(2e6 * 1e-6 / (12 * (1 - 0.0625)), 1e-12));
  scene.material.thickness.reset();
  CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("needs a thickness"));
  scene.material.thickness = 0.01, scene.material.poisson_ratio = 0.5;
  CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("poisson_ratio"));
}

TEST_CASE("a stretched isotropic sheet contracts across by Poisson's ratio", "[scene]") {
  // A strip pulled along x: the mean strain across is -ν times the strain along, up to the rows at both ends,
  // which keep their width. In the middle third the strain is uniform.
  Scene scene;
  scene.mesh = grid(3, 0.5, 36, Diagonal::alternating);
  scene.pins.vertices = {Place::left};
  scene.material.youngs_modulus = 1e6, scene.material.thickness = 0.01, scene.material.poisson_ratio = 0.4;
  scene.effects = {Load{.vertices = {Place::right}, .force = {10, 0, 0}, .spread = Load::Spread::length}};
  scene.solver.method = Equilibrium{};
  scene.duration = 5;
  Cloth cloth = simulate(scene);
  cloth.run(scene.duration);
  const Positions start = cloth.scene().rest.positions(), end = cloth.positions();
  double along = 0, across = 0, squares_x = 0, squares_y = 0;
  for (Eigen::Index v = 0; v < start.rows(); ++v) {
    const double x = start(v, 0) - cloth.scene().rest.centre().x(),
                 y = start(v, 1) - cloth.scene().rest.centre().y();
    if (std::abs(x) > 0.5) continue;
    along += x * (end(v, 0) - start(v, 0)), squares_x += x * x;
    across += y * (end(v, 1) - start(v, 1)), squares_y += y * y;
  }
  along /= squares_x, across /= squares_y;
  CHECK_THAT(along, WithinRel(10 / 0.5 / 1e4, 0.01));  // σ h / (E h); Green's strain adds ε / 2
  CHECK_THAT(across / along, WithinAbs(-0.4, 0.01));
}

}  // namespace bendlab::loads_test
