#include "experiments/cli/look_before.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "bendlab/scene/counted.hpp"
#include "experiments/cli/collected_texts.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/set_up.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

using Clock = std::chrono::steady_clock;

struct ToBuild {
  const RunConfig* config;
  double memory_bytes;
};

// One run for each scene that runs have in common. The run that needs the least memory comes first.
std::vector<ToBuild> distinct_runs(const Experiment& experiment) {
  std::vector<ToBuild> distinct;
  std::set<std::string> seen;
  for (const RunConfig& config : experiment.runs)
    if (seen.insert(text_of_set_up(config)).second) {
      const std::optional<Needs> needs = needs_of(config);
      distinct.push_back({&config, needs ? needs->memory_bytes : 0});  // 0: refused at once
    }
  std::ranges::stable_sort(distinct, {}, &ToBuild::memory_bytes);
  return distinct;
}

// Several runs that cannot be built for the same reason.
struct Refused {
  CampaignRun first;
  Failure failure;
  std::size_t more_runs = 0;
};

void add(std::vector<Refused>& refused, const CampaignRun& run, const Failure& failure) {
  for (Refused& known : refused)
    if (known.failure.message == failure.message) {
      ++known.more_runs;
      return;
    }
  refused.push_back({run, failure});
}

void print_refusals(const std::vector<Refused>& refused) {
  for (const Refused& reason : refused)
    print_text(stderr, "bendlab: {}{}: {}\n", run_text(reason.first),
               reason.more_runs == 0 ? "" : fmt::format(" and {} more", reason.more_runs),
               reason.failure.message);
}

}  // namespace

void tell_warnings(std::span<const CampaignRun> runs) {
  for (const CollectedText& warning : collected_warnings(runs))
    print_text(stderr, "bendlab: warning: {}: {}: {}\n", runs.front().experiment->name, warning.kind,
               text_of(warning));
}

KnownBefore look_before(const std::vector<Experiment>& experiments, bool all) {
  constexpr double most_s = 10, most_bytes = 5e8;  // a scene of 500 MB takes seconds to build
  const Clock::time_point begin = Clock::now();
  KnownBefore known;
  for (const Experiment& experiment : experiments) {
    const std::vector<ToBuild> distinct = distinct_runs(experiment);
    std::vector<CampaignRun> built;
    std::vector<Refused> refused;
    std::size_t tried = 0;
    for (const ToBuild& next : distinct) {
      const double passed_s = std::chrono::duration<double>(Clock::now() - begin).count();
      const bool builds = all || (passed_s < most_s && next.memory_bytes < most_bytes);
      tried += builds;
      CampaignRun run{.experiment = &experiment, .config = next.config};
      try {
        if (!builds) {
          require_memory(*next.config);
          continue;
        }
        run.outcome = RunOutcome{.warnings = set_up(experiment, *next.config)};
        built.push_back(std::move(run));
      } catch (...) {
        add(refused, run, current_failure());
      }
    }
    print_refusals(refused);
    tell_warnings(built);
    if (known.exit_code == exit_ok && !refused.empty()) known.exit_code = refused.front().failure.exit_code;
    known.warnings += collected_warnings(built).size();
    if (tried < distinct.size())
      print_text(stderr,
                 "bendlab: {}: {} of {} checked, without scenes of more than {}, and for {:.0f} s at most; "
                 "--strict checks all scenes\n",
                 experiment.name, tried, counted(distinct.size(), "different scene"), bytes_text(most_bytes),
                 most_s);
  }
  return known;
}

}  // namespace bendlab
