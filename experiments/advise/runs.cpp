#include "experiments/advise/runs.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "bendlab/metrics/shape_error.hpp"
#include "experiments/config/references.hpp"
#include "experiments/measures/trajectory.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

constexpr double frames_per_second = 60;  // costs are per frame of 1/60 s

// CPU seconds of the steps, per frame. A run that is too short to be timed is simulated again, without
// recording, until the repeats took long enough or `stop` is set.
double cpu_per_frame(const RunConfig& config, const RunOutcome& outcome, const std::atomic<bool>& stop) {
  constexpr double least = 1e-9, rounding = 1e-9, long_enough = 0.05;  // s
  constexpr int most_repeats = 20;
  const double simulated = read_metric(outcome.file, "time").back();
  if (!(simulated > 0)) return least;
  double seconds = 0;
  int repeats = 0;
  while (outcome.step_cpu_s < long_enough && is_whole(outcome.status) && seconds < long_enough &&
         repeats < most_repeats && !stop) {
    const BuiltScene scene = build_scene(config.scene());
    const std::unique_ptr<Simulation> simulation = simulation_of(scene);
    const double before = thread_cpu_s();
    while (simulation->time() < simulated - rounding && simulation->step()) {
    }
    seconds += thread_cpu_s() - before + simulation->helper_seconds();
    ++repeats;
  }
  return std::max(least,
                  (repeats > 0 ? seconds / repeats : outcome.step_cpu_s) / simulated / frames_per_second);
}

// A value that is not finite counts as infinite.
double or_endless(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

// Reads the speed at the end of a run, and the strain and stretch at the end. With `over_time`, reads the
// mean strain and the largest stretch of all frames instead.
void read_state(const std::filesystem::path& file, const RunConfig& config, bool over_time, Trial& trial) {
  const Trajectory run = over_time ? read_motion(file) : read_last_pose(file);
  double strain = 0, mass = 0;
  for (const Positions& pose : run.poses) strain += strain_error(run.rest, pose);
  for (const double area : run.rest.areas()) mass += config.scene().material.density * area;
  const std::vector<double> stretches = read_metric(file, "max_stretch");
  trial.strain = trial.more_strain = or_endless(strain / static_cast<double>(run.poses.size()));
  trial.stretch = std::max(1.0, or_endless(over_time ? std::ranges::max(stretches) : stretches.back()));
  trial.speed = std::sqrt(2 * read_metric(file, "kinetic_energy").back() / mass) / run.rest.size();
}

Trial trial_of(const Setting& setting, const CampaignRun& run, const std::atomic<bool>& stop) {
  Trial trial{.setting = setting};
  trial.unfinished = !run.started() || (run.outcome && run.outcome->status == RunStatus::interrupted);
  trial.failed = !trial.unfinished && !run.outcome;
  trial.why = run.outcome ? run.outcome->message : run.error;
  std::ranges::replace(trial.why, '\n', ' ');
  if (trial.unfinished || trial.failed) return trial;
  const RunOutcome& outcome = *run.outcome;
  trial.cpu_s = cpu_per_frame(*run.config, outcome, stop);
  trial.implausible = outcome.status == RunStatus::implausible;
  trial.warnings = outcome.warnings;
  trial.diverged = outcome.status == RunStatus::diverged;
  if (trial.diverged) {
    trial.why = "diverged";
    return trial;
  }
  read_state(outcome.file, *run.config, run.config->settings().accuracy.over_time, trial);
  const auto error = outcome.summary.find("error_physical_rms");
  if (error != outcome.summary.end() && !outcome.summary.contains("error_physical_unbalanced"))
    trial.error = or_endless(error->second);
  return trial;
}

}  // namespace

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Runs::Runs(const Question& question, CampaignOptions campaign, double time_limit_s,
           std::function<double()> now_s)
    : question_(question),
      campaign_(std::move(campaign)),
      now_s_(std::move(now_s)),
      end_s_(now_s_() + time_limit_s) {
  campaign_.out /= "advise", campaign_.short_first = true;
}

std::vector<Trial> Runs::execute(const std::vector<Setting>& settings, const Json& accuracy, double seconds,
                                 double times) {
  std::vector<Experiment> experiments;
  for (const Setting& setting : settings)
    experiments.push_back(question_.experiment_with(setting, accuracy, times));
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  std::vector<Trial> trials(runs.size());
  const double end_s = std::min(end_s_, now_s_() + seconds);
  std::atomic<bool> stop{now_s_() >= end_s};
  const std::jthread watch([&](const std::stop_token& done) {
    while (!done.stop_requested() && !stop) {
      stop = stop_flag() || now_s_() >= end_s;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  campaign_.stop = &stop;
  run_campaign(runs, campaign_, [&](std::size_t i) {
    trials[i] = trial_of(settings[i], runs[i], stop);
    if (runs[i].exit_code == exit_io || runs[i].exit_code == exit_mesh) exit_code_ = runs[i].exit_code;
    if (trials[i].unfinished || trials[i].failed) return;
    computed_ += !runs[i].outcome->reused;
    if (is_whole(runs[i].outcome->status)) times_.add(*runs[i].config, runs[i].outcome->cpu_s);
    const auto& summary = runs[i].outcome->summary;
    if (const auto gap = summary.find("error_physical_reference_gap"); gap != summary.end())
      gap_ = gap->second;
  });
  if (stop_exit_code() != 0) exit_code_ = stop_exit_code();
  if (exit_code_ != 0)
    for (Trial& trial : trials) trial.unfinished = true;
  return trials;
}

bool Runs::in_time(const Setting& setting, const Json& accuracy, double times) const {
  const Experiment experiment = question_.experiment_with(setting, accuracy, times);
  const RunConfig& config = experiment.runs.front();
  const std::optional<RunTimes::Expected> time = times_.expected(config);
  return !time || time->cpu_s < left_s() ||
         std::filesystem::exists(run_folder(campaign_.out, experiment, config) / "run.vtkhdf");
}

Trial Runs::reference_of(const Setting& setting, const Json& accuracy) const {
  Trial trial{.setting = setting};
  const RunConfig config = question_.experiment_with(setting, accuracy).runs.front();
  std::optional<RunConfig> reference = bendlab::reference_of(config, Against::physical);
  if (!reference) return trial;
  const Accuracy& compared = config.settings().accuracy;
  if (compared.start_from_end) reference->starts_at_end_of = run_id(config);
  Experiment of_references;
  of_references.name = "references";
  const std::filesystem::path file =
      run_folder(campaign_.out / question_.name(), of_references, *reference) / "run.vtkhdf";
  if (!std::filesystem::exists(file)) return trial;
  read_state(file, *reference, compared.over_time, trial);
  trial.cpu_s = read_run(file).cpu_s;
  return trial;
}

}  // namespace bendlab
