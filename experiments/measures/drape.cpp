#include "bendlab/metrics/drape.hpp"

#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

class Draping final : public Measurement {
 public:
  explicit Draping(const BuiltScene& scene) : scene_(scene) {}

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.status == RunStatus::diverged) return;
    const Drape drape = drape_of(scene_.rest, scene_.pins, end.simulation.positions(), scene_.down);
    findings.summary["drape_coefficient"] = drape.coefficient;
    findings.summary["drape_folds"] = drape.folds;
  }

 private:
  const BuiltScene& scene_;
};

}  // namespace

namespace measure {
extern const Measure drape{
    .name = "drape",
    .summary = "how a round specimen hangs over a round table of pinned triangles (Cusick 1965)",
    .cost = "computed once, at the end",
    .gives = []() -> std::vector<Quantity> {
      return {{"drape_coefficient", "1", "areas (shadow - table) / (specimen - table); 1 for a stiff board"},
              {"drape_folds", "1", "number of folds around the table"}};
    },
    .begin = [](const RunConfig&, const BuiltScene& scene) -> std::unique_ptr<Measurement> {
      try {
        drape_of(scene.rest, scene.pins, scene.rest.positions(), scene.down);
      } catch (const std::invalid_argument& error) {
        throw ConfigError("drape", {{"/output/measures", error.what()}});
      }
      return std::make_unique<Draping>(scene);
    }};
}  // namespace measure
}  // namespace bendlab
