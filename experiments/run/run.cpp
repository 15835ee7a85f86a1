#include "experiments/run/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "bendlab/io/checksum.hpp"
#include "bendlab/io/disk.hpp"
#include "bendlab/io/folder_lock.hpp"
#include "bendlab/io/frame_writer.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/references.hpp"
#include "experiments/run/folder.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run_header.hpp"
#include "experiments/run/run_id.hpp"
#include "experiments/run/stepping.hpp"
#include "experiments/run/warnings.hpp"

namespace bendlab {
namespace {

void add_message(RunOutcome& outcome, const std::string& text) {
  if (text.empty()) return;
  outcome.message += (outcome.message.empty() ? "" : "; ") + text;
}

// A stopped run gets no verdict, because it may continue. A diverged run also reports the broken bound.
void add_verdict(std::optional<BrokenBound> broken, RunOutcome& outcome) {
  if (!broken || outcome.status == RunStatus::interrupted) return;
  if (outcome.status == RunStatus::complete) outcome.status = RunStatus::implausible;
  add_message(outcome, "implausible: " + text_of(*broken));
  outcome.broken = std::move(broken);
}

// A run whose summary has a metric that is not finite is implausible. (Measures leave out metrics that are
// infinite by their definition.)
void judge_summary(double time, RunOutcome& outcome) {
  if (!is_whole(outcome.status)) return;
  std::vector<std::string> names;
  for (const auto& [name, value] : outcome.summary)
    if (!std::isfinite(value)) names.push_back(name);
  if (names.empty()) return;
  outcome.status = RunStatus::implausible;
  const BrokenBound broken{
      .bound = Bound::finite, .measured = std::numeric_limits<double>::quiet_NaN(), .time = time};
  add_message(outcome, fmt::format("implausible: {}: {}", text_of(broken), fmt::join(names, ", ")));
  if (!outcome.broken) outcome.broken = broken;
}

// Removes the effects that cannot act from `scene`. Returns the scene with all effects.
BuiltScene take_idle_effects_out(BuiltScene& scene) {
  BuiltScene whole = scene;
  const std::vector<std::size_t> idle = idle_effects(scene);
  for (auto index = idle.rbegin(); index != idle.rend(); ++index)
    scene.effects.erase(scene.effects.begin() + static_cast<std::ptrdiff_t>(*index));
  return whole;
}

// The effects that `minimal` leaves out, and whether that changed a bit of the result.
struct Comparison {
  std::string text;
  bool differs = false;
};
Comparison compare_to_whole(const Simulation& minimal, const BuiltScene& whole) {
  std::vector<std::string> names;
  for (const std::size_t index : idle_effects(whole))
    names.push_back(fmt::format("/effects/{} ({})", index, whole.effects[index].name()));
  if (names.empty()) return {"minimal: every listed effect may act, so no effect was left out"};
  const std::unique_ptr<Simulation> simulation = simulation_of(whole);
  while (simulation->time() < minimal.time())
    if (!simulation->step()) break;
  const bool same =
      simulation->positions() == minimal.positions() && simulation->velocities() == minimal.velocities();
  return {
      fmt::format(
          "minimal: left out {}; positions and velocities at t = {:.6g} s have {} bits as with all effects",
          fmt::join(names, ", "), minimal.time(), same ? "the same" : "NOT THE SAME"),
      !same};
}

// Computes another run that a measure needs, below `folder`, or reads the run's file if it is complete.
OtherRun make_other_run(const RunConfig& config, const StartingPose* start,
                        const std::filesystem::path& folder, const RunControl& control) {
  Experiment experiment;
  experiment.name = "references";
  const RunOutcome outcome = execute_run(experiment, config, folder,
                                         {.stop = control.stop,
                                          .checkpoint_interval_s = control.checkpoint_interval_s,
                                          .waiting = control.waiting},
                                         start);
  return {outcome.status, outcome.file, outcome.summary, outcome.message};
}

void add_findings(Findings findings, RunOutcome& outcome) {
  outcome.summary.merge(findings.summary);
  for (const std::string& message : findings.messages) add_message(outcome, message);
  if (!findings.stopped) return;
  outcome.status = RunStatus::interrupted;
  add_message(outcome,
              "stopped before the comparison with the references; run the same command again to compare");
}

// The bits of a factorisation depend on the kernels that the BLAS chose for the processor. In single
// precision the factor of quasi_newton is rounded, so that kernels hardly ever change its bits. A run that
// starts at the result of another run, or that is compared with another run, depends on the kernels if the
// other run does.
bool depends_on_blas(const RunConfig& config) {
  const Solver& solver = config.scene().solver;
  const Factorised factorised = solver.method.kind().factorised;
  if (factorised == Factorised::blocks) return true;
  if (factorised == Factorised::scalars && solver.precision == ChosenPrecision::double_precision) return true;
  if (const std::optional<RunConfig> before = run_before(config); before && depends_on_blas(*before))
    return true;
  for (const Against against : references)
    for (const bool coarser : {false, true}) try {
        const std::optional<RunConfig> reference = reference_of(config, against, coarser);
        if (reference && depends_on_blas(*reference)) return true;
      } catch (const ConfigError&) {  // reported when the reference is needed
      }
  return false;
}

// BLAS kernels are not part of a run's id, so that a plan is the same on every machine. The results of two
// kernels differ only by rounding. A message says if the bits of the run may differ.
RunOutcome reused(const Found& existing, const RunConfig& config) {
  RunOutcome outcome = *existing.over;
  if (existing.blas_kernels != blas_kernels() && depends_on_blas(config))
    add_message(outcome,
                fmt::format("reused, although the run was computed with the BLAS kernels for {}; --force "
                            "computes the run again with the kernels of this machine, for {}",
                            existing.blas_kernels.empty() ? "another processor" : existing.blas_kernels,
                            blas_kernels()));
  return outcome;
}

RunFooter footer_of(const RunOutcome& outcome, const RunClock& clock) {
  RunFooter footer{.status = outcome.status,
                   .summary = outcome.summary,
                   .passes = outcome.passes,
                   .wall_s = outcome.wall_s,
                   .cpu_s = outcome.cpu_s,
                   .step_cpu_s = outcome.step_cpu_s};
  if (!outcome.message.empty()) footer.provenance["message"] = outcome.message;
  footer.provenance["ended"] = utc_now();
  if (!clock.went_on_at().empty())
    footer.provenance["went_on_at"] = fmt::format("{:.6g} s", fmt::join(clock.went_on_at(), ", "));
  if (outcome.broken) footer.provenance["implausible"] = to_json(*outcome.broken).dump();
  if (!outcome.warnings.empty()) footer.provenance["warnings"] = to_json(outcome.warnings).dump();
  return footer;
}

RunOutcome compute(const Experiment& experiment, const RunConfig& config, const std::filesystem::path& out,
                   const RunControl& control, const StartingPose* start, const RunPlace& place) {
  RunClock clock;
  BuiltScene scene = build_scene(config.scene());
  std::optional<BuiltScene> whole;
  if (control.minimal) whole = take_idle_effects_out(scene);
  start_after(config.scene(), scene, control.stop);
  if (start) start_from(scene, *start, "/accuracy/start_from_end");
  Recorder recorder(config, scene);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  Plausibility plausibility(scene);
  const double set_up_s = clock.thread_cpu_s();
  RunOutcome outcome{.id = place.id, .file = place.file};
  const RunHeader header = header_of(experiment, config, outcome.id, scene, *simulation, recorder);

  std::optional<FrameWriter> opened;
  const auto prepare = [&](Frame& frame) { recorder.complete(frame, plausibility); };
  try {
    if (place.saved) recorder.take_earlier(place.earlier);
    opened.emplace(place.file, header, prepare, place.part, place.earlier, in_memory);
  } catch (const RunFileError& error) {
    if (!place.saved) throw;
    throw Unresumable(error.what());
  }
  FrameWriter& writer = *opened;
  Checkpoints checkpoints(place.folder, place.id, writer,
                          Checkpoints::Seconds(control.checkpoint_interval_s));
  const Stepping stepping = step_to_end({*simulation, recorder, plausibility, writer, checkpoints, clock},
                                        scene, config, control, place.saved ? &*place.saved : nullptr);
  outcome.step_cpu_s = stepping.cpu_s;
  writer.drain();
  const double recording_s = clock.recording_s(writer.cpu_s());
  outcome.status = stepping.status;
  outcome.message =
      fmt::format("{}{}{}", fmt::join(scene.mesh_notes, "; "),
                  scene.mesh_notes.empty() || stepping.message.empty() ? "" : "; ", stepping.message);
  add_verdict(plausibility.broken(), outcome);
  if (whole) {
    const Comparison comparison = compare_to_whole(*simulation, *whole);
    add_message(outcome, comparison.text);
    outcome.differs = comparison.differs;
  }
  outcome.summary = facts_of(scene, *simulation);
  if (stepping.settled_at) outcome.summary["settled_at"] = *stepping.settled_at;
  const FrameHistory frames = recorder.history();
  const RunEnd end{outcome.status, outcome.id, *simulation, frames,
                   [&](const RunConfig& other, const StartingPose* from) {
                     return make_other_run(other, from, out / experiment.name, control);
                   }};
  add_findings(recorder.findings(end, false), outcome);
  outcome.passes.push_back({"set_up", set_up_s, 1});
  for (const PassStatistics& pass : simulation->passes())
    outcome.passes.push_back({pass.name, pass.seconds, pass.calls, pass.acted});
  outcome.passes.push_back({"recording", recording_s, stepping.frames});
  outcome.cpu_s = clock.thread_cpu_s() + recording_s + simulation->helper_seconds();
  outcome.wall_s = clock.wall_s();
  add_findings(recorder.findings(end, true), outcome);
  judge_summary(simulation->time(), outcome);
  outcome.warnings = warnings_of({experiment, config, scene, &outcome.summary, outcome.status});
  if (!place.lock->holds())
    throw RunFileError(fmt::format(
        "{}: this process lost its lock, because run.lock was removed, or because the file server "
        "could not be reached for too long. Another process may be computing this run. Run the "
        "same command again",
        place.file.string()));
  if (place.keeps_file && outcome.status == RunStatus::interrupted)
    add_message(outcome, "stopped; the earlier file is kept");
  else
    writer.finish(footer_of(outcome, clock));
  return outcome;
}

RunOutcome stopped_while_waiting(const RunPlace& place) {
  return {.id = place.id,
          .status = RunStatus::interrupted,
          .file = place.file,
          .message = "stopped while another process was computing this run"};
}

}  // namespace

RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control,
                       const StartingPose* start) {
  RunPlace place{.id = run_id(config)};
  place.folder = run_folder(out, experiment, config, place.id);
  place.file = place.folder / "run.vtkhdf";
  if (!control.force)
    if (const Found existing = look_for(place.file, place.id); existing.over) return reused(existing, config);
  make_folder(place.folder);
  place.lock = FolderLock::of(place.folder, {.when_locked = control.when_locked,
                                             .give_up = [&] { return control.stop && control.stop->load(); },
                                             .waiting = control.waiting});
  if (!place.lock && control.when_locked == WhenLocked::leave)
    return {.id = place.id, .status = RunStatus::running, .left = true, .file = place.file};
  if (!place.lock) return stopped_while_waiting(place);
  if (!control.force) adopt_finished(place);
  const Found existing = look_for(place.file, place.id);  // another process may have computed it meanwhile
  if (existing.over && !control.force) return reused(existing, config);
  const std::string note = existing.wrong.empty() ? "" : set_aside(place.file, existing.wrong);
  place.keeps_file = existing.over.has_value();
  place.part = fmt::format("{}.{}.part", place.file.string(), unique_token());
  const std::vector<std::filesystem::path> left = unfinished_files(place.folder);
  if (!control.force) find_checkpoint(place);
  require_room(config, place.folder);
  RunOutcome outcome = [&] {
    try {
      return compute(experiment, config, out, control, start, place);
    } catch (const Unresumable& error) {
      place.lost = error.what();
      remove_abandoned(place.part);
      place.saved.reset(), place.earlier = {};
      return compute(experiment, config, out, control, start, place);
    }
  }();
  for (const std::filesystem::path& file : left) remove_abandoned(file);
  if (place.keeps_file) remove_abandoned(place.part);  // exists if the run was stopped
  if (outcome.status != RunStatus::interrupted || place.keeps_file) remove_checkpoint(place.folder);
  add_message(outcome, note);
  if (!place.saved && !place.lost.empty())
    add_message(outcome,
                "the run began again from its start, because earlier frames can't be used: " + place.lost);
  return outcome;
}

}  // namespace bendlab
