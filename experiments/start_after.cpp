#include "experiments/start_after.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <stdexcept>

#include "bendlab/bending/triangle_finder.hpp"
#include "bendlab/bending/unit_bend.hpp"

namespace bendlab {
namespace {

constexpr const char* pointer = "/initial/after";

// Where the run ends.
Positions end_of(const RunConfig& config, const Scene& scene, const std::atomic<bool>* stop) {
  const std::int64_t steps = step_count(config);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (std::int64_t step = 0; step < steps && !simulation->settled(); ++step) {
    if (stop && stop->load(std::memory_order_relaxed)) break;
    if (!simulation->step())
      throw std::runtime_error(fmt::format("{}: the run before this one diverged at t = {:.6g} s", pointer,
                                           simulation->divergence().time));
  }
  return simulation->positions();
}

// `pose` of one mesh of a flat sheet at the vertices of another; linearly on beyond its outline, which may differ by an
// edge's length.
class OtherMesh {
 public:
  OtherMesh(const RestMesh& rest, const Positions& pose)
      : rest_(rest), pose_(pose), plane_(plane_coordinates(rest)), find_(rest.triangles(), plane_, edge()) {
    for (const Vector2& p : plane_) centre_ += p / static_cast<double>(plane_.size());
  }

  std::optional<Eigen::RowVector3d> at(const Vector2& point) const {
    for (const double inwards : {0.0, 0.5, 1.0, 2.0})
      if (const auto place = find_(point + inwards * edge() * (centre_ - point).normalized()))
        return on_plane_of(place->corner, point);
    return std::nullopt;
  }

 private:
  double edge() const { return rest_.mean_edge_length(); }

  Eigen::RowVector3d on_plane_of(const std::array<int, 3>& corner, const Vector2& point) const {
    const auto flat = [&](std::size_t c) { return plane_[static_cast<std::size_t>(corner[c])]; };
    Eigen::Matrix2d sides;
    sides << flat(1) - flat(0), flat(2) - flat(0);
    const Vector2 along = sides.inverse() * (point - flat(0));
    return pose_.row(corner[0]) + along(0) * (pose_.row(corner[1]) - pose_.row(corner[0])) +
           along(1) * (pose_.row(corner[2]) - pose_.row(corner[0]));
  }

  const RestMesh& rest_;
  const Positions& pose_;
  std::vector<Vector2> plane_;
  TriangleFinder find_;
  Vector2 centre_ = Vector2::Zero();
};

Positions interpolated(const Positions& pose, const RestMesh& from, const RestMesh& to) {
  const std::vector<Vector2> points = plane_coordinates(to);
  if (plane_coordinates(from).empty() || points.empty())
    throw ConfigError("initial pose", {{pointer, "another mesh can only be that of the same flat sheet"}});
  const OtherMesh other(from, pose);
  Positions result(to.vertex_count(), 3);
  for (int v = 0; v < to.vertex_count(); ++v) {
    const auto place = other.at(points[static_cast<std::size_t>(v)]);
    if (!place)
      throw ConfigError("initial pose",
                        {{pointer, fmt::format("vertex {} lies outside the sheet of the run before", v)}});
    result.row(v) = *place;
  }
  return result;
}

}  // namespace

std::int64_t step_count(const RunConfig& config) {
  constexpr double rounding = 1e-6;  // of a step: 1 s of 1/60 s is 60 steps, whatever the quotient rounds to
  const double duration = config.section("").number("duration"), dt = config.section("/solver").number("dt");
  return static_cast<std::int64_t>(std::ceil(duration / dt - rounding));
}

void start_after(const RunConfig& config, Scene& scene, const std::atomic<bool>* stop) {
  const std::optional<RunConfig> before = run_before(config);
  if (!before) return;
  Scene first = build_scene(*before);
  start_after(*before, first, stop);
  Positions pose = end_of(*before, first, stop);
  if (first.rest.positions() != scene.rest.positions()) pose = interpolated(pose, first.rest, scene.rest);
  for (int v = 0; v < scene.rest.vertex_count(); ++v)
    if (!scene.pins.pinned(v)) scene.input.positions.row(v) = pose.row(v);
  scene.input.settings.starts_near = true;
}

}  // namespace bendlab
