#include "bendlab/scene/pose_transfer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "bendlab/bending/triangle_finder.hpp"
#include "bendlab/bending/unit_bend.hpp"

namespace bendlab {
namespace {

Eigen::AlignedBox<double, 2> box_of(const std::vector<Vector2>& points) {
  Eigen::AlignedBox<double, 2> box;
  for (const Vector2& point : points) box.extend(point);
  return box;
}

// Finds the triangle of a flat sheet that contains a point, or a triangle near a point just outside.
class Sheet {
 public:
  Sheet(const RestMesh& rest, const std::vector<Vector2>& plane)
      : plane_(plane), edge_(rest.mean_edge_length()), find_(rest.triangles(), plane, edge_) {
    for (const Vector2& p : plane_) centre_ += p / static_cast<double>(plane_.size());
  }

  std::optional<std::array<int, 3>> triangle_at(const Vector2& point) const {
    for (const double inwards : {0.0, 0.5, 1.0, 2.0})
      if (const auto place = find_(point + inwards * edge_ * (centre_ - point).normalized()))
        return place->corner;
    return std::nullopt;
  }

  // The barycentric weights of `point`, which may lie outside the triangle.
  std::array<double, 3> weights(const std::array<int, 3>& corner, const Vector2& point) const {
    const auto flat = [&](std::size_t c) { return plane_[static_cast<std::size_t>(corner[c])]; };
    Eigen::Matrix2d sides;
    sides << flat(1) - flat(0), flat(2) - flat(0);
    const Vector2 along = sides.inverse() * (point - flat(0));
    return {1 - along(0) - along(1), along(0), along(1)};
  }

 private:
  const std::vector<Vector2>& plane_;
  double edge_;
  TriangleFinder find_;
  Vector2 centre_ = Vector2::Zero();
};

// Refuses two sheets of different size. (A vertex of `to` outside the sheet `from` is an error already, but a
// sheet `from` that is larger on all sides is not.)
void check_outline(const RestMesh& from, const std::vector<Vector2>& from_plane, const RestMesh& to,
                   const std::vector<Vector2>& to_plane) {
  const Eigen::AlignedBox<double, 2> from_box = box_of(from_plane), to_box = box_of(to_plane);
  const double allowed = 2 * std::max(from.mean_edge_length(), to.mean_edge_length());
  const double apart = std::max((from_box.min() - to_box.min()).cwiseAbs().maxCoeff(),
                                (from_box.max() - to_box.max()).cwiseAbs().maxCoeff());
  if (apart > allowed)
    throw std::invalid_argument(
        fmt::format("the two meshes have different outlines, {:.3g} m apart, but at most two edge lengths "
                    "({:.3g} m) are allowed: give both meshes the same extent",
                    apart, allowed));
}

}  // namespace

bool same_rest_positions(const RestMesh& first, const RestMesh& second) {
  return first.vertex_count() == second.vertex_count() && first.positions() == second.positions();
}

PoseTransfer::PoseTransfer(const RestMesh& from, const RestMesh& to) {
  if (same_rest_positions(from, to)) return;
  const std::vector<Vector2> from_plane = plane_coordinates(from), points = plane_coordinates(to);
  if (from_plane.empty() || points.empty())
    throw std::invalid_argument(
        "the two runs have different meshes, and at least one mesh is not flat: use the same mesh for both "
        "runs, or two meshes of one flat sheet");
  const Sheet sheet(from, from_plane);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto corner = sheet.triangle_at(points[v]);
    if (!corner)
      throw std::invalid_argument(fmt::format(
          "vertex {} lies outside the other mesh: give both meshes the same extent and position", v));
    places_.push_back({*corner, sheet.weights(*corner, points[v])});
  }
  check_outline(from, from_plane, to, points);
}

Positions PoseTransfer::operator()(const Positions& pose) const {
  if (places_.empty()) return pose;
  Positions result(static_cast<Eigen::Index>(places_.size()), 3);
  for (std::size_t v = 0; v < places_.size(); ++v) {
    const auto& [corner, weight] = places_[v];
    result.row(static_cast<Eigen::Index>(v)) =
        weight[0] * pose.row(corner[0]) + weight[1] * pose.row(corner[1]) + weight[2] * pose.row(corner[2]);
  }
  return result;
}

}  // namespace bendlab
