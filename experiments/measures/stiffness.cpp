#include <fmt/format.h>

#include "experiments/measures/measure.hpp"
#include "experiments/measures/strip.hpp"

namespace bendlab {
namespace {

class StripReadings final : public Measurement {
 public:
  explicit StripReadings(RunStrip strip) : strip_(std::move(strip)) {}

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.status == RunStatus::diverged) return;
    try {
      const StripStiffness stiffness = strip_.meter.measure(end.simulation.positions(), strip_.options);
      findings.summary.merge(summary_of(stiffness));
    } catch (const std::invalid_argument& error) {  // its pins may have moved
      findings.messages.push_back(fmt::format("no stiffness: {}", error.what()));
    }
  }

 private:
  RunStrip strip_;
};

}  // namespace

namespace measure {
extern const Measure stiffness{
    .name = "stiffness",
    .summary =
        "stiffness of a cantilever strip, from its free end and from its whole shape (see `bendlab "
        "stiffness`)",
    .cost = "computed once, at the end",
    .gives = []() -> std::vector<Quantity> {
      return {{"stiffness_height_over_width", "1",
               "H/W: how far the free end hangs down, divided by how far it reaches out"},
              {"stiffness_gamma", "1", "ρ g L³ / B of the heavy elastica with this H/W"},
              {"stiffness_flexural_rigidity", "N m", "B of the elastica with this H/W (moment m = B κ)"},
              {"stiffness_bending_length", "m", "(B / ρ g)^(1/3), as in ASTM D1388"},
              {"stiffness_quartic", "N m³", "C of a strip with this H/W and the moment m = C κ³"},
              {"stiffness_fit_exponent", "1", "p of m ∝ κ^p, fitted to the whole shape"},
              {"stiffness_fit_B", "N m", "B fitted to the whole shape"},
              {"stiffness_fit_C", "N m³", "C fitted to the whole shape"}};
    },
    .begin = [](const RunConfig& config, const BuiltScene& scene) -> std::unique_ptr<Measurement> {
      try {
        RunStrip strip = strip_of(config, scene.rest, scene.pins);
        // Throws if the clamp is turned or folded at the start.
        strip.meter.height_over_width(scene.input.positions, 0);
        return std::make_unique<StripReadings>(std::move(strip));
      } catch (const std::invalid_argument& error) {
        throw ConfigError("stiffness", {{"/output/measures", error.what()}});
      }
    }};
}  // namespace measure
}  // namespace bendlab
