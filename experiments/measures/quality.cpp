#include "bendlab/mesh/quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

struct Statistic {
  const char* name;
  double MeasureSummary::*value;
};
constexpr Statistic statistics[] = {{"minimum", &MeasureSummary::minimum},
                                    {"percentile_1", &MeasureSummary::percentile_1},
                                    {"median", &MeasureSummary::median},
                                    {"percentile_99", &MeasureSummary::percentile_99},
                                    {"maximum", &MeasureSummary::maximum}};

const std::vector<Column> counts = {
    {"degenerate_triangles", "1", "needles, caps, collinear and non-finite triangles"},
    {"needles", "1", "triangles whose longest edge is at least needle_ratio times the shortest"},
    {"caps", "1", "triangles with an angle of at least cap_angle"},
    {"collinear", "1", "triangles with three points exactly on a line"},
    {"small_angles", "1", "triangles with an angle below small_angle"}};

// Calls visit(quality measure, its index, statistic, name) for every statistic of every quality measure.
template <class Visit>
void for_quality_columns(Visit visit) {
  for (std::size_t m = 0; m < quality_measures().size(); ++m)
    for (const Statistic& statistic : statistics)
      visit(quality_measures()[m], m, statistic,
            fmt::format("{}_{}", quality_measures()[m].name, statistic.name));
}

std::vector<Column> columns() {
  std::vector<Column> all = counts;
  for_quality_columns(
      [&](const QualityMeasure& kind, std::size_t, const Statistic& statistic, const std::string& name) {
        all.push_back({name, std::string(kind.unit),
                       fmt::format("{} over triangles: {}", statistic.name, kind.meaning)});
      });
  return all;
}

class Quality final : public Measurement {
 public:
  Quality(const RunConfig& config, const BuiltScene& scene)
      : scene_(scene), thresholds_(config.settings().quality) {}

  void complete(const MeasuredFrame& frame, std::span<double> values,
                std::span<std::vector<float>>) override {
    const MeshQuality quality = measure_quality(frame.positions(), scene_.rest.triangles(), thresholds_);
    std::size_t next = 0;
    for (const int count : {quality.degenerate_triangles, quality.needles, quality.caps, quality.collinear,
                            quality.small_angles})
      values[next++] = count;
    for_quality_columns([&](const auto&, std::size_t m, const Statistic& statistic, const std::string&) {
      values[next++] = quality.measures[m].*statistic.value;
    });
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.frames.empty()) return;
    findings.summary["degenerate_triangles"] = end.frames.last("degenerate_triangles");
    findings.summary["degenerate_triangles_median"] = end.frames.last_second_median("degenerate_triangles");
    findings.summary["degenerate_triangles_worst"] = end.frames.largest("degenerate_triangles");
    const MeshQuality rest = measure_quality(scene_.rest.positions(), scene_.rest.triangles(), thresholds_);
    findings.summary["rest_degenerate_triangles"] = rest.degenerate_triangles;
    std::set<std::string> infinite;
    for_quality_columns(
        [&](const QualityMeasure& kind, std::size_t m, const Statistic& statistic, const std::string& name) {
          if (const double value = rest.measures[m].*statistic.value; std::isfinite(value))
            findings.summary["rest_" + name] = value;
          else
            infinite.insert(fmt::format("rest_{}", kind.name));
        });
    if (!infinite.empty())
      findings.messages.push_back(
          fmt::format("{}: infinite for triangles without area; the summary leaves out infinite metrics",
                      fmt::join(infinite, ", ")));
  }

 private:
  const BuiltScene& scene_;
  QualityThresholds thresholds_;
};

}  // namespace

namespace measure {
extern const Measure quality{
    .name = "quality",
    .summary = "mesh quality and degenerate triangles",
    .cost = "about half of the time that a frame takes, in parallel with the steps",
    .applies = always,
    .columns = columns,
    .gives =
        [] {
          std::vector<Quantity> all = {
              {"degenerate_triangles", "1", "of the last frame: " + counts[0].meaning},
              {"degenerate_triangles_median", "1",
               "median over the last second; with the method equilibrium, the value of the last step"},
              {"degenerate_triangles_worst", "1", "largest of all frames"},
              {"rest_degenerate_triangles", "1", "of the rest shape"}};
          for_quality_columns([&](const QualityMeasure& kind, std::size_t, const Statistic& statistic,
                                  const std::string& name) {
            all.push_back(
                {"rest_" + name, std::string(kind.unit),
                 fmt::format("of the rest shape, {} over triangles: {}", statistic.name, kind.meaning)});
          });
          return all;
        },
    .begin = begun<Quality>};
}  // namespace measure
}  // namespace bendlab
