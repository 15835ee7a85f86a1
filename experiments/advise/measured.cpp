#include "experiments/advise/measured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bendlab/io/run_file.hpp"
#include "bendlab/metrics/shape_error.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/measures/trajectory.hpp"
#include "experiments/run/machine.hpp"

namespace bendlab {
namespace {

constexpr double long_enough = 0.05;  // s, to stand out from noise

// What is not finite counts as stretched without bound.
double or_endless(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

// CPU seconds of the steps of a run, simulated again without recording until that took long enough.
double steps_again(const RunConfig& config, double simulated) {
  constexpr double rounding = 1e-9;  // s
  constexpr int most = 20;
  double seconds = 0;
  int repeats = 0;
  for (; seconds < long_enough && repeats < most; ++repeats) {
    const BuiltScene scene = build_scene(config.scene());
    const std::unique_ptr<Simulation> simulation = simulation_of(scene);
    const double before = thread_cpu_s();
    while (simulation->time() < simulated - rounding && simulation->step()) {
    }
    seconds += thread_cpu_s() - before + simulation->helper_seconds();
  }
  return seconds / repeats;
}

// A pass's own seconds are wall time, which other programs stretch.
double cpu_per_frame(const RunConfig& config, const RunOutcome& outcome) {
  constexpr double least = 1e-9;  // s
  const double simulated = read_metric(outcome.file, "time").back();
  if (!(simulated > 0)) return least;
  const bool repeat = outcome.step_cpu_s < long_enough && is_whole(outcome.status);
  const double seconds = repeat ? steps_again(config, simulated) : outcome.step_cpu_s;
  return std::max(least, seconds / simulated / frames_per_second);
}

std::optional<double> number_in(const RunOutcome& outcome, const std::string& name) {
  const auto found = outcome.summary.find("error_physical_" + name);
  return found == outcome.summary.end() ? std::nullopt : std::optional(found->second);
}

std::string on_a_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  const auto both_spaces = [](char a, char b) { return a == ' ' && b == ' '; };
  text.erase(std::unique(text.begin(), text.end(), both_spaces), text.end());
  return text;
}

}  // namespace

double strain_in(const std::filesystem::path& file, bool over_time) {
  const Trajectory end = read_last_pose(file);
  if (!over_time) return or_endless(strain_error(end.rest, end.poses.back()));
  const std::size_t frames = read_metric(file, "time").size();
  double sum = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const std::vector<double> numbers = read_positions(file, static_cast<std::int64_t>(f));
    const Positions pose = as_rows(numbers);
    sum += strain_error(end.rest, pose);
  }
  return or_endless(sum / static_cast<double>(frames));
}

double stretch_in(const std::filesystem::path& file, bool over_time) {
  const std::vector<double> stretches = read_metric(file, "max_stretch");
  const double largest = over_time ? *std::ranges::max_element(stretches) : stretches.back();
  return std::max(1.0, or_endless(largest));
}

Measured measured_by(const CampaignRun& run) {
  if (!run.started() || (run.outcome && run.outcome->status == RunStatus::interrupted))
    return {.unfinished = true};
  if (!run.outcome) return {.why = on_a_line(run.error), .failed = true};
  const RunOutcome& outcome = *run.outcome;
  Measured measured{.error = number_in(outcome, "rms"),
                    .gap = number_in(outcome, "reference_gap"),
                    .strain = number_in(outcome, "strain"),
                    .cpu_s = cpu_per_frame(*run.config, outcome),
                    .why = outcome.message,
                    .kinetic_energy = read_metric(outcome.file, "kinetic_energy").back(),
                    .implausible = outcome.status == RunStatus::implausible,
                    .warnings = outcome.warnings};
  if (number_in(outcome, "unbalanced") || (measured.error && !std::isfinite(*measured.error)))
    measured.error.reset();
  measured.diverged = outcome.status == RunStatus::diverged;
  if (measured.diverged) {
    measured.why = "diverged";
    return measured;
  }
  const bool over_time = run.config->settings().accuracy.over_time;
  measured.strain = measured.strain ? or_endless(*measured.strain) : strain_in(outcome.file, over_time);
  measured.stretch = stretch_in(outcome.file, over_time);
  return measured;
}

}  // namespace bendlab
