#include "experiments/run.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cctype>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include "bendlab/constraints/pack.hpp"
#include "bendlab/io/frame_writer.hpp"
#include "bendlab/metrics/drape.hpp"
#include "bendlab/solver/colouring.hpp"
#include "experiments/accuracy.hpp"
#include "experiments/machine.hpp"
#include "experiments/recorder.hpp"
#include "experiments/stability.hpp"
#include "experiments/strip.hpp"
#include "experiments/version.hpp"

namespace bendlab {
namespace {

std::string hex_hash(const std::string& text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

std::string file_bytes(const std::string& pointer, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw RunFileError(fmt::format("{}: the mesh file cannot be read; check {} and the file's permissions",
                                   file.string(), pointer));
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Vertices and rest values of a list in the order the solver projects them (padded lanes left out). Hashed
// one by one: a copy of millions of springs would be the largest thing in memory.
template <class List, class RestOf>
ConstraintRecord record_of(const std::string& kind, const List& list, const BatchOrder& order, bool in_full,
                           RestOf rest_of) {
  ConstraintRecord record{.kind = kind, .count = list.size()};
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(hash.get());
  for (const int constraint : order.constraint_of_lane) {
    if (constraint < 0) continue;
    const auto& vertices = list.vertices[static_cast<std::size_t>(constraint)];
    const double rest = rest_of(static_cast<std::size_t>(constraint));
    record.vertices_per_constraint = static_cast<int>(vertices.size());
    XXH3_64bits_update(hash.get(), vertices.data(), sizeof(vertices));
    XXH3_64bits_update(hash.get(), &rest, sizeof(rest));
    if (!in_full) continue;
    record.vertices.insert(record.vertices.end(), vertices.begin(), vertices.end());
    record.rest.push_back(rest);
  }
  record.hash = fmt::format("{:016x}", XXH3_64bits_digest(hash.get()));
  return record;
}

RunHeader header_of(const Experiment& experiment, const RunConfig& config, const std::string& id,
                    const Scene& scene, const Simulation& simulation, const Recorder& recorder) {
  const BuildInfo& build = build_info();
  const RestMesh& rest = scene.rest;
  const bool in_full = config.section("/output").boolean("constraints");
  RunHeader header;
  header.id = id;
  header.name = experiment.name;
  header.rest_positions.assign(rest.positions().data(), rest.positions().data() + rest.positions().size());
  header.triangles.assign(rest.triangles().data(), rest.triangles().data() + rest.triangles().size());
  header.pinned.assign(scene.pins.is_pinned.begin(), scene.pins.is_pinned.end());
  header.pin_seeds = scene.pins.seeds;
  header.metrics = recorder.metrics();
  header.cell_fields = recorder.cell_fields();
  header.constraints = {record_of("strain", scene.input.strain, simulation.strain_order(), in_full,
                                  [&](std::size_t c) {  // rest area: 1 / (2 |det Q⁻¹|)
                                    const InverseRest& q = scene.input.strain.inverse_rest[c];
                                    return 0.5 / std::abs(q[0] * q[3] - q[1] * q[2]);
                                  }),
                        record_of("distance", scene.input.distance, simulation.distance_order(), in_full,
                                  [&](std::size_t c) { return scene.input.distance.rest_length[c]; })};
  if (const DistanceConstraints& edges = scene.input.edges; edges.size() > 0)
    header.constraints.push_back(record_of("edge", edges, list_order(edges.size()), in_full,
                                           [&](std::size_t c) { return edges.rest_length[c]; }));
  for_each_kind(scene.input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    if (list.size() > 0)  // of the rest values, the first
      header.constraints.push_back(record_of(std::string(Kind::name), list,
                                             simulation.element_order(Kind::name), in_full,
                                             [&](std::size_t c) { return list.rest[c][0]; }));
  });
  std::string ordering_hash;
  for (const ConstraintRecord& record : header.constraints) ordering_hash += record.hash;
  header.provenance = {{"version", std::string(build.version)},
                       {"git_commit", std::string(build.git_commit)},
                       {"git_dirty", build.git_dirty ? "yes" : "no"},
                       {"source_hash", std::string(build.source_hash)},
                       {"compiler", std::string(build.compiler)},
                       {"compiler_flags", std::string(build.flags)},
                       {"build_type", std::string(build.build_type)},
                       {"vector_bits", std::to_string(8 * pack_bytes)},
                       {"processor", processor_name()},
                       {"host", host_name()},
                       {"threads", std::to_string(scene.input.settings.threads)},
                       {"precision", scene.precision == Precision::double_precision ? "double" : "single"},
                       {"ordering_hash", ordering_hash},
                       {"started", utc_now()}};
  if (!scene.mesh_notes.empty())
    header.provenance["mesh_notes"] = fmt::format("{}", fmt::join(scene.mesh_notes, "; "));
  header.config = config.resolved.dump(2);
  header.double_positions = scene.precision == Precision::double_precision;
  return header;
}

// "; triangle 12 (3, 4, 9), the most stretched, is 1.2e+05 times as long as at rest", or nothing without strain
// constraints.
std::string worst_triangle_text(const Divergence& divergence, const Triangles& triangles) {
  const auto& [a, b, c] = divergence.triangle;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (triangles(t, 0) == a && triangles(t, 1) == b && triangles(t, 2) == c)
      return fmt::format("; triangle {} ({}, {}, {}), the most stretched, is {:.3g} times as long as at rest",
                         t, a, b, c, divergence.stretch);
  return "";
}

std::string divergence_message(const Divergence& divergence, const Scene& scene) {
  const bool projects = scene.input.settings.method == Method::pbd;
  const bool published_shear = projects && scene.input.strain_stiffness.form == StrainForm::normalised;
  return fmt::format(
      "diverged at t = {:.6g} s: vertex {} is at ({:.3g}, {:.3g}, {:.3g}) m{}; the frames before it are "
      "kept. "
      "A smaller /solver/dt{}{} or a lower stiffness may help",
      divergence.time, divergence.vertex, divergence.position.x(), divergence.position.y(),
      divergence.position.z(), worst_triangle_text(divergence, scene.rest.triangles()),
      projects ? ", more /solver/substeps" : "",
      published_shear ? ", /material/strain/form: angle, the effect tethers" : "");
}

// Whether the cloth has come to rest: looked at from time to time, because a look copies all velocities.
class Calm {
 public:
  explicit Calm(double speed) : speed_(speed) {}

  // Whether no look in the last half second found a vertex faster than `speed`.
  bool settled(const Simulation& simulation) {
    constexpr double looks_per_second = 60, calm_s = 0.5, rounding = 1e-9;
    if (speed_ == 0 || simulation.time() < next_look_ - rounding) return false;
    next_look_ = simulation.time() + 1 / looks_per_second;
    if (!(simulation.velocities().rowwise().squaredNorm().maxCoeff() <= speed_ * speed_))
      since_ = simulation.time();
    return simulation.time() - since_ >= calm_s - rounding;
  }
  double since() const { return since_; }  // s

 private:
  double speed_, next_look_ = 0, since_ = 0;
};

// Steps to the end, rest, a stop or divergence, and records frames on the way.
struct Stepping {
  RunStatus status = RunStatus::complete;
  std::string message;
  std::optional<double> settled_at = std::nullopt;  // s
};

Stepping step_to_end(Simulation& simulation, const Scene& scene, const Recorder& recorder,
                     FrameWriter& writer, std::optional<StabilityMeter>& stability, const RunConfig& config,
                     const RunControl& control) {
  const double duration = config.section("").number("duration"), dt = config.section("/solver").number("dt");
  const double frame_interval = 1 / config.section("/output").number("frames_per_second");
  constexpr double rounding = 1e-6;  // of a step: a step that ends on a frame's time by rounding records it
  const std::int64_t steps = step_count(config);
  writer.push(recorder.capture(simulation));
  if (stability) stability->look(simulation);
  double next_frame = frame_interval;
  Calm calm(config.section("").number("settled_speed"));
  for (std::int64_t step = 1; step <= steps; ++step) {
    if (!simulation.step()) return {RunStatus::diverged, divergence_message(simulation.divergence(), scene)};
    if (stability) stability->look(simulation);
    const double time = simulation.time();
    const bool stop = control.stop && control.stop->load(std::memory_order_relaxed);
    // A cloth on the way to an equilibrium has no velocities: only the method itself knows.
    const bool balanced = simulation.settled(),
               settled = balanced || (!simulation.unbalanced() && calm.settled(simulation));
    if (time < next_frame - rounding * dt && step < steps && !stop && !settled) continue;
    while (next_frame <= time + rounding * dt) next_frame += frame_interval;
    writer.push(recorder.capture(simulation));
    if (control.progress) control.progress(time, duration);
    if (settled) return {.settled_at = balanced ? time : calm.since()};
    if (stop && step < steps)
      return {
          RunStatus::interrupted,
          fmt::format(
              "stopped at t = {:.6g} s of {:.6g} s, the frames so far are kept; the same command again runs "
              "what is not complete",
              time, duration)};
  }
  if (const std::optional<double> unbalanced = simulation.unbalanced())
    return {RunStatus::complete,
            fmt::format(
                "no equilibrium yet after {} steps: {:.2g} of the loads are not balanced; a longer /duration "
                "allows more steps",
                steps, *unbalanced)};
  return {};
}

// The strip whose stiffness the config asks for. Throws ConfigError before the run where it is none.
std::optional<RunStrip> strip_asked_for(const RunConfig& config, const Scene& scene) {
  if (!config.section("/output").boolean("stiffness")) return std::nullopt;
  try {
    RunStrip strip = strip_of(config, scene.rest, scene.pins);
    strip.meter.height_over_width(scene.input.positions,
                                  0);  // throws where the clamp starts out turned or folded
    return strip;
  } catch (const std::invalid_argument& error) {
    throw ConfigError("stiffness", {{"/output/stiffness", error.what()}});
  }
}

void check_drape(const RunConfig& config, const Scene& scene) try {
  if (config.section("/output").boolean("drape"))
    drape_of(scene.rest, scene.pins, scene.rest.positions(), scene.down);
} catch (const std::invalid_argument& error) {
  throw ConfigError("drape", {{"/output/drape", error.what()}});
}

void add_message(RunOutcome& outcome, const std::string& text) {
  outcome.message += (outcome.message.empty() ? "" : "; ") + text;
}

void add_drape(const Scene& scene, const Simulation& simulation, RunOutcome& outcome) {
  const Drape drape = drape_of(scene.rest, scene.pins, simulation.positions(), scene.down);
  outcome.summary["drape_coefficient"] = drape.coefficient;
  outcome.summary["drape_folds"] = drape.folds;
}

// Adds the strip's stiffness to the summary, or to the message why there is none (its pins may have moved).
void add_stiffness(const RunStrip& strip, const Simulation& simulation, RunOutcome& outcome) try {
  outcome.summary.merge(stiffness_summary(strip.meter.measure(simulation.positions(), strip.options)));
} catch (const std::invalid_argument& error) {
  add_message(outcome, fmt::format("no stiffness: {}", error.what()));
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
  return {.id = record.id,
          .status = record.status,
          .reused = true,
          .file = record.file,
          .message = message == record.provenance.end() ? "" : message->second,
          .wall_s = record.wall_s,
          .cpu_s = record.cpu_s,
          .step_cpu_s = record.step_cpu_s,
          .summary = record.summary,
          .passes = record.passes};
}

// The run's file if it is there and over: complete, or diverged (which it would again, bit for bit).
std::optional<RunOutcome> finished_run(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const RunRecord record = read_run(file);
    if (record.status == RunStatus::complete || record.status == RunStatus::diverged)
      return outcome_of(record);
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

// Errors are in the summary: another reference makes another run. One that cannot be is told when its turn comes.
std::string reference_id(const RunConfig& config, Against against, bool coarser) try {
  const std::optional<RunConfig> reference = reference_of(config, against, coarser);
  return reference ? run_id(*reference) : "";
} catch (const ConfigError&) {
  return "";
}

// Adds the run's errors to the summary, or to the message why there are none.
void add_errors(const Accuracy& accuracy, const Simulation& simulation, const std::filesystem::path& folder,
                const RunControl& control, RunOutcome& outcome) {
  const Accuracy::Result result =
      accuracy.against_references(outcome.id, simulation.positions(), folder, control.stop);
  outcome.summary.insert(result.summary.begin(), result.summary.end());
  for (const std::string& message : result.messages) add_message(outcome, message);
  if (!result.stopped) return;
  outcome.status = RunStatus::interrupted;
  add_message(outcome,
              "stopped before it was compared with its references; the same command again does it all");
}

}  // namespace

std::string run_id(const RunConfig& config) {
  std::string identity = identity_text(config) + std::string(build_info().source_hash);
  for (const auto& [pointer, file] : input_files(config)) identity += file_bytes(pointer, file);
  if (const std::optional<RunConfig> before = run_before(config)) identity += run_id(*before);
  for (const Against against : references)
    for (const bool coarser : {false, true}) identity += reference_id(config, against, coarser);
  return hex_hash(identity + config.starts_at_end_of);
}

std::filesystem::path run_folder(const std::filesystem::path& out, const Experiment& experiment,
                                 const RunConfig& config) {
  const std::string place = readable_place(config), id = run_id(config);
  return out / experiment.name / (place.empty() ? id : place + "-" + id);
}

RunOutcome execute_run(const Experiment& experiment, const RunConfig& config,
                       const std::filesystem::path& out, const RunControl& control,
                       const StartingPose* start) {
  const std::filesystem::path file = run_folder(out, experiment, config) / "run.vtkhdf";
  if (std::optional<RunOutcome> finished = finished_run(file)) return *finished;

  const auto wall_start = std::chrono::steady_clock::now();
  const double cpu_start = thread_cpu_s();
  Scene scene = build_scene(config);
  std::optional<Scene> whole;
  if (control.minimal) whole = take_idle_effects_out(scene);
  start_after(config, scene, control.stop);
  if (start) start_from(scene, *start, "/accuracy/start_from_end");
  const std::optional<RunStrip> strip = strip_asked_for(config, scene);
  check_drape(config, scene);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  Recorder recorder(scene);
  std::optional<StabilityMeter> stability;
  if (config.section("/output").boolean("stability"))
    stability.emplace(scene, config.section("").number("duration"));
  Accuracy accuracy(config, scene);
  const double set_up_s = thread_cpu_s() - cpu_start;
  RunOutcome outcome{.id = run_id(config), .file = file};
  const RunHeader header = header_of(experiment, config, outcome.id, scene, *simulation, recorder);

  make_folder(file.parent_path());
  FrameWriter writer(file, header, [&](Frame& frame) {
    accuracy.keep(frame, Recorder::kinetic_energy_of(frame));
    recorder.complete(frame);
  });
  const double before_steps = thread_cpu_s();
  const Stepping stepping = step_to_end(*simulation, scene, recorder, writer, stability, config, control);
  outcome.step_cpu_s = thread_cpu_s() - before_steps + simulation->helper_seconds();
  writer.drain();
  const double recording_s = writer.cpu_s();
  outcome.status = stepping.status;
  outcome.message =
      fmt::format("{}{}{}", fmt::join(scene.mesh_notes, "; "),
                  scene.mesh_notes.empty() || stepping.message.empty() ? "" : "; ", stepping.message);
  if (whole) {
    const Comparison comparison = compare_to_whole(*simulation, *whole);
    add_message(outcome, comparison.text);
    outcome.differs = comparison.differs;
  }
  outcome.summary = recorder.summary(*simulation);
  if (stability) outcome.summary.merge(stability->summary());
  if (stepping.settled_at) outcome.summary["settled_at"] = *stepping.settled_at;
  if (outcome.status != RunStatus::diverged) {
    if (strip) add_stiffness(*strip, *simulation, outcome);
    if (config.section("/output").boolean("drape")) add_drape(scene, *simulation, outcome);
  }
  outcome.passes.push_back({"set_up", set_up_s, 1});
  for (const PassStatistics& pass : simulation->passes())
    outcome.passes.push_back({pass.name, pass.seconds, pass.calls, pass.acted});
  outcome.passes.push_back({"recording", recording_s, writer.frames()});
  outcome.cpu_s = thread_cpu_s() - cpu_start + recording_s + simulation->helper_seconds();
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  if (accuracy.asked_for() && outcome.status == RunStatus::complete)
    add_errors(accuracy, *simulation, out / experiment.name, control, outcome);
  RunFooter footer{.status = outcome.status,
                   .summary = outcome.summary,
                   .passes = outcome.passes,
                   .wall_s = outcome.wall_s,
                   .cpu_s = outcome.cpu_s,
                   .step_cpu_s = outcome.step_cpu_s};
  if (!outcome.message.empty()) footer.provenance["message"] = outcome.message;
  writer.finish(footer);
  return outcome;
}

}  // namespace bendlab
