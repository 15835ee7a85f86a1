#include <algorithm>
#include <limits>

#include "bendlab/metrics/motion.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

// Coordinate along `down` of the highest pin; without pins, of the lowest vertex at the start.
double highest_pin(const BuiltScene& scene) {
  const Positions& start = scene.input.positions;
  double highest = std::numeric_limits<double>::infinity();  // the smallest coordinate along `down`
  for (const int seed : scene.pins.seeds) highest = std::min(highest, start.row(seed).dot(scene.down));
  return scene.pins.seeds.empty() ? (start * scene.down).maxCoeff() : highest;
}

class Drop final : public Measurement {
 public:
  Drop(const RunConfig&, const BuiltScene& scene) : down_(scene.down), highest_pin_(highest_pin(scene)) {}

  void complete(const MeasuredFrame& frame, std::span<double> values,
                std::span<std::vector<float>>) override {
    values[0] = drop_below(highest_pin_, frame.positions(), down_);
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.frames.empty()) return;
    findings.summary["drop"] = end.frames.last_second_median("drop");
    findings.summary["drop_last"] = end.frames.last("drop");
  }

 private:
  Vector3 down_;
  double highest_pin_;  // m, along `down`
};

}  // namespace

namespace measure {
extern const Measure drop{
    .name = "drop",
    .summary = "how far the cloth hangs down",
    .cost = "next to nothing",
    .applies = always,
    .columns = []() -> std::vector<Column> {
      return {
          {"drop", "m",
           "how far the lowest vertex hangs below the highest pin (without pins: below the lowest vertex at "
           "the start)"}};
    },
    .gives = []() -> std::vector<Quantity> {
      return {{"drop", "m",
               "median over the last second; with the method equilibrium, the value of the last step"},
              {"drop_last", "m", "of the last frame"}};
    },
    .begin = begun<Drop>};
}  // namespace measure
}  // namespace bendlab
