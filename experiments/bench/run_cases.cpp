// Times whole runs, computed as by `bendlab run`: the time that recording adds, and the gain of two jobs.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/campaign/campaign.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/run.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// A folder for runs, which the destructor removes.
class Scratch {
 public:
  Scratch() : folder(fs::temp_directory_path() / fmt::format("bendlab-bench-{}", getpid())) {}
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path folder;
};

Experiment experiment_of(int cells, double duration_s, double frames_per_second,
                         std::string_view sweep = "{}") {
  return parse_experiment(fmt::format(
                              R"({{"name": "bench", "defaults": "paper",
          "allow": ["implausible"], "duration": {}, "mesh": {{"cells": {}}},
              "bending": {{"model": "crossover"}}, "initial": {{"perturbation": 1e-6}},
              "output": {{"frames_per_second": {}}}, "sweep": {}}})",
                              duration_s, cells, frames_per_second, sweep),
                          "bench");
}

double pass_seconds(const RunOutcome& outcome, std::string_view name) {
  for (const PassTime& pass : outcome.passes)
    if (pass.name == name) return pass.seconds;
  throw std::runtime_error(fmt::format("a run has no pass '{}'", name));
}

/// Counters of `runs` runs like `run`; the work is the number of projections in all steps.
void set_run_counters(benchmark::State& state, const RunConfig& run, std::size_t runs) {
  const BuiltScene scene = build_scene(run.scene());
  const std::size_t constraints = scene.input.strain.size() + scene.input.distance.size();
  const double steps = run.scene().duration / scene.input.settings.dt;
  set_counters(state, scene.rest.vertex_count(), static_cast<std::int64_t>(constraints),
               static_cast<double>(runs * constraints) * projections_per_substep(scene.input) * steps);
}

/// Compares a run that records 30 frames a second with a run that records only the first and the last frame.
/// Wall time from the first step to the last frame in the file. The solver and the writer each have a thread.
void measure_recording(benchmark::State& state, int cells, double duration_s) {
  const Experiment recorded = experiment_of(cells, duration_s, 30),
                   plain = experiment_of(cells, duration_s, 1 / duration_s);
  const Scratch scratch;
  const auto run = [&](const Experiment& experiment) {
    fs::remove_all(scratch.folder);
    const RunOutcome outcome = execute_run(experiment, experiment.runs.front(), scratch.folder);
    if (!is_whole(outcome.status)) throw std::runtime_error("a benchmark's run failed: " + outcome.message);
    return outcome;
  };
  const auto stepping_s = [](const RunOutcome& outcome) {
    return outcome.wall_s - pass_seconds(outcome, "set_up");
  };
  for ([[maybe_unused]] const auto _ : state) {
    const double without = stepping_s(run(plain));
    const RunOutcome outcome = run(recorded);
    state.SetIterationTime(stepping_s(outcome));
    state.counters["wall_ratio"] = stepping_s(outcome) / without;
    state.counters["writer_cpu_s"] = pass_seconds(outcome, "recording");
  }
  set_run_counters(state, recorded.runs.front(), 1);
}

/// Eight runs that differ in their seed, with one job and with two.
void measure_sweep(benchmark::State& state, int cells, double duration_s) {
  const std::vector<Experiment> experiments = {
      experiment_of(cells, duration_s, 1, R"({"/initial/seed": [1, 2, 3, 4, 5, 6, 7, 8]})")};
  const Scratch scratch;
  const auto wall_s = [&](int jobs) {
    fs::remove_all(scratch.folder);
    std::vector<CampaignRun> runs = plan_campaign(experiments);
    const auto start = std::chrono::steady_clock::now();
    run_campaign(runs, {.out = scratch.folder, .jobs = jobs}, [](std::size_t) {});
    if (campaign_exit_code(runs) != 0) throw std::runtime_error("a run of a benchmark's sweep failed");
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for ([[maybe_unused]] const auto _ : state) {
    const double alone = wall_s(1), together = wall_s(2);
    state.SetIterationTime(together);
    state.counters["speed_up"] = alone / together;
  }
  const std::vector<RunConfig>& runs = experiments.front().runs;
  set_run_counters(state, runs.front(), runs.size());
}

}  // namespace

void register_run_cases(const BenchOptions& options) {
  const int cells = options.quick ? 16 : 128;
  const double duration_s = options.quick ? 0.2 : 4;
  add_benchmark(bench_id(fmt::format("recording/{}", cells), "float", 2),
                [=](benchmark::State& state) { measure_recording(state, cells, duration_s); })
      ->UseManualTime()
      ->Iterations(1);
  add_benchmark(bench_id(fmt::format("sweep/{}", cells / 2), "float", 2),
                [=](benchmark::State& state) { measure_sweep(state, cells / 2, 2 * duration_s); })
      ->UseManualTime()
      ->Iterations(1);
}

}  // namespace bendlab
