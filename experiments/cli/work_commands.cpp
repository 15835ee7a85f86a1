#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <system_error>

#include "bendlab/io/disk.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "experiments/campaign/plan_file.hpp"
#include "experiments/campaign/sweep_file.hpp"
#include "experiments/campaign/work.hpp"
#include "experiments/cli/child_program.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/cli/report.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/signals.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

namespace fs = std::filesystem;

/// "2/8" → the third of eight shards.
Shard shard_of(const std::string& text) {
  std::size_t index = 0, count = 0;
  int read = 0;
  if (std::sscanf(text.c_str(), "%zu/%zu%n", &index, &count, &read) != 2 ||
      static_cast<std::size_t>(read) != text.size() || index >= count)
    throw UsageError(fmt::format("--shard: '{}' is not of the form i/n with 0 ≤ i < n, such as 0/8", text));
  return {index, count};
}

void print_news(const std::string& what) {
  print_text(stderr, "bendlab: {}\n", what);
}

/// As many tasks as let each run have a CPU at once, but at most 1000.
std::size_t task_count(std::size_t runs, int cpus) {
  const auto per_task = static_cast<std::size_t>(cpus);
  return std::min<std::size_t>((runs + per_task - 1) / per_task, 1000);
}

std::string batch_file(const fs::path& plan, const std::string& name, std::size_t tasks,
                       const SubmitArguments& arguments) {
  constexpr int notice_s = 60;  // s before the time limit: enough to write a checkpoint
  std::string head =
      fmt::format("#!/bin/bash\n#SBATCH --job-name=bendlab-{}\n#SBATCH --array=0-{}\n#SBATCH --ntasks=1\n",
                  name, tasks - 1);
  head += fmt::format("#SBATCH --cpus-per-task={}\n", arguments.cpus);
  if (!arguments.time.empty()) head += fmt::format("#SBATCH --time={}\n", arguments.time);
  head +=
      fmt::format("#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:TERM@{}\n", notice_s);
  head += fmt::format("#SBATCH --output={}/%a.log\n", fs::path(plan).replace_extension(".logs").string());
  for (const std::string& option : arguments.sbatch) head += fmt::format("#SBATCH {}\n", option);
  return head + fmt::format(R"(
{} work {} --shard "$SLURM_ARRAY_TASK_ID/{}" --jobs {} &
worker=$!
trap 'kill -TERM "$worker" 2>/dev/null' TERM
wait "$worker"
code=$?
while kill -0 "$worker" 2>/dev/null; do  # a signal ended the wait, not the worker
  wait "$worker"
  code=$?
done
# Stopped by a time limit: the runs are at their checkpoints, and the task goes on from there.
if [ "$code" -eq 143 ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
fi
exit "$code"
)",
                            shell_quoted(own_program()), shell_quoted(plan.string()), tasks, arguments.cpus);
}

/// Submits a batch file and returns the job's number, which sbatch prints. Throws UsageError if there is no
/// sbatch, or if sbatch refuses the file.
std::string submit(const fs::path& batch) {
  const std::string command = fmt::format("sbatch --parsable {} 2>&1", shell_quoted(batch.string()));
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw UsageError("sbatch could not be started: no process is available");
  std::string output;
  std::array<char, 4096> block{};
  while (const std::size_t got = std::fread(block.data(), 1, block.size(), pipe))
    output.append(block.data(), got);
  const int status = ::pclose(pipe);
  while (output.ends_with('\n')) output.pop_back();
  if (status != 0)
    throw UsageError(fmt::format(
        "Slurm's sbatch refused {}: {}. The plan was written; 'bendlab work' computes the plan without Slurm",
        batch.string(), output));
  return output;
}

}  // namespace

int work_command(const WorkArguments& arguments, CampaignOptions options, bool json) {
  options.shard = arguments.shard.empty() ? Shard{} : shard_of(arguments.shard);
  const Plan plan = load_plan(arguments.plan);
  options.out = plan.out;
  write(sweep_files(plan.out, plan.experiments));
  catch_stop_signals();
  const std::vector<CampaignRun> runs = work_on(plan.experiments, options);
  std::size_t computed = 0, found = 0, left = 0, failed = 0;
  for (const CampaignRun& run : runs) {
    if (!run.error.empty()) ++failed;
    if (!run.outcome) continue;
    if (run.outcome->left)
      ++left;
    else if (run.outcome->reused)
      ++found;
    else if (is_over(run.outcome->status))
      ++computed;
    if (json && !run.outcome->left && !run.outcome->reused) print_text("{}\n", json_text(run_json(run)));
  }
  print_news(fmt::format(
      "{} of {} computed here, {} computed by other processes, {} being computed elsewhere, {} failed",
      computed, counted(runs.size(), "run"), found, left, failed));
  if (stop_exit_code() != 0)
    print_news("stopped; unfinished runs wrote checkpoints, from which the same command continues");
  return campaign_exit_code(runs);
}

int status_command(const fs::path& file, bool json) {
  const PlanOverview plan = read_plan(file);
  std::set<fs::path> parents;
  for (const PlannedRun& run : plan.runs) parents.insert(run.folder.parent_path());
  const RunsOnDisk on_disk(parents, print_news);
  using Kind = RunState::Kind;
  std::map<std::string, std::size_t> count;
  double done_s = 0, work_done = 0, work_left = 0;
  const auto name_of = [](const RunState& state) -> std::string {
    constexpr std::array names = {"over", "running", "failed", "interrupted", "unreadable", "waiting"};
    return state.kind == Kind::over ? to_string(state.record.status)
                                    : names.at(static_cast<std::size_t>(state.kind));
  };
  Table table({"state", "run", ""});
  bool any = false;
  for (const PlannedRun& run : plan.runs) {
    const RunState state = on_disk.state_of(run.folder, run.id);
    const bool over = state.kind == Kind::over;
    ++count[name_of(state)];
    if (over)
      done_s += state.record.cpu_s, work_done += run.work;
    else
      work_left += run.work;
    if (json)
      print_text("{}\n", json_text(Json{{"id", run.id},
                                        {"run", run.text},
                                        {"folder", run.folder.string()},
                                        {"state", name_of(state)},
                                        {"text", state.text},
                                        {"work", run.work},
                                        {"wall_s", over ? state.record.wall_s : 0},
                                        {"cpu_s", over ? state.record.cpu_s : 0}}));
    if (state.kind == Kind::running || state.kind == Kind::failed) {
      table.add_row({name_of(state), run.text, state.text});
      any = true;
    }
  }
  if (json) return exit_ok;
  std::vector<std::string> parts;
  for (const auto& [name, runs] : count) parts.push_back(fmt::format("{} {}", runs, name));
  print_text("{}: {}\n", counted(plan.runs.size(), "run"), fmt::join(parts, ", "));
  if (work_left > 0 && done_s > 0)
    print_text("the finished runs took {} of CPU time; by their time, the other runs take about {}\n",
               duration_text(done_s), duration_text(work_left * done_s / work_done));
  if (any) print_text("\n{}", table.text());
  return exit_ok;
}

int submit_command(const ConfigArguments& configs, const fs::path& out, const SubmitArguments& arguments) {
  const std::vector<Experiment> experiments = load_experiments(configs);
  std::size_t runs = 0;
  std::string ids;  // the plan's name depends on its runs
  for (const CampaignRun& run : plan_campaign(experiments)) ids += run_id(*run.config), ++runs;
  const std::size_t tasks = arguments.tasks > 0
                                ? std::min<std::size_t>(static_cast<std::size_t>(arguments.tasks), runs)
                                : task_count(runs, arguments.cpus);
  const std::string name = experiments.front().name;
  const fs::path plan =
      fs::absolute(out / "plans" / fmt::format("{}-{}.plan.json", name, hex_hash(ids).substr(0, 8)))
          .lexically_normal();
  const std::string text = batch_file(plan, name, tasks, arguments);
  if (arguments.dry_run) {
    print_text("{}", text);
    return exit_ok;
  }
  write_plan(plan, experiments, out);
  make_folder(fs::path(plan).replace_extension(".logs"));
  const fs::path batch = fs::path(plan).replace_extension(".sbatch");
  replace_file(batch, text);
  const std::string job = submit(batch);
  print_text("job {}: {} in {}; 'bendlab status {}' shows the progress\n", job, counted(runs, "run"),
             counted(tasks, "task"), plan.string());
  return exit_ok;
}

}  // namespace bendlab
