#include "bendlab/metrics/stretch.hpp"

#include <cmath>

#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

const std::vector<Column> stretch_columns = {
    {"mean_strain", "1", "mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|), σ the principal stretches"},
    {"max_stretch", "1", "largest σ₁"},
    {"pin_max_stretch", "1", "largest σ₁ over triangles that touch a pinned vertex"},
    {"pin_region_stretch", "1", "largest σ₁ within 0.1 mesh sizes of a pin that the config names"}};

class Stretches final : public Measurement {
 public:
  Stretches(const RunConfig&, const BuiltScene&) {}

  void complete(const MeasuredFrame& frame, std::span<double> values,
                std::span<std::vector<float>> fields) override {
    const StretchSummary& stretch = frame.stretch();
    values[0] = stretch.mean_strain, values[1] = stretch.max_stretch;
    values[2] = stretch.pin_max_stretch, values[3] = stretch.pin_region_stretch;
    for (const PrincipalStretches& s : frame.stretches()) {
      fields[0].push_back(static_cast<float>(s.largest));
      fields[1].push_back(static_cast<float>(s.smallest));
    }
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.frames.empty()) return;
    const auto add = [&](const std::string& name, double value) {
      if (!std::isnan(value)) findings.summary[name] = value;  // a cloth without pins has no stretch at them
    };
    for (const Column& column : stretch_columns) {
      add(column.name, end.frames.last_second_median(column.name));
      add(column.name + "_last", end.frames.last(column.name));
    }
    add("worst_stretch", end.frames.largest("max_stretch"));
  }
};

}  // namespace

namespace measure {
extern const Measure stretch{
    .name = "stretch",
    .summary = "principal stretches of the triangles, at pins and everywhere",
    .cost = "a 2 × 2 singular value decomposition per triangle and frame, in parallel with the steps",
    .applies = always,
    .columns = [] { return stretch_columns; },
    .fields = []() -> std::vector<Column> {
      return {{"max_stretch", "1", "larger principal stretch σ₁"},
              {"min_stretch", "1", "smaller principal stretch σ₂"}};
    },
    .gives =
        [] {
          std::vector<Quantity> all;
          for (const Column& column : stretch_columns) {
            all.push_back({column.name, column.unit,
                           column.meaning + "; median over the last second; with the method equilibrium, the "
                                            "value of the last step"});
            all.push_back({column.name + "_last", column.unit, "of the last frame"});
          }
          all.push_back({"worst_stretch", "1", "largest σ₁ of all frames"});
          return all;
        },
    .begin = begun<Stretches>};
}  // namespace measure
}  // namespace bendlab
