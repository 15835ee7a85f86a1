#include "experiments/advise/runs.hpp"

#include <algorithm>
#include <thread>

#include "experiments/config/references.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/forecast.hpp"
#include "experiments/run/run_id.hpp"

namespace bendlab {

Runs::Runs(const Question& question, CampaignOptions campaign, double time_limit_s)
    : question_(question), campaign_(std::move(campaign)), limit_(time_limit_s) {
  campaign_.out /= "advise";
  campaign_.stop = &limit_.over();
  const auto threads = static_cast<unsigned>(question.scene().scene().solver.threads);
  jobs_ = campaign_.jobs > 0 ? campaign_.jobs
                             : std::max(1, static_cast<int>(std::thread::hardware_concurrency() / threads));
}

std::vector<Measured> Runs::execute(std::vector<RunConfig> configs) {
  Experiment experiment;
  experiment.name = question_.name();
  experiment.allow = {"implausible"};  // the answer says which settings are
  experiment.runs = std::move(configs);
  for (const RunConfig& config : experiment.runs)
    for (const auto& [pointer, value] : config.point)
      if (std::ranges::find(experiment.axes, pointer, &Axis::first) == experiment.axes.end())
        experiment.axes.push_back({pointer, {}});
  std::vector<CampaignRun> runs;
  for (const RunConfig& config : experiment.runs)
    runs.push_back({.experiment = &experiment, .config = &config});
  run_campaign(runs, campaign_, [](std::size_t) {});
  exit_code_ = stop_exit_code();
  for (const CampaignRun& run : runs)
    if (run.exit_code == exit_io || run.exit_code == exit_mesh) exit_code_ = run.exit_code;
  std::vector<Measured> measured;
  if (exit_code_ != 0) return measured;
  for (const CampaignRun& run : runs) {
    measured.push_back(measured_by(run));
    if (run.outcome && !run.outcome->reused && !measured.back().unfinished) ++computed_;
    if (measured.back().gap) gap_ = measured.back().gap;
  }
  return measured;
}

Measured Runs::execute_one(RunConfig config) {
  const std::vector<Measured> found = execute({std::move(config)});
  return found.empty() ? Measured{.unfinished = true} : found.front();
}

std::optional<double> Runs::forecast_per_frame(const Setting& setting) const {
  const RunConfig config = question_.run_with(setting, Json::object());
  const std::optional<Forecast> expected = forecast(config);
  if (!expected) return std::nullopt;
  return (expected->cpu_s - expected->set_up_s) / config.scene().duration / frames_per_second;
}

bool Runs::in_time(const RunConfig& config) const {
  Experiment experiment;
  experiment.name = question_.name();
  return expected_cpu_s(config) < limit_.left_s() ||
         std::filesystem::exists(run_folder(campaign_.out, experiment, config) / "run.vtkhdf");
}

std::filesystem::path Runs::reference_file(const RunConfig& config) const {
  std::optional<RunConfig> reference = reference_of(config, Against::physical);
  if (!reference) return {};
  if (config.settings().accuracy.start_from_end) reference->starts_at_end_of = run_id(config);
  Experiment experiment;
  experiment.name = "references";
  return run_folder(campaign_.out / question_.name(), experiment, *reference) / "run.vtkhdf";
}

}  // namespace bendlab
