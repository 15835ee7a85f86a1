// Times whole runs, computed as by `bendlab run`: the time that recording adds, and the gain of two jobs.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "experiments/bench/bench.hpp"
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

/// The number of projections in all steps of a run, to compute a row's ns per constraint.
struct Work {
  std::int64_t vertices = 0, constraints = 0;
  double projections = 0;
};

Work work_of(const RunConfig& config) {
  const BuiltScene scene = build_scene(config.scene());
  const auto constraints = static_cast<std::int64_t>(scene.input.strain.size() + scene.input.distance.size());
  const double steps = config.scene().duration / scene.input.settings.dt;
  return {scene.rest.vertex_count(), constraints,
          static_cast<double>(constraints) * projections_per_substep(scene.input) * steps};
}

BenchRow row_of(const std::string& name, int threads, const Work& work, double runs, const Spread& seconds,
                int repetitions) {
  return {.name = name,
          .scalar = "float",
          .threads = threads,
          .vertices = work.vertices,
          .constraints = work.constraints,
          .ns = ns_per(runs * work.projections, seconds),
          .repetitions = repetitions};
}

/// Compares a run that records 30 frames a second with a run that records only the first and the last frame.
/// Wall time from the first step to the last frame in the file. The solver and the writer each have a thread.
BenchRow measure_recording(const std::string& name, int cells, double duration_s, int repetitions) {
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
  std::vector<double> ratios, writer_s;
  const Spread seconds = repeated(bench_id(name, "float", 2), repetitions, 0, [&] {
    const double without = stepping_s(run(plain));
    const RunOutcome outcome = run(recorded);
    ratios.push_back(stepping_s(outcome) / without);
    writer_s.push_back(pass_seconds(outcome, "recording"));
    return stepping_s(outcome);
  });
  BenchRow row = row_of(name, 2, work_of(recorded.runs.front()), 1, seconds, repetitions);
  const Spread ratio = spread_of(ratios);
  row.more = {{"wall_ratio", ratio.median},
              {"wall_ratio_lowest", ratio.lowest},
              {"wall_ratio_highest", ratio.highest},
              {"wall_s", seconds.median},
              {"writer_cpu_s", spread_of(writer_s).median}};
  return row;
}

/// Eight runs that differ in their seed, with one job and with two.
BenchRow measure_sweep(const std::string& name, int cells, double duration_s, int repetitions) {
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
  std::vector<double> speed_ups;
  const Spread seconds = repeated(bench_id(name, "float", 2), repetitions, 0, [&] {
    const double alone = wall_s(1), together = wall_s(2);
    speed_ups.push_back(alone / together);
    return together;
  });
  const auto runs = static_cast<double>(experiments.front().runs.size());
  BenchRow row = row_of(name, 2, work_of(experiments.front().runs.front()), runs, seconds, repetitions);
  const Spread speed_up = spread_of(speed_ups);
  row.more = {{"speed_up", speed_up.median},
              {"speed_up_lowest", speed_up.lowest},
              {"speed_up_highest", speed_up.highest},
              {"wall_s", seconds.median}};
  return row;
}

}  // namespace

std::vector<BenchCase> run_cases(const BenchOptions& options) {
  const int repetitions = options.repetitions, cells = options.quick ? 16 : 128;
  const double duration_s = options.quick ? 0.2 : 4;
  const std::string recording = fmt::format("recording/{}", cells),
                    sweep = fmt::format("sweep/{}", cells / 2);
  return {{.id = bench_id(recording, "float", 2),
           .run = [=] { return measure_recording(recording, cells, duration_s, repetitions); }},
          {.id = bench_id(sweep, "float", 2),
           .run = [=] { return measure_sweep(sweep, cells / 2, 2 * duration_s, repetitions); }}};
}

}  // namespace bendlab
