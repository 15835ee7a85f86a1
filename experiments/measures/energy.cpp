#include <cmath>

#include "bendlab/scene/energy.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

// Energies and forces of the pose at the start.
class Energy final : public Measurement {
 public:
  Energy(const RunConfig&, const BuiltScene& scene) : scene_(scene) {}

  void finish(const RunEnd&, Findings& findings) override {
    double membrane = 0, bending = 0, largest = 0;
    Positions sum = Positions::Zero(scene_.input.positions.rows(), 3);
    for (const EnergyPart& part : energy_parts(scene_.input, scene_.input.positions)) {
      (part.name == "strain" ? membrane : bending) += part.energy;
      sum += part.forces;
    }
    for (const auto force : sum.rowwise()) largest = std::max(largest, force.norm());
    findings.summary["energy_membrane_start"] = membrane;
    findings.summary["energy_bending_start"] = bending;
    findings.summary["energy_resultant_start"] = sum.colwise().sum().norm();
    findings.summary["energy_force_start"] = largest;
  }

 private:
  const BuiltScene& scene_;
};

}  // namespace

namespace measure {
extern const Measure energy{
    .name = "energy",
    .summary =
        "elastic energies and forces of the pose at the start, which `bendlab energy` prints without a run",
    .cost = "the time of one gradient; for models with directors, of a few small Newton steps",
    .gives = []() -> std::vector<Quantity> {
      return {{"energy_membrane_start", "J", "of the strain constraints in the pose at the start"},
              {"energy_bending_start", "J", "of the bending model in the pose at the start"},
              {"energy_resultant_start", "N",
               "length of the sum of all elastic forces in the pose at the start, which is 0 up to rounding"},
              {"energy_force_start", "N", "largest elastic force on a vertex in the pose at the start"}};
    },
    .begin = begun<Energy>};
}  // namespace measure
}  // namespace bendlab
