// Times the set-up for `adaptive`, from a rest mesh to the first step: rings and pairs, colours and batches.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/bench/bench.hpp"
#include "experiments/bench/cases.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/machine.hpp"

namespace bendlab {
namespace {

RunConfig config_of(int cells, const char* model) {
  return parse_experiment(fmt::format(R"({{"name": "bench", "defaults": "paper",
          "mesh": {{"cells": {}}}, "bending": {{"model": "{}"}}}})",
                                      cells, model),
                          "bench")
      .runs.front();
}

/// The kilobytes of an entry of /proc/self/status; 0 if there is no such entry.
double status_kilobytes(std::string_view key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::stod(line.substr(key.size() + 1));
  return 0;
}

/// A scene that has no springs yet. One corner and its 1-ring are pinned.
class SetUp {
 public:
  explicit SetUp(int cells)
      : scene_(build_scene(config_of(cells, "none").scene())),
        model_(config_of(cells, "adaptive").scene().bending.model),
        peak_bytes_(measured_peak_bytes()) {}

  struct Times {
    double springs = 0, order = 0;  // s
  };

  Times run() {
    const double start = thread_cpu_s();
    scene_.input.distance = constraints_of(model_, {scene_.rest, scene_.pins}).distance;
    const double built = thread_cpu_s();
    const auto simulation = make_simulation<float>(scene_.input, {});
    const Times times{built - start, thread_cpu_s() - built};
    springs_ = static_cast<std::int64_t>(scene_.input.distance.size());
    scene_.input.distance = {};
    return times;
  }

  int vertices() const { return scene_.rest.vertex_count(); }
  std::int64_t springs() const { return springs_; }
  double peak_bytes() const { return peak_bytes_; }  ///< growth of the peak resident memory

 private:
  // A child process measures the growth, because the parent's freed memory or earlier peak would hide a part
  // of the growth.
  double measured_peak_bytes() {
    std::array<int, 2> channel{};
    if (pipe(channel.data()) != 0) throw std::runtime_error("cannot make a pipe for measuring memory");
    malloc_trim(0);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a process for measuring memory");
    if (child == 0) {
      mallopt(M_MMAP_THRESHOLD, 128 << 10);  // the initial value; it rises with freed blocks
      const double before = status_kilobytes("VmRSS:");
      run();
      const double growth = 1024 * (status_kilobytes("VmHWM:") - before);
      _exit(write(channel[1], &growth, sizeof(growth)) == sizeof(growth) ? 0 : 1);
    }
    double growth = 0;
    close(channel[1]);
    const bool complete = read(channel[0], &growth, sizeof(growth)) == sizeof(growth);
    close(channel[0]);
    waitpid(child, nullptr, 0);
    if (!complete) throw std::runtime_error("the set-up failed in the process that measures its memory");
    return growth;
  }

  BuiltScene scene_;
  BendingModel model_;
  std::int64_t springs_ = 0;
  double peak_bytes_;
};

void measure(benchmark::State& state, const std::string& name, int cells) {
  SetUp& set_up = staged(name, [&] { return std::make_shared<SetUp>(cells); });
  SetUp::Times times;
  for ([[maybe_unused]] const auto _ : state) {
    times = set_up.run();
    state.SetIterationTime(times.springs + times.order);
  }
  const auto springs = static_cast<double>(set_up.springs());
  set_counters(state, set_up.vertices(), set_up.springs(), springs);
  state.counters["rings_and_pairs_s"] = times.springs;
  state.counters["colours_and_batches_s"] = times.order;
  state.counters["peak_bytes_per_spring"] = set_up.peak_bytes() / springs;
}

}  // namespace

void register_set_up_cases(const BenchOptions& options) {
  for (const int cells : options.quick ? std::vector{32} : std::vector{64, 128, 256}) {
    const std::string name = fmt::format("set_up/{}", cells);
    add_benchmark(bench_id(name, "float"), [=](benchmark::State& state) { measure(state, name, cells); })
        ->UseManualTime()
        ->Iterations(1);
  }
}

}  // namespace bendlab
