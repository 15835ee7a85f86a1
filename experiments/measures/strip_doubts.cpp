#include "experiments/measures/strip_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/io/run_file.hpp"
#include "bendlab/metrics/elastica.hpp"
#include "bendlab/scene/gravity.hpp"
#include "experiments/measures/strip.hpp"

namespace bendlab {
namespace {

constexpr int enough_edges = 12;  // along a strip; with H/W = 1, its two readings then agree within 3 %

bool measures_stiffness(const RunConfig& config) {
  const std::vector<std::string>& names = config.settings().output.measures;
  return std::ranges::find(names, "stiffness") != names.end();
}

std::optional<StiffnessMeter> meter_of(const RunConfig& config, const BuiltScene& scene) try {
  return StiffnessMeter(scene.rest, scene.pins.is_pinned,
                        {config.scene().material.density, gravity_of(config.scene().effects)});
} catch (const std::invalid_argument&) {  // not a strip: the measure says so
  return std::nullopt;
}

struct Law {
  BendingLaw law = BendingLaw::linear;
  double coefficient = 0;                                          // B in N m, or C in N m³
  int power() const { return law == BendingLaw::linear ? 3 : 5; }  // of the length in Γ
};

// The bending law and its stiffness, if the config states the stiffness in physical units; else nothing.
std::optional<Law> stated_law(const RunConfig& config) {
  const Bending& bending = config.scene().bending;
  if (bending.stiffness != Stiffness::physical) return std::nullopt;
  const BendingKind& model = bending.model.kind();
  const bool cubic = model.springs_only && !model.prestressed;
  if (!cubic)
    return bending.flexural_rigidity ? std::optional(Law{BendingLaw::linear, *bending.flexural_rigidity})
                                     : std::nullopt;
  if (bending.quartic_coefficient) return Law{BendingLaw::cubic, *bending.quartic_coefficient};
  if (!bending.flexural_rigidity || !bending.at_curvature) return std::nullopt;
  return Law{BendingLaw::cubic, *bending.flexural_rigidity / (*bending.at_curvature * *bending.at_curvature)};
}

// Describes a strip with H/W = 1.
std::string strip_that_would_do(const Law& law, double weight) {
  const double gamma = hanging_strip(law.law, 1).gamma,
               length = std::pow(gamma * law.coefficient / weight, 1.0 / law.power());
  return fmt::format(
      "a strip whose free part is about {:.2g} m and at least {} edges long drops by as much as it reaches "
      "out, and so shows its stiffness",
      length, enough_edges);
}

double weight_of(const RunConfig& config) {
  return config.scene().material.density * gravity_of(config.scene().effects).norm();
}

}  // namespace

std::optional<std::string> unreadable_strip(const RunConfig& config, const BuiltScene& scene) {
  if (!measures_stiffness(config)) return std::nullopt;
  const std::optional<Law> law = stated_law(config);
  const std::optional<StiffnessMeter> meter = meter_of(config, scene);
  if (!law || !meter) return std::nullopt;
  const double length = meter->length(), edge = scene.rest.mean_edge_length(), weight = weight_of(config),
               gamma = weight * std::pow(length, law->power()) / law->coefficient;
  // A soft strip hangs down from the clamp with the tension T = ρ g L. If φ is the strip's angle from the
  // vertical, T (1 - cos φ) equals B κ²/2, or 3 C κ⁴/4. The strip then reaches out by ∫ sin φ dφ / κ.
  const double reach = law->law == BendingLaw::linear ? length * std::sqrt(2 / gamma)
                                                      : length * 4 / 3 * std::pow(0.75 / gamma, 0.25);
  if (reach < edge)
    return fmt::format(
        "the strip is too soft for its mesh: with the stated stiffness, the strip of {:.3g} m turns downward "
        "within {:.2g} m of the clamp, but an edge is {:.2g} m long, so no stiffness can be read; {}",
        length, reach, edge, strip_that_would_do(*law, weight));
  // A stiff strip drops by Γ/8 of its length, and its curvature is Γ/8L halfway. The drop and the curvature
  // must be larger than their rounding errors.
  if (law->law != BendingLaw::linear || scene.precision == Precision::double_precision) return std::nullopt;
  const double rounding = scene.rest.size() * 0x1p-24, curvature = gamma / (8 * length);
  if (curvature * edge * edge < 80 * rounding)
    return fmt::format(
        "the strip is too stiff for single precision: with the stated stiffness, the strip of {:.3g} m drops "
        "by {:.2g} m and bends by {:.1g} m along an edge, but coordinates are rounded to {:.1g} m; {}",
        length, length * gamma / 8, curvature * edge * edge, rounding, strip_that_would_do(*law, weight));
  return std::nullopt;
}

std::optional<double> ratio_of_readings(const std::map<std::string, double>& summary) {
  const auto number = [&](const char* name) {
    const auto metric = summary.find(name);
    return metric == summary.end() ? std::numeric_limits<double>::quiet_NaN() : metric->second;
  };
  constexpr double near_linear = 0.3, near_cubic = 0.6;  // of the exponent
  const double exponent = number("stiffness_fit_exponent");
  double ratio = std::numeric_limits<double>::quiet_NaN();
  if (std::abs(exponent - 1) < near_linear)
    ratio = number("stiffness_flexural_rigidity") / number("stiffness_fit_B");
  else if (std::abs(exponent - 3) < near_cubic)
    ratio = number("stiffness_quartic") / number("stiffness_fit_C");
  return ratio > 0 && std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

bool readings_disagree(const std::map<std::string, double>& summary) {
  const std::optional<double> ratio = ratio_of_readings(summary);
  const bool linear = ratio && summary.at("stiffness_fit_exponent") < 2;
  return ratio && std::abs(std::log(*ratio)) > std::log(linear ? 1.03 : 1.05);
}

std::optional<std::string> doubtful_reference(const RunConfig& config,
                                              const std::filesystem::path& file) try {
  const RunStrip strip = strip_in(file, config);
  const auto readings = summary_of(strip.meter.measure(as_rows(read_positions(file, -1)), strip.options));
  if (!readings_disagree(readings)) return std::nullopt;
  return fmt::format(
      "two readings of the strip's stiffness differ by {:.0f} %: `bendlab stiffness {}` shows both readings",
      100 * std::abs(*ratio_of_readings(readings) - 1), file.parent_path().string());
} catch (const std::invalid_argument&) {  // the cloth is no strip
  return std::nullopt;
}

std::optional<std::string> doubtful_reading(const RunConfig& config, const BuiltScene& scene,
                                            const std::map<std::string, double>& summary) {
  const auto height_over_width = summary.find("stiffness_height_over_width");
  const std::optional<StiffnessMeter> meter = meter_of(config, scene);
  if (height_over_width == summary.end() || !meter) return std::nullopt;
  const std::optional<Law> stated = stated_law(config);
  const bool fitted = summary.contains("stiffness_fit_exponent");
  // The reach W follows from H/W, because H² + W² is only a little less than L².
  const double edge = scene.rest.mean_edge_length(),
               reach = meter->length() / std::hypot(1, height_over_width->second);
  if (!fitted || reach < edge) {
    const Law read = stated.value_or(Law{BendingLaw::linear, summary.contains("stiffness_flexural_rigidity")
                                                                 ? summary.at("stiffness_flexural_rigidity")
                                                                 : std::numeric_limits<double>::quiet_NaN()});
    return fmt::format(
        "the strip shows no stiffness: H/W is {:.3g}, {}; {}", height_over_width->second,
        reach < edge
            ? fmt::format("so the strip turns downward within {:.2g} m, but edges are {:.2g} m long", reach,
                          edge)
            : "and fewer than three points have a curvature that is clearly larger than its rounding error",
        read.coefficient > 0 ? strip_that_would_do(read, weight_of(config))
                             : "take a longer strip, or more cells, and let the strip come to rest");
  }
  if (!readings_disagree(summary)) return std::nullopt;
  const bool linear = summary.at("stiffness_fit_exponent") < 2;
  const std::string readings = fmt::format(
      "two readings of the strip disagree by {:.0f} %: {} from its free end, {} from its moments and "
      "curvatures: ",
      100 * std::abs(*ratio_of_readings(summary) - 1),
      linear ? fmt::format("B = {:.3g} N m", summary.at("stiffness_flexural_rigidity"))
             : fmt::format("C = {:.3g} N m³", summary.at("stiffness_quartic")),
      linear ? fmt::format("{:.3g}", summary.at("stiffness_fit_B"))
             : fmt::format("{:.3g}", summary.at("stiffness_fit_C")));
  if (meter->clamp_depth() > 0.1 * edge)
    return readings + fmt::format(
                          "the edge of the clamp zigzags by {:.2g} m, and the membrane at the clamp cannot "
                          "bend without stretching. Choose a mesh with edges along the clamp (equilateral: "
                          "/mesh/rows), or a finer mesh",
                          meter->clamp_depth());
  const bool moves = scene.input.method.kind().has_motion;
  return readings + fmt::format("{}the mesh is coarse, or the membrane is soft. Take {}twice the /mesh/cells",
                                moves ? "the strip has not come to rest, " : "",
                                moves ? "the method equilibrium, and " : "");
}

}  // namespace bendlab
