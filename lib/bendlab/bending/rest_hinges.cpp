#include "bendlab/bending/rest_hinges.hpp"

#include <algorithm>
#include <cmath>

#include "bendlab/mesh/bad_triangles.hpp"

namespace bendlab {
namespace {

// The corners of degenerate triangles, each triple in ascending order. These triangles have no angle to their
// neighbours.
std::vector<std::array<int, 3>> degenerate_corners(const RestMesh& rest) {
  const std::vector<char> degenerate = triangles_without_area(rest.mesh());
  std::vector<std::array<int, 3>> corners;
  for (int t = 0; t < rest.triangle_count(); ++t)
    if (degenerate[static_cast<std::size_t>(t)] != 0) {
      const auto row = rest.triangles().row(t);
      std::ranges::sort(corners.emplace_back(std::array{row(0), row(1), row(2)}));
    }
  std::ranges::sort(corners);
  return corners;
}

}  // namespace

std::vector<RestHinge> rest_hinges(const RestMesh& rest, const Pins& pins, bool is_flat) {
  std::vector<RestHinge> hinges;
  const std::vector<std::array<int, 3>> degenerate = degenerate_corners(rest);
  const auto bad = [&](const Hinge& hinge, int opposite) {
    std::array<int, 3> corners = {hinge.edge[0], hinge.edge[1], opposite};
    std::ranges::sort(corners);
    return std::ranges::binary_search(degenerate, corners);
  };
  for (const Hinge& hinge : rest.hinges()) {
    if (!degenerate.empty() && (bad(hinge, hinge.opposite[0]) || bad(hinge, hinge.opposite[1]))) continue;
    RestHinge h{.vertices = {hinge.edge[0], hinge.edge[1], hinge.opposite[0], hinge.opposite[1]}};
    bool free = false;
    for (std::size_t i = 0; i < 4; ++i) {
      h.position[i] = rest.position(h.vertices[i]);
      free |= !pins.pinned(h.vertices[i]);
    }
    h.edge = (h.position[1] - h.position[0]).norm();
    if (!free || !(h.edge > 0)) continue;
    const ConstraintValue<double, 4> angle = hinge_angle(h.position, 1 / h.edge);
    if (!angle.defined) continue;
    h.angle = is_flat ? 0 : angle.value;
    for (const std::size_t i : {2u, 3u})
      h.area += 0.5 * (h.position[i] - h.position[0]).cross(h.position[i] - h.position[1]).norm();
    hinges.push_back(h);
  }
  return hinges;
}

ElementList<HingeAngle> angle_constraints(const std::vector<RestHinge>& hinges, HingeAngle::Law law,
                                          const std::function<double(const RestHinge&)>& softness) {
  ElementList<HingeAngle> list;
  list.law = law;
  for (const RestHinge& h : hinges) {
    list.vertices.push_back(h.vertices);
    list.rest.push_back({h.angle, 1 / h.edge, std::sin(h.angle / 2), std::cos(h.angle / 2)});
    list.softness.push_back(softness(h));
  }
  return list;
}

}  // namespace bendlab
