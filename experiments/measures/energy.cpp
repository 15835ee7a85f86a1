#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "bendlab/constraints/yielding.hpp"
#include "bendlab/scene/energy.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

// Energies and forces of the pose at the start, and energies of the pose at the end.
class Energy final : public Measurement {
 public:
  Energy(const RunConfig&, const BuiltScene& scene) : scene_(scene) {}

  void finish(const RunEnd& end, Findings& findings) override {
    const Positions sum = add_energies(scene_.input.positions, 0, "start", findings);
    double largest = 0;
    for (const auto force : sum.rowwise()) largest = std::max(largest, force.norm());
    findings.summary["energy_resultant_start"] = sum.colwise().sum().norm();
    findings.summary["energy_force_start"] = largest;
    if (!is_whole(end.status)) return;
    if (can_yield(scene_.input.elements))
      findings.messages.push_back(
          "the energy at the end is not known, because hysteresis and plasticity depend on how the cloth "
          "moved");
    else  // an equilibrium is that of the last stiffness
      add_energies(end.simulation.positions(),
                   scene_.input.method.kind().has_motion ? end.simulation.time()
                                                         : std::numeric_limits<double>::infinity(),
                   "end", findings);
  }

 private:
  // Adds the energies of a pose at a time (s). Returns the elastic forces, #V by 3, N.
  Positions add_energies(const Positions& pose, double time, std::string_view when,
                         Findings& findings) const {
    double membrane = 0, bending = 0;
    Positions sum = Positions::Zero(pose.rows(), 3);
    for (const EnergyPart& part : energy_parts(scene_.input, pose)) {
      const bool is_strain = part.name == "strain";
      const double factor =
          (is_strain ? scene_.input.strain_schedule : scene_.input.bending_schedule).at(time);
      (is_strain ? membrane : bending) += factor * part.energy;
      sum += factor * part.forces;
    }
    findings.summary[fmt::format("energy_membrane_{}", when)] = membrane;
    findings.summary[fmt::format("energy_bending_{}", when)] = bending;
    return sum;
  }

  const BuiltScene& scene_;
};

}  // namespace

namespace measure {
extern const Measure energy{
    .name = "energy",
    .summary =
        "elastic energies and forces of the pose at the start, which `bendlab energy` prints without a run, "
        "and elastic energies of the pose at the end",
    .cost = "the time of one gradient; for models with directors, of a few small Newton steps",
    .gives = []() -> std::vector<Quantity> {
      return {{"energy_membrane_start", "J", "of the strain constraints in the pose at the start"},
              {"energy_bending_start", "J", "of the bending model in the pose at the start"},
              {"energy_resultant_start", "N",
               "length of the sum of all elastic forces in the pose at the start, which is 0 up to rounding"},
              {"energy_force_start", "N", "largest elastic force on a vertex in the pose at the start"},
              {"energy_membrane_end", "J", "of the strain constraints in the pose at the end"},
              {"energy_bending_end", "J", "of the bending model in the pose at the end"}};
    },
    .begin = begun<Energy>};
}  // namespace measure
}  // namespace bendlab
