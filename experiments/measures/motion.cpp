#include "bendlab/metrics/motion.hpp"

#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

class Motions final : public Measurement {
 public:
  Motions(const RunConfig&, const BuiltScene& scene) : scene_(scene) {}

  void capture(const Simulation& simulation, const Positions& positions, std::span<double> values) override {
    const Motion motion = motion_of(scene_.input.mass, positions, simulation.velocities());
    values[0] = motion.kinetic_energy;
    values[1] = motion.linear_momentum.norm(), values[2] = motion.angular_momentum.norm();
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.frames.empty()) return;
    findings.summary["kinetic_energy"] = end.frames.last_second_median("kinetic_energy");
    findings.summary["kinetic_energy_last"] = end.frames.last("kinetic_energy");
  }

 private:
  const BuiltScene& scene_;
};

}  // namespace

namespace measure {
extern const Measure motion{
    .name = "motion",
    .summary = "kinetic energy and momenta of the vertices as point masses",
    .cost = "a copy of the velocities per frame",
    .applies = always,
    .columns = []() -> std::vector<Column> {
      return {{"kinetic_energy", "J", "of all vertices as point masses"},
              {"linear_momentum", "kg m/s", "magnitude of the linear momentum"},
              {"angular_momentum", "kg m²/s", "magnitude of the angular momentum about the centre of mass"}};
    },
    .gives = []() -> std::vector<Quantity> {
      return {{"kinetic_energy", "J",
               "median over the last second; with the method equilibrium, the value of the last step"},
              {"kinetic_energy_last", "J", "of the last frame"}};
    },
    .begin = begun<Motions>};
}  // namespace measure
}  // namespace bendlab
