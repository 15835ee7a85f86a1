#include "experiments/run/run.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cctype>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>

#include "bendlab/io/frame_writer.hpp"
#include "experiments/run/machine.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/run_header.hpp"
#include "experiments/run/stepping.hpp"
#include "experiments/run/version.hpp"

namespace bendlab {
namespace {

std::string file_bytes(const std::string& pointer, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw RunFileError(fmt::format("{}: the mesh file cannot be read; check {} and the file's permissions",
                                   file.string(), pointer));
  return {std::istreambuf_iterator<char>(stream), {}};
}

void add_message(RunOutcome& outcome, const std::string& text) {
  outcome.message += (outcome.message.empty() ? "" : "; ") + text;
}

// A stopped run gets no verdict: it will be run again. A diverged run reports the broken bound, too.
void add_verdict(std::optional<BrokenBound> broken, RunOutcome& outcome) {
  if (!broken || outcome.status == RunStatus::interrupted) return;
  if (outcome.status == RunStatus::complete) outcome.status = RunStatus::implausible;
  add_message(outcome, "implausible: " + text_of(*broken));
  outcome.broken = std::move(broken);
}

// Leaves out the effects that cannot act. Returns the scene as it was.
Scene take_idle_effects_out(Scene& scene) {
  Scene whole = scene;
  const std::vector<std::size_t> idle = idle_effects(scene);
  for (auto index = idle.rbegin(); index != idle.rend(); ++index)
    scene.effects.erase(scene.effects.begin() + static_cast<std::ptrdiff_t>(*index));
  return whole;
}

// What `minimal` left out, and whether that changed a bit.
struct Comparison {
  std::string text;
  bool differs = false;
};
Comparison compare_to_whole(const Simulation& minimal, const Scene& whole) {
  std::vector<std::string> names;
  for (const std::size_t index : idle_effects(whole))
    names.push_back(fmt::format("/effects/{} ({})", index, whole.effects[index].type));
  if (names.empty()) return {"minimal: every listed effect may act, none was left out"};
  const std::unique_ptr<Simulation> simulation = simulation_of(whole);
  while (simulation->time() < minimal.time())
    if (!simulation->step()) break;
  const bool same =
      simulation->positions() == minimal.positions() && simulation->velocities() == minimal.velocities();
  return {
      fmt::format("minimal: left out {}; positions and velocities at t = {:.6g} s are {} bits as with them",
                  fmt::join(names, ", "), minimal.time(), same ? "the same" : "NOT THE SAME"),
      !same};
}

RunOutcome outcome_of(const RunRecord& record) {
  const auto message = record.provenance.find("message");
  const auto json = [&](const char* name) {
    const auto text = record.provenance.find(name);
    return text == record.provenance.end() ? Json() : Json::parse(text->second, nullptr, false);
  };
  return {.id = record.id,
          .status = record.status,
          .reused = true,
          .file = record.file,
          .broken = broken_bound_of(json("implausible")),
          .warnings = warnings_of(json("warnings")),
          .message = message == record.provenance.end() ? "" : message->second,
          .wall_s = record.wall_s,
          .cpu_s = record.cpu_s,
          .step_cpu_s = record.step_cpu_s,
          .summary = record.summary,
          .passes = record.passes};
}

// The run's file if it is there and over: whole, or diverged (which it would again, bit for bit).
std::optional<RunOutcome> finished_run(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const RunRecord record = read_run(file);
    if (is_over(record.status)) return outcome_of(record);
  } catch (const RunFileError&) {  // unreadable: run again, which replaces it
  }
  return std::nullopt;
}

// "mesh/cells" → "cells", values without quotes; what a folder's name can't hold becomes '_'.
std::string readable_place(const RunConfig& config) {
  std::string place;
  for (const auto& [pointer, value] : config.point) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    place += fmt::format("{}{}={}", place.empty() ? "" : ",", pointer.substr(pointer.rfind('/') + 1), text);
  }
  for (char& c : place)
    if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("=,.-_", c)) c = '_';
  constexpr std::size_t longest = 120;  // well within a file system's 255 bytes, with the id behind it
  return place.substr(0, longest);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw RunFileError(fmt::format("{}: the folder cannot be made: {}; choose another place with --out",
                                   folder.string(), error.message()));
}

// The id of a run that another one needs. Throws RunFileError that names the setting which asks for it.
std::string id_of_other(const RunConfig& other, const std::string& pointer) try {
  return run_id(other);
} catch (const RunFileError& error) {
  throw RunFileError(fmt::format("{}: {}", pointer, error.what()));
}

// The summary has errors against a reference, so another reference makes another run. Wrong settings of the
// reference are reported when it is needed.
std::string reference_id(const RunConfig& config, Against against, bool coarser) try {
  const std::optional<RunConfig> reference = reference_of(config, against, coarser);
  return reference ? id_of_other(*reference, reference_pointer(against, coarser)) : "";
} catch (const ConfigError&) {
  return "";
}

// One of several threads that want the same run computes it; the others wait here, and find it done.
std::mutex& turn_for(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::map<std::string, std::mutex> of_folder;
  const std::lock_guard lock(mutex);
  return of_folder[folder.string()];
}

// Runs another run that a measure needs below `folder`, or finds it made.
OtherRun make_other_run(const RunConfig& config, const StartingPose* start,
                        const std::filesystem::path& folder, const RunControl& control) {
  Experiment experiment;
  experiment.name = "references";
  const std::lock_guard turn(turn_for(run_folder(folder, experiment, config)));
  const RunOutcome outcome = execute_run(experiment, config, folder, {.stop = control.stop}, start);
  return {outcome.status, outcome.file, outcome.summary, outcome.message};
}

void add_findings(Findings findings, RunOutcome& outcome) {
  outcome.summary.merge(findings.summary);
  for (const std::string& message : findings.messages) add_message(outcome, message);
  if (!findings.stopped) return;
  outcome.status = RunStatus::interrupted;
  add_message(outcome,
              "stopped before it was compared with its references; the same command again does it all");
}

}  // namespace

std::string hex_hash(const std::string& text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

std::string run_id(const RunConfig& config) {
  std::string identity = identity_text(config.resolved()) + std::string(build_info().source_hash);
  for (const auto& [pointer, file] : input_files(config)) identity += file_bytes(pointer, file);
  if (const std::optional<RunConfig> before = run_before(config))
    identity += id_of_other(*before, "/initial/after");
  for (const Against against : references)
    for (const bool coarser : {false, true}) identity += reference_id(config, against, coarser);
  return hex_hash(identity + config.starts_at_end_of);
}

std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config) {
  return run_folder(out, experiment, config, run_id(config));
}

std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config, const std::string& id) {
  const std::string place = readable_place(config);
  return out / experiment.name / (place.empty() ? id : place + "-" + id);
}

RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control,
                       const StartingPose* start) {
  const std::string id = run_id(config);
  const std::filesystem::path file = run_folder(out, experiment, config, id) / "run.vtkhdf";
  if (std::optional<RunOutcome> finished = finished_run(file)) return *finished;

  const auto wall_start = std::chrono::steady_clock::now();
  const double cpu_start = thread_cpu_s();
  Scene scene = build_scene(config);
  std::optional<Scene> whole;
  if (control.minimal) whole = take_idle_effects_out(scene);
  start_after(config, scene, control.stop);
  if (start) start_from(scene, *start, "/accuracy/start_from_end");
  Recorder recorder(config, scene);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  Plausibility plausibility(scene);
  const double set_up_s = thread_cpu_s() - cpu_start;
  RunOutcome outcome{.id = id, .file = file};
  const RunHeader header = header_of(experiment, config, outcome.id, scene, *simulation, recorder);

  make_folder(file.parent_path());
  FrameWriter writer(file, header, [&](Frame& frame) { recorder.complete(frame, plausibility); });
  const Stepping stepping = step_to_end(*simulation, scene, recorder, plausibility, writer, config, control);
  outcome.step_cpu_s = stepping.cpu_s;
  writer.drain();
  const double recording_s = writer.cpu_s();
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
  outcome.passes.push_back({"recording", recording_s, writer.frames()});
  outcome.cpu_s = thread_cpu_s() - cpu_start + recording_s + simulation->helper_seconds();
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  add_findings(recorder.findings(end, true), outcome);
  RunFooter footer{.status = outcome.status,
                   .summary = outcome.summary,
                   .passes = outcome.passes,
                   .wall_s = outcome.wall_s,
                   .cpu_s = outcome.cpu_s,
                   .step_cpu_s = outcome.step_cpu_s};
  outcome.warnings = warnings_of({experiment, config, scene, &outcome.summary});
  if (!outcome.message.empty()) footer.provenance["message"] = outcome.message;
  if (outcome.broken) footer.provenance["implausible"] = to_json(*outcome.broken).dump();
  if (!outcome.warnings.empty()) footer.provenance["warnings"] = to_json(outcome.warnings).dump();
  writer.finish(footer);
  return outcome;
}

}  // namespace bendlab
