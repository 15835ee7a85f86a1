#include "experiments/measures/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bendlab/constraints/build.hpp"
#include "bendlab/metrics/alignment.hpp"
#include "bendlab/metrics/shape_error.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/pose_transfer.hpp"

namespace bendlab {
namespace {

// Pairs of frames that have the same time except for rounding. Leaves out the start, where the poses are
// equal.
std::vector<std::array<std::size_t, 2>> common_frames(const Trajectory& run, const Trajectory& reference) {
  constexpr double rounding = 1e-6;  // s, of a sum of thousands of time steps
  std::vector<std::array<std::size_t, 2>> pairs;
  std::size_t other = 0;
  for (std::size_t f = 0; f < run.time.size(); ++f) {
    while (other + 1 < reference.time.size() && reference.time[other] < run.time[f] - rounding) ++other;
    if (run.time[f] > rounding && std::abs(reference.time[other] - run.time[f]) <= rounding)
      pairs.push_back({f, other});
  }
  return pairs;
}

// Compares single poses. The constructor computes the values that depend only on the meshes.
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

// The mean and the worst value of every error over the frames.
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

RestMesh rest_of(const std::filesystem::path& file) {
  const RestRecord rest = read_rest(file);
  TriangleMesh mesh{.positions = as_rows(rest.positions), .triangles = {}, .texture_coordinates = {}};
  mesh.triangles = as_rows(rest.triangles);
  return RestMesh(std::move(mesh));
}

}  // namespace

std::map<std::string, double> errors_between(const Trajectory& run, const Trajectory& reference,
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
        "no recorded frame has the same time in both runs; choose an /output/frames_per_second whose frames "
        "fall on steps of both runs");
  return over_frames(frames);
}

Trajectory read_last_pose(const std::filesystem::path& file) {
  Trajectory trajectory{rest_of(file), {read_metric(file, "time").back()}, {}, {}};
  trajectory.poses = {as_rows(read_positions(file, -1))};
  return trajectory;
}

Trajectory read_motion(const std::filesystem::path& file) {
  Trajectory trajectory{rest_of(file), read_metric(file, "time"), {}, {}};
  for (std::size_t f = 0; f < trajectory.time.size(); ++f)
    trajectory.poses.push_back(as_rows(read_positions(file, static_cast<std::int64_t>(f))));
  return trajectory;
}

Trajectory read_motion(const std::filesystem::path& file, const BuiltScene& scene) {
  Trajectory trajectory = read_motion(file);
  trajectory.energy = read_metric(file, "kinetic_energy");
  for (std::size_t f = 0; f < trajectory.time.size(); ++f)
    trajectory.energy[f] += potential_energy(scene, trajectory.poses[f]);
  return trajectory;
}

}  // namespace bendlab
