// Errors of a run against the references in /accuracy. References are other runs, which are computed once and
// stored.
#include <fmt/format.h>

#include <new>
#include <optional>

#include "bendlab/scene/energy.hpp"
#include "bendlab/settings/names.hpp"
#include "experiments/config/references.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/measures/strip_doubts.hpp"
#include "experiments/measures/trajectory.hpp"

namespace bendlab {
namespace {

// The middle of the vertices that /pins names; without pins, the middle of the rest box.
Vector3 middle_of_pins(const BuiltScene& scene) {
  if (scene.pins.seeds.empty()) return scene.rest.centre();
  Vector3 sum = Vector3::Zero();
  for (const int seed : scene.pins.seeds) sum += scene.input.positions.row(seed).transpose();
  return sum / static_cast<double>(scene.pins.seeds.size());
}

// The last pose of a run. With over_time, all frames of the run, with their energies in the scene of
// `config`.
Trajectory trajectory_of(const RunConfig& config, const std::filesystem::path& file, bool over_time) {
  return over_time ? read_motion(file, build_scene(config.scene())) : read_last_pose(file);
}

class Errors final : public Measurement {
 public:
  Errors(const RunConfig& config, const BuiltScene& scene)
      : config_(config),
        scene_(scene),
        settings_(config.settings().accuracy),
        over_time_(settings_.over_time) {}

  void complete(const MeasuredFrame& frame, std::span<double>, std::span<std::vector<float>>) override {
    if (!over_time_) return;
    time_.push_back(frame.time());
    poses_.push_back(frame.positions());
    kinetic_energy_.push_back(frame.value("kinetic_energy"));
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (!is_whole(end.status)) return;
    const Positions last = end.simulation.positions();
    const Trajectory run = trajectory_to(last);
    for (const Against against : references) {
      const Comparing how = comparing(against);
      const std::string prefix = fmt::format("error_{}_", name_of(against));
      const std::optional<Trajectory> reference =
          trajectory_of_reference(end, last, against, false, findings);
      if (!reference) continue;
      try {
        for (const auto& [name, value] : errors_between(run, *reference, how))
          findings.summary[prefix + name] = value;
        const std::optional<Trajectory> coarser = trajectory_of_reference(end, last, against, true, findings);
        if (coarser)
          findings.summary[prefix + "reference_gap"] = errors_between(*coarser, *reference, how).at("rms");
      } catch (const std::invalid_argument& error) {
        findings.messages.push_back(fmt::format("/accuracy/{}: {}", name_of(against), error.what()));
      }
    }
  }

  void archive(Archive& state) override { state(time_, kinetic_energy_, poses_); }

 private:
  Trajectory trajectory_to(const Positions& end) const {
    if (!over_time_) return {scene_.rest, {0}, {end}, {}};
    Trajectory trajectory{scene_.rest, time_, poses_, kinetic_energy_};
    for (std::size_t f = 0; f < poses_.size(); ++f)
      trajectory.energy[f] += potential_energy(scene_, poses_[f]);
    return trajectory;
  }

  Comparing comparing(Against against) const {
    return {.align = settings_.align,
            .centre = middle_of_pins(scene_),
            .down = scene_.down,
            .over_time = over_time_,
            .inextensible = against == Against::physical,
            .energy_scale = over_time_ && !has_history(scene_.input) ? energy_scale(scene_) : 0};
  }

  // Nothing if there is no reference to compare with; a message in `findings` says why.
  std::optional<Trajectory> trajectory_of_reference(const RunEnd& end, const Positions& last, Against against,
                                                    bool coarser, Findings& findings) const {
    const auto add_message = [&](std::string_view text) {
      findings.messages.push_back(
          fmt::format("/accuracy/{}{}: {}", name_of(against), coarser ? "_coarser" : "", text));
    };
    try {
      std::optional<RunConfig> config = reference_of(config_, against, coarser);
      if (!config) return std::nullopt;
      const bool starts_here = settings_.start_from_end;
      if (starts_here) config->starts_at_end_of = end.id;
      const StartingPose start{scene_.rest, last};
      const OtherRun other = end.other_run(*config, starts_here ? &start : nullptr);
      findings.stopped |= other.status == RunStatus::interrupted;
      if (other.status == RunStatus::diverged) add_message("the reference " + other.message);
      if (other.status == RunStatus::implausible) add_message("the reference is " + other.message);
      if (!is_whole(other.status)) return std::nullopt;
      if (other.summary.contains("unbalanced") && !other.summary.contains("settled_at")) {
        add_message(fmt::format(
            "the reference found no equilibrium: its unbalanced forces are {:.2g} times its loads",
            other.summary.at("unbalanced")));
        const char* which = coarser ? "coarser_unbalanced" : "unbalanced";
        findings.summary[fmt::format("error_{}_{}", name_of(against), which)] =
            other.summary.at("unbalanced");
      }
      if (against == Against::physical && !over_time_)  // a strip in motion shows no stiffness
        if (const std::optional<std::string> doubt = doubtful_reference(*config, other.file)) {
          add_message("its run cannot serve as a reference: " + *doubt);
          return std::nullopt;
        }
      return trajectory_of(*config, other.file, over_time_);
    } catch (const RunFileError&) {  // an error of the disk or the memory: a later try may succeed
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      add_message(error.what());
      return std::nullopt;
    }
  }

  const RunConfig& config_;
  const BuiltScene& scene_;
  const Accuracy& settings_;
  bool over_time_;
  std::vector<double> time_, kinetic_energy_;  // of every recorded frame; only with over_time
  std::vector<Positions> poses_;               // the same
};

std::vector<Quantity> accuracy_quantities() {
  std::vector<Quantity> all;
  for (const Against against : references) {
    const std::string prefix = fmt::format("error_{}_", name_of(against));
    const auto add = [&](const std::string& name, const std::string& meaning) {
      all.push_back({prefix + name, "1", meaning});
      all.push_back(
          {prefix + name + "_worst", "1",
           "over time: the error of the worst frame; the metric without _worst is the mean over the frames"});
    };
    add("rms",
        "root mean square distance of the points from the points of the reference, weighted by area, in "
        "sizes of the mesh");
    add("largest", "the largest distance of a point from the point of the reference, in sizes of the mesh");
    add("hausdorff", "Hausdorff distance between the surfaces of run and reference, in sizes of the mesh");
    add("strain",
        against == Against::solver
            ? "root mean square of the difference between the Green strains of run and reference"
            : "root mean square of the run's own Green strain, because the stated cloth has no strain");
    add("energy",
        "over time: difference between run and reference in the gain of total energy since the start, as a "
        "share of the scene's energy scale; constraints with k have no elastic energy");
    all.push_back({prefix + "frames", "1", "over time: number of frames compared"});
    all.push_back({prefix + "reference_gap", "1",
                   "rms distance between the coarser reference and the reference: errors that are not much "
                   "larger than this distance are unreliable"});
    all.push_back({prefix + "unbalanced", "1",
                   "only if the reference found no equilibrium: the reference's unbalanced forces divided by "
                   "its loads"});
    all.push_back({prefix + "coarser_unbalanced", "1", "the same for the coarser reference"});
  }
  return all;
}

}  // namespace

namespace measure {
extern const Measure accuracy{
    .name = "accuracy",
    .summary =
        "errors against other runs (references): errors of the solver, and errors against the stated cloth",
    .cost =
        "the time of the references, each computed once for all runs that need it; over time, memory for the "
        "pose of every frame",
    .applies = [](const RunConfig& config,
                  const BuiltScene&) { return config.settings().accuracy.compares(); },
    .when = "if /accuracy names a reference",
    .gives = accuracy_quantities,
    .makes_runs = true,
    .begin = begun<Errors>};
}  // namespace measure
}  // namespace bendlab
