#include <Eigen/Geometry>
#include <cmath>
#include "bendlab/mesh/generators.hpp"

#include "bendlab/metrics/motion.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "tests/catch.hpp"

namespace bendlab::metrics_test {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE("principal stretches of a known deformation are right", "[metrics]") {
  const RestMesh rest(delaunay(2, 1, 6, 1));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 1);
  const StretchMeter meter(rest, pins);
  // Stretch by 1.5 and 0.8 along axes turned by 30°, then a rigid rotation out of the plane. So σ = 1.5 and
  // 0.8 everywhere.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5235987755982988, Vector3::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d rigid = Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d f = rigid * turn * Vector3(1.5, 0.8, 1).asDiagonal() * turn.transpose();
  const Positions deformed = rest.positions() * f.transpose();
  const auto stretches = meter.measure(deformed);
  REQUIRE(stretches.size() == static_cast<std::size_t>(rest.triangle_count()));
  for (const PrincipalStretches& s : stretches) {
    CHECK_THAT(s.largest, WithinRel(1.5, 1e-12));
    CHECK_THAT(s.smallest, WithinRel(0.8, 1e-12));
  }
  const StretchSummary summary = meter.summarise(stretches);
  CHECK_THAT(summary.mean_strain, WithinRel(0.5, 1e-12));
  CHECK_THAT(summary.max_stretch, WithinRel(1.5, 1e-12));
  CHECK_THAT(summary.pin_max_stretch, WithinRel(1.5, 1e-12));
}

TEST_CASE("stretch at the pin and stretch around it use the right triangles", "[metrics]") {
  // A row of unit cells. The triangles of the leftmost cell are stretched, and the pin is at the right.
  const RestMesh rest(grid(10, 1, 10, 1));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 0);
  const StretchMeter meter(rest, pins);
  Positions positions = rest.positions();
  for (const int v : select_vertices(rest, Place::left)) positions(v, 0) -= 1;  // the leftmost cell is 2 wide
  const StretchSummary summary = meter.summarise(meter.measure(positions));
  CHECK_THAT(summary.max_stretch, WithinRel(2.0, 1e-12));
  CHECK_THAT(summary.pin_max_stretch, WithinRel(1.0, 1e-12));
  CHECK_THAT(summary.pin_region_stretch, WithinRel(1.0, 1e-12));
  CHECK_THAT(summary.mean_strain, WithinRel(2.0 / 20, 1e-12));  // two triangles of twenty, strain 1
  const StretchSummary without_pins =
      StretchMeter(rest, make_pins(rest, {}, 0)).summarise(meter.measure(positions));
  CHECK(std::isnan(without_pins.pin_max_stretch));
}

TEST_CASE("energy and momenta of a rigid motion are right", "[metrics]") {
  // A dumbbell: two masses of 1.5 kg, 1 m from its centre. It spins at 3 rad/s about z and moves at 2 m/s
  // along z.
  const std::vector<double> mass = {1.5, 1.5};
  Positions positions(2, 3), velocities(2, 3);
  positions << 6, 5, 0, 4, 5, 0;
  velocities << 0, 3, 2, 0, -3, 2;
  const Motion motion = motion_of(mass, positions, velocities);
  CHECK_THAT(motion.kinetic_energy, WithinRel(0.5 * 3 * (9 + 4), 1e-14));
  CHECK_THAT(motion.linear_momentum.z(), WithinRel(6.0, 1e-14));
  CHECK_THAT(motion.angular_momentum.z(), WithinRel(9.0, 1e-14));
  CHECK(motion.angular_momentum.head<2>().norm() < 1e-13);  // about its centre, which is not the origin
  CHECK_THAT(drop_below(1, Positions(positions.array() - 3), -Vector3::UnitZ()), WithinAbs(2, 1e-14));
}

}  // namespace bendlab::metrics_test
