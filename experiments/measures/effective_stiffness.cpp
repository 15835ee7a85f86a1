#include "experiments/measures/effective_stiffness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bendlab/solver/simulation.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

constexpr double soft = 0.5;  // below this share a run gets a warning

// Rounds up to one digit, because the estimate is not more precise: 23 becomes 30, 1240 becomes 2000.
double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return value <= 10 ? std::ceil(value) : unit * std::ceil(value / unit);
}

}  // namespace

double substeps_for_90_percent(double share, int substeps) {
  constexpr double exponent = 1.5;  // measured: 1.2 to 2.2
  constexpr double lacking = 1 / 0.9 - 1;
  return rounded_up(substeps * std::pow(std::max(1.0, (1 / share - 1) / lacking), 1 / exponent));
}

std::map<std::string, double> effective_stiffness_summary(const EffectiveStiffness& stiffness, int substeps) {
  std::map<std::string, double> summary;
  const auto add = [&](const std::string& what, const std::optional<double>& share) {
    if (!share) return;
    summary["effective_" + what + "_stiffness"] = *share;
    constexpr double least = 3e-4;  // below this the share itself is too uncertain
    if (*share < soft)
      summary["substeps_for_90_percent_" + what] = substeps_for_90_percent(std::max(*share, least), substeps);
  };
  add("bending", stiffness.bending_share());
  add("membrane", stiffness.membrane_share());
  return summary;
}

std::string share_text(double share) {
  return share < least_known_share ? fmt::format("< {:.0f} %", 100 * least_known_share)
                                   : fmt::format("{:.2g} %", 100 * share);
}

namespace {

// The text of the warning that the cloth has only the share `share` of a stated stiffness, with a remedy.
std::string soft_text(const std::string& what, double share, double substeps) {
  if (share < least_known_share)
    return fmt::format(
        "the cloth seems to have less than {:.0f} % of the {} stiffness that the config states. The estimate "
        "of {:.2g} % is too small to be reliable, and a cloth that shakes may have more. With "
        "about {:.0f} substeps the cloth would have 90 % of the stated stiffness{}",
        100 * least_known_share, what, 100 * share, substeps,
        what == "bending" ? "; 'bendlab stiffness' measures a strip" : "");
  return fmt::format(
      "the cloth has {:.2g} % of the {} stiffness that the config states; about {:.0f} substeps would give "
      "the cloth 90 %",
      100 * share, what, substeps);
}

}  // namespace

std::optional<SoftSolver> soft_solver_warning(const std::map<std::string, double>& summary) {
  std::vector<std::string> parts;
  double least = 1;
  // The solver never reaches the stiffness of a nearly rigid membrane. This does no harm if the cloth hardly
  // stretches, so there is no warning then.
  constexpr double stretched = 0.01;
  const auto strain = summary.find("mean_strain");
  const bool taut = strain != summary.end() && !(strain->second > stretched);
  for (const std::string what : {"bending", "membrane"}) {
    if (what == "membrane" && taut) continue;
    const auto share = summary.find(fmt::format("effective_{}_stiffness", what));
    const auto substeps = summary.find(fmt::format("substeps_for_90_percent_{}", what));
    if (share == summary.end() || substeps == summary.end()) continue;
    parts.push_back(soft_text(what, share->second, substeps->second));
    least = std::min(least, share->second);
  }
  if (parts.empty()) return std::nullopt;
  return SoftSolver{fmt::format("the solver has not converged: {}", fmt::join(parts, "; ")), least};
}

namespace {

// Measures the share of the stated stiffness in the last second of a run: every half second, and at the end.
// The result is the mean share over these times, weighted by energy.
class Meter final : public Measurement {
 public:
  Meter(const RunConfig& config, const BuiltScene& scene)
      : next_look_(config.scene().duration - 1), substeps_(scene.input.settings.substeps) {}

  void step(const Simulation& simulation, const Moment& moment) override {
    constexpr double interval = 0.5;  // s; measuring takes 0.2 to 0.8 of a step of ten iterations (64² cells)
    if (moment.is_start || (!moment.is_last && simulation.time() < next_look_)) return;
    next_look_ = simulation.time() + interval;
    if (const std::optional<EffectiveStiffness> now = simulation.effective_stiffness()) sum_ += *now;
  }
  void finish(const RunEnd& end, Findings& findings) override {
    if (end.status != RunStatus::diverged)
      findings.summary.merge(effective_stiffness_summary(sum_, substeps_));
  }

  void archive(Archive& state) override { state(next_look_, sum_); }

 private:
  double next_look_;  // s
  int substeps_;
  EffectiveStiffness sum_;
};

}  // namespace

namespace measure {
extern const Measure effective_stiffness{
    .name = "effective_stiffness",
    .summary = "the share of the stated stiffness that the solver gives the cloth",
    .cost =
        "two or three measurements in the last second: below 1 % of a run of 4 s with 1 substep × 10 "
        "iterations",
    .applies = always,
    .gives = []() -> std::vector<Quantity> {
      return {{"effective_bending_stiffness", "1",
               "share of the stated bending stiffness (physical, or a compliance) that the cloth has in the "
               "last second"},
              {"effective_membrane_stiffness", "1",
               "share of the stated membrane stiffness that the cloth has in the last second"},
              {"substeps_for_90_percent_bending", "1",
               "if effective_bending_stiffness is below 0.5: about how many substeps, with as many "
               "iterations per substep, would give 0.9"},
              {"substeps_for_90_percent_membrane", "1",
               "if effective_membrane_stiffness is below 0.5: about how many substeps would give 0.9"}};
    },
    .begin = begun<Meter>};
}  // namespace measure
}  // namespace bendlab
