#include "experiments/run/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <optional>

#include "bendlab/constraints/build.hpp"
#include "bendlab/metrics/alignment.hpp"
#include "bendlab/metrics/shape_error.hpp"
#include "bendlab/parameters/names.hpp"
#include "experiments/run/run.hpp"
#include "experiments/run/start_after.hpp"
#include "experiments/scene/energy.hpp"
#include "experiments/scene/pose_transfer.hpp"

namespace bendlab {
namespace {

// Frames of the two that have the same time but for rounding; not those at the start, where they are the same.
std::vector<std::array<std::size_t, 2>> common_frames(const Course& run, const Course& reference) {
  constexpr double rounding = 1e-6;  // s: of thousands of time steps added up
  std::vector<std::array<std::size_t, 2>> pairs;
  std::size_t other = 0;
  for (std::size_t f = 0; f < run.time.size(); ++f) {
    while (other + 1 < reference.time.size() && reference.time[other] < run.time[f] - rounding) ++other;
    if (run.time[f] > rounding && std::abs(reference.time[other] - run.time[f]) <= rounding)
      pairs.push_back({f, other});
  }
  return pairs;
}

// Compares single poses: what depends on the meshes alone is found once.
class PoseComparison {
 public:
  PoseComparison(const RestMesh& run, const RestMesh& reference, const Comparing& comparing)
      : run_(run),
        reference_(reference),
        comparing_(comparing),
        at_run_(reference, run),
        area_(lumped_masses(run, 1)) {}

  std::map<std::string, double> operator()(const Positions& pose, const Positions& reference) const {
    const Positions there = at_run_(reference);
    const RigidMotion motion = aligned(there, pose);
    const Positions moved = motion.moved(there);
    const ShapeError shape = shape_error(pose, moved, area_);
    const double hausdorff = hausdorff_distance({pose, run_.triangles(), {}},
                                                {motion.moved(reference), reference_.triangles(), {}});
    return {{"rms", shape.rms / run_.size()},
            {"largest", shape.largest / run_.size()},
            {"hausdorff", hausdorff / run_.size()},
            {"strain", comparing_.inextensible ? strain_error(run_, pose) : strain_error(run_, pose, moved)}};
  }

 private:
  RigidMotion aligned(const Positions& reference, const Positions& pose) const {
    switch (comparing_.align) {
      case AlignBy::none:
        return {};
      case AlignBy::vertical:
        return nearest_turn(reference, pose, area_, comparing_.centre, comparing_.down);
      case AlignBy::rigid:
        return nearest_motion(reference, pose, area_);
    }
    throw std::logic_error("aligned: unknown way");
  }

  const RestMesh &run_, &reference_;
  const Comparing& comparing_;
  PoseTransfer at_run_;
  std::vector<double> area_;  // m², of each vertex
};

// Means and worst of each over the frames.
std::map<std::string, double> over_frames(const std::vector<std::map<std::string, double>>& frames) {
  std::map<std::string, double> errors;
  for (const auto& frame : frames)
    for (const auto& [name, value] : frame) {
      errors[name] += value / static_cast<double>(frames.size());
      double& worst = errors[name + "_worst"];
      worst = std::max(worst, value);
    }
  errors["frames"] = static_cast<double>(frames.size());
  return errors;
}

// One of several threads that want the same run computes it; the others wait here, and find it done.
std::mutex& turn_for(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::map<std::string, std::mutex> of_folder;
  const std::lock_guard lock(mutex);
  return of_folder[folder.string()];
}

// The middle of the places that the scene pins, or of the rest box.
Vector3 middle_of_pins(const Scene& scene) {
  if (scene.pins.seeds.empty()) return scene.rest.centre();
  Vector3 sum = Vector3::Zero();
  for (const int seed : scene.pins.seeds) sum += scene.input.positions.row(seed).transpose();
  return sum / static_cast<double>(scene.pins.seeds.size());
}

// Runs the reference, or finds it made.
RunOutcome make_reference(const RunConfig& config, const StartingPose* start,
                          const std::filesystem::path& folder, const std::atomic<bool>* stop) {
  Experiment experiment;
  experiment.name = "references";
  const std::lock_guard turn(turn_for(run_folder(folder, experiment, config)));
  return execute_run(experiment, config, folder, {.stop = stop}, start);
}

// Over time with the energies of its own scene.
Course course_of(const RunConfig& config, const std::filesystem::path& file, bool over_time) {
  if (!over_time) return read_course(file);
  const Scene scene = build_scene(config);
  return read_course(file, &scene);
}

}  // namespace

std::map<std::string, double> errors_between(const Course& run, const Course& reference,
                                             const Comparing& comparing) {
  const PoseComparison compare(run.rest, reference.rest, comparing);
  if (!comparing.over_time) return compare(run.poses.back(), reference.poses.back());
  std::vector<std::map<std::string, double>> frames;
  for (const auto& [mine, other] : common_frames(run, reference)) {
    auto& frame = frames.emplace_back(compare(run.poses[mine], reference.poses[other]));
    if (comparing.energy_scale > 0)
      frame["energy"] =
          std::abs((run.energy[mine] - run.energy[0]) - (reference.energy[other] - reference.energy[0])) /
          comparing.energy_scale;
  }
  if (frames.empty())
    throw std::invalid_argument(
        "no recorded frame has the same time in both; /output/frames_per_second must suit every /solver/dt");
  return over_frames(frames);
}

Course read_course(const std::filesystem::path& file, const Scene* scene) {
  const RestRecord rest = read_rest(file);
  TriangleMesh mesh{.positions = as_rows(rest.positions), .triangles = {}, .texture_coordinates = {}};
  mesh.triangles = as_rows(rest.triangles);
  Course course{RestMesh(std::move(mesh)), read_metric(file, "time"), {}, {}};
  if (!scene) {
    course.time = {course.time.back()};
    course.poses = {as_rows(read_positions(file, -1))};
    return course;
  }
  course.energy = read_metric(file, "kinetic_energy");
  for (std::size_t f = 0; f < course.time.size(); ++f) {
    course.poses.push_back(as_rows(read_positions(file, static_cast<std::int64_t>(f))));
    course.energy[f] += potential_energy(*scene, course.poses[f]);
  }
  return course;
}

Accuracy::Accuracy(const RunConfig& config, const Scene& scene)
    : config_(config),
      scene_(scene),
      settings_(config.section("/accuracy")),
      asked_for_(settings_.has("solver") || settings_.has("physical")),
      over_time_(settings_.boolean("over_time")) {}

void Accuracy::keep(const Frame& frame, double kinetic_energy) {
  if (!over_time_) return;
  time_.push_back(frame.time);
  poses_.push_back(as_rows(frame.positions));
  kinetic_energy_.push_back(kinetic_energy);
}

Course Accuracy::course_to(const Positions& end) const {
  if (!over_time_) return {scene_.rest, {0}, {end}, {}};
  Course course{scene_.rest, time_, poses_, kinetic_energy_};
  for (std::size_t f = 0; f < poses_.size(); ++f) course.energy[f] += potential_energy(scene_, poses_[f]);
  return course;
}

Comparing Accuracy::comparing(Against against) const {
  return {.align = named<AlignBy>(settings_.text("align"), align_by_names),
          .centre = middle_of_pins(scene_),
          .down = scene_.down,
          .over_time = over_time_,
          .inextensible = against == Against::physical,
          .energy_scale = over_time_ ? energy_scale(scene_) : 0};
}

Accuracy::Result Accuracy::against_references(const std::string& id, const Positions& end,
                                              const std::filesystem::path& folder,
                                              const std::atomic<bool>* stop) const {
  Result result;
  const Course run = course_to(end);
  for (const Against against : references) {
    const Comparing how = comparing(against);
    const std::string prefix = fmt::format("error_{}_", name_of(against));
    const std::optional<Course> reference =
        course_of_reference(id, end, folder, stop, against, false, result);
    if (!reference) continue;
    try {
      for (const auto& [name, value] : errors_between(run, *reference, how))
        result.summary[prefix + name] = value;
      const std::optional<Course> coarser = course_of_reference(id, end, folder, stop, against, true, result);
      if (coarser)
        result.summary[prefix + "reference_gap"] = errors_between(*coarser, *reference, how).at("rms");
    } catch (const std::invalid_argument& error) {
      result.messages.push_back(fmt::format("/accuracy/{}: {}", name_of(against), error.what()));
    }
  }
  return result;
}

// Nothing where there is none to compare with; the result says why.
std::optional<Course> Accuracy::course_of_reference(const std::string& id, const Positions& end,
                                                    const std::filesystem::path& folder,
                                                    const std::atomic<bool>* stop, Against against,
                                                    bool coarser, Result& result) const {
  const auto tell = [&](std::string_view what) {
    result.messages.push_back(
        fmt::format("/accuracy/{}{}: {}", name_of(against), coarser ? "_coarser" : "", what));
  };
  try {
    std::optional<RunConfig> config = reference_of(config_, against, coarser);
    if (!config) return std::nullopt;
    const bool starts_here = settings_.boolean("start_from_end");
    if (starts_here) config->starts_at_end_of = id;
    const StartingPose start{scene_.rest, end};
    const RunOutcome outcome = make_reference(*config, starts_here ? &start : nullptr, folder, stop);
    result.stopped |= outcome.status == RunStatus::interrupted;
    if (outcome.status == RunStatus::diverged) tell("the reference " + outcome.message);
    if (outcome.status == RunStatus::implausible) tell("the reference is " + outcome.message);
    if (!is_whole(outcome.status)) return std::nullopt;
    if (outcome.summary.contains("unbalanced") && !outcome.summary.contains("settled_at")) {
      tell("of the reference, " + outcome.message);
      const char* which = coarser ? "coarser_unbalanced" : "unbalanced";
      result.summary[fmt::format("error_{}_{}", name_of(against), which)] = outcome.summary.at("unbalanced");
    }
    return course_of(*config, outcome.file, over_time_);
  } catch (const RunFileError&) {  // of the disk, or the memory: a later try may do better
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    tell(error.what());
    return std::nullopt;
  }
}

}  // namespace bendlab
