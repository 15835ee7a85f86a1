#include "experiments/measures/strip.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/single_precision.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/settings/median.hpp"

namespace bendlab {
namespace {

// How far the constraints that join free vertices to the clamp extend along the strip; see StripSettings.
class Reach {
 public:
  Reach(const Pins& pins, std::span<const double> along)
      : pins_(pins), along_(along), of_vertex_(along.size(), 0) {}

  template <class Constraints>
  void add(const Constraints& constraints) {
    for (const auto& vertices : constraints.vertices) add_constraint(vertices);
  }
  void add(const OwnElements& own) {
    for (std::size_t c = 0; c < own.size(); ++c) add_constraint(own.corners(c));
  }

  double median() {
    std::erase(of_vertex_, 0);
    return of_vertex_.empty() ? 0 : upper_median(of_vertex_);
  }

 private:
  void add_constraint(const auto& points) {
    std::vector<int> vertices;  // without directors
    for (const int p : points)
      if (static_cast<std::size_t>(p) < along_.size()) vertices.push_back(p);
    const auto pinned = [&](int v) { return pins_.pinned(v); };
    if (std::ranges::none_of(vertices, pinned)) return;
    const auto s = [&](int v) { return along_[static_cast<std::size_t>(v)]; };
    const auto [low, high] = std::ranges::minmax(vertices, {}, s);
    for (const int v : vertices)
      if (double& longest = of_vertex_[static_cast<std::size_t>(v)]; !pinned(v))
        longest = std::max(longest, s(high) - s(low));
  }

  const Pins& pins_;
  std::span<const double> along_;
  std::vector<double> of_vertex_;  // m
};

double reach_of(const RunConfig& config, const RestMesh& rest, const Pins& pins,
                std::span<const double> along) {
  const BendingConstraints bending = constraints_of(config.scene().bending.model, {rest, pins});
  Reach reach(pins, along);
  reach.add(bending.distance);
  for_each_kind(bending.elements, [&](const auto& list) { reach.add(list); });
  reach.add(bending.own);
  return reach.median();
}

}  // namespace

RunStrip strip_of(const RunConfig& config, const RestMesh& rest, const Pins& pins,
                  const StripSettings& settings) {
  const StripLoad load{config.scene().material.density, gravity_of(config.scene().effects)};
  RunStrip strip{StiffnessMeter(rest, pins.is_pinned, load), {}};
  const double reach = reach_of(config, rest, pins, strip.meter.along());
  // The solver's positions are relative to the middle of the strip, so only the size matters for rounding.
  // Stored positions are absolute, so in single precision the largest coordinate matters, too.
  const bool stored_in_double = needs_double(rest.positions(), rest.triangles());
  const double largest =
      stored_in_double ? rest.size() : std::max(rest.size(), rest.positions().cwiseAbs().maxCoeff());
  const bool wide = config.scene().solver.precision == ChosenPrecision::double_precision;
  const bool calibrated = config.scene().bending.stiffness == Stiffness::physical;
  strip.options = {.clamp_offset = settings.clamp_offset.value_or(calibrated ? 0 : reach / 4),
                   .exclude = settings.exclude.value_or(reach),
                   .rounding = largest * (wide ? 0x1p-53 : 0x1p-24)};
  return strip;
}

RunStrip strip_in(const std::filesystem::path& file, const RunConfig& config, const StripSettings& settings) {
  const RestRecord stored = read_rest(file);
  const RestMesh rest({as_rows(stored.positions), as_rows(stored.triangles), {}});
  Pins pins{.seeds = stored.pin_seeds, .all = {}, .is_pinned = {stored.pinned.begin(), stored.pinned.end()}};
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (pins.pinned(v)) pins.all.push_back(v);
  return strip_of(config, rest, pins, settings);
}

std::map<std::string, double> summary_of(const StripStiffness& stiffness) {
  std::map<std::string, double> metrics = {{"stiffness_height_over_width", stiffness.height_over_width},
                                           {"stiffness_gamma", stiffness.gamma},
                                           {"stiffness_flexural_rigidity", stiffness.flexural_rigidity},
                                           {"stiffness_bending_length", stiffness.bending_length},
                                           {"stiffness_quartic", stiffness.quartic},
                                           {"stiffness_fit_exponent", stiffness.fit.exponent},
                                           {"stiffness_fit_B", stiffness.fit.rigidity},
                                           {"stiffness_fit_C", stiffness.fit.quartic}};
  std::erase_if(metrics, [](const auto& metric) { return !std::isfinite(metric.second); });
  return metrics;
}

}  // namespace bendlab
