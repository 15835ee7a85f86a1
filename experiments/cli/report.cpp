#include "experiments/cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bendlab/scene/counted.hpp"
#include "experiments/cli/collected_texts.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

std::vector<ExpectationResult> check(const CampaignRun& run) {
  if (!run.outcome) return {};
  std::vector<ExpectationResult> results =
      check_expectations(run.experiment->expectations, *run.config, run.outcome->summary);
  // The metrics of a diverged run describe only the frames before, so they meet no expectation.
  if (run.outcome->status == RunStatus::diverged)
    for (ExpectationResult& result : results)
      result.holds = false, result.message = "diverged; in the frames before, " + result.message;
  return results;
}

/// The run's message, which may say why the run does not have the metric; "" if it has the metric.
std::string why_missing(const CampaignRun& run, const ExpectationResult& result) {
  return result.measured || run.outcome->message.empty() ? ""
                                                         : "; message of the run: " + run.outcome->message;
}

/// A line per run and expectation that does not hold in this run.
std::string failed_expectations(std::span<const CampaignRun> runs) {
  std::string text;
  for (const CampaignRun& run : runs)
    for (const ExpectationResult& result : check(run))
      if (!result.holds)
        text += fmt::format("{} {}: {}{}\n", coloured("FAIL", Colour::red, stdout), place_text(run),
                            result.message, why_missing(run, result));
  return text;
}

/// A line per expectation that holds, with the first run on which the expectation was checked.
std::string held_expectations(std::span<const CampaignRun> runs) {
  struct Held {
    std::string key, first;
    int runs = 0;
  };
  std::vector<Held> all;
  for (const CampaignRun& run : runs) {
    for (const ExpectationResult& result : check(run)) {
      if (!result.holds) continue;
      const Expectation& e = result.expectation;
      const std::string key = fmt::format("{} {} {} {} {}", e.metric, e.minimum.value_or(NAN),
                                          e.maximum.value_or(NAN), e.why, e.where.dump());
      auto held = std::ranges::find(all, key, &Held::key);
      if (held == all.end())
        held = all.insert(held, {key, fmt::format("{}: {}", place_text(run), result.message), 0});
      ++held->runs;
    }
  }
  std::string text;
  for (const Held& held : all)
    text += fmt::format("{} {}{}\n", coloured("ok  ", Colour::green, stdout), held.first,
                        held.runs == 1 ? "" : fmt::format(" (and in {} more)", held.runs - 1));
  return text;
}

/// A line per broken bound, and per warning code.
std::string verdicts_and_warnings(std::span<const CampaignRun> runs) {
  std::string text;
  for (const CollectedText& broken : collected_bounds(runs))
    text += fmt::format("{} {}\n", coloured("implausible", Colour::red, stdout), text_of(broken));
  for (const CollectedText& warning : collected_warnings(runs))
    text += fmt::format("{} {}: {}\n", coloured("warning", Colour::yellow, stdout), warning.kind,
                        text_of(warning));
  return text;
}

/// "strain 61 %, bending 24 %, …" of passes with at least 1 % of the time; empty if no pass has so much.
std::string pass_shares(const std::vector<PassTime>& passes) {
  double all = 0;
  for (const PassTime& pass : passes) all += pass.seconds;
  std::vector<PassTime> sorted = passes;
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &PassTime::seconds);
  std::string text;
  for (const PassTime& pass : sorted) {
    if (!(pass.seconds >= 0.01 * all) || all == 0) continue;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", pass.name, 100 * pass.seconds / all);
  }
  return text;
}

/// Wall and CPU time of the runs, and the shares of the passes. Reused runs count with the time that they
/// took when they were computed.
std::string time_text(std::span<const CampaignRun> runs) {
  double wall_s = 0, cpu_s = 0;
  std::vector<PassTime> passes;
  for (const CampaignRun& run : runs) {
    if (!run.outcome) continue;
    wall_s += run.outcome->wall_s;
    cpu_s += run.outcome->cpu_s;
    for (const PassTime& pass : run.outcome->passes) {
      const auto same = std::ranges::find(passes, pass.name, &PassTime::name);
      if (same == passes.end())
        passes.push_back(pass);
      else
        same->seconds += pass.seconds;
    }
  }
  std::string text = fmt::format("time: {:.1f} s in the runs, {:.1f} s of CPU", wall_s, cpu_s);
  const std::string shares = pass_shares(passes);
  return shares.empty() ? text : text + "; " + shares;
}

}  // namespace

bool expectations_hold(std::span<const CampaignRun> runs) {
  return std::ranges::all_of(
      runs, [](const auto& run) { return std::ranges::all_of(check(run), &ExpectationResult::holds); });
}

Json run_json(const CampaignRun& run) {
  Json expectations = Json::array();
  Json passes = Json::array();
  if (run.outcome)
    for (const PassTime& pass : run.outcome->passes)
      passes.push_back(
          {{"name", pass.name}, {"seconds", pass.seconds}, {"calls", pass.calls}, {"acted", pass.acted}});
  for (const ExpectationResult& result : check(run))
    expectations.push_back(
        {{"metric", result.expectation.metric}, {"holds", result.holds}, {"message", result.message}});
  const RunOutcome outcome = run.outcome.value_or(RunOutcome{});
  std::string id = outcome.id;
  if (id.empty()) {
    try {
      id = run_id(*run.config);
    } catch (const std::exception&) {  // the id needs a file that can't be read: see `message`
    }
  }
  return {{"id", id},
          {"experiment", run.experiment->name},
          {"point", point_json(*run.config)},
          {"status", run.outcome ? to_string(outcome.status) : "failed"},
          {"reused", outcome.reused},
          {"file", outcome.file.string()},
          {"config", run.config->resolved()},
          {"wall_s", outcome.wall_s},
          {"cpu_s", outcome.cpu_s},
          {"step_cpu_s", outcome.step_cpu_s},
          {"summary", outcome.summary},
          {"passes", passes},
          {"expectations", expectations},
          {"implausible", outcome.broken ? to_json(*outcome.broken) : Json(nullptr)},
          {"warnings", to_json(outcome.warnings)},
          {"message", run.outcome ? outcome.message : run.error}};
}

std::string experiment_text(std::span<const CampaignRun> runs) {
  const Experiment& experiment = *runs.front().experiment;
  std::string text = experiment.name;
  if (!experiment.description.empty()) text += ": " + experiment.description;
  text += "\n\n" + run_table(runs) + "\n" + measure_tables(runs) + time_text(runs) + "\n";
  return text + held_expectations(runs) + failed_expectations(runs) + verdicts_and_warnings(runs);
}

std::string experiment_line(std::span<const CampaignRun> runs) {
  const auto count = [&](auto&& predicate) { return std::ranges::count_if(runs, predicate); };
  const auto complete =
      count([](const CampaignRun& run) { return run.outcome && run.outcome->status == RunStatus::complete; });
  const auto reused = count([](const CampaignRun& run) { return run.outcome && run.outcome->reused; });
  std::string text = fmt::format("{}: {}, {} complete ({} reused)", runs.front().experiment->name,
                                 counted(runs.size(), "run"), complete, reused);
  for (const RunStatus status : {RunStatus::implausible, RunStatus::diverged, RunStatus::interrupted}) {
    const auto here =
        count([&](const CampaignRun& run) { return run.outcome && run.outcome->status == status; });
    if (here > 0) text += fmt::format(", {} {}", here, to_string(status));
  }
  if (const auto failed = count([](const CampaignRun& run) { return !run.error.empty(); }); failed > 0)
    text += fmt::format(", {} failed", failed);
  for (const CollectedText& warning : collected_warnings(runs))
    text += fmt::format(", {} with the warning {}", warning.runs, warning.kind);
  return text + "; " + time_text(runs) + "\n" + failed_expectations(runs);
}

}  // namespace bendlab
