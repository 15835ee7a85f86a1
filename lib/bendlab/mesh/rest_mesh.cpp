#include "bendlab/mesh/rest_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

Adjacency adjacency_of(const Edges& edges, int vertex_count) {
  Adjacency rings;
  rings.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (Eigen::Index e = 0; e < edges.rows(); ++e)
    for (int end = 0; end < 2; ++end) ++rings.offsets[static_cast<std::size_t>(edges(e, end)) + 1];
  for (std::size_t v = 0; v + 1 < rings.offsets.size(); ++v) rings.offsets[v + 1] += rings.offsets[v];
  rings.targets.resize(static_cast<std::size_t>(2 * edges.rows()));
  std::vector<int> next(rings.offsets.begin(), rings.offsets.end() - 1);
  // Edges are sorted by (lower end, higher end). The first pass adds the lower neighbours of each vertex, the
  // second pass the higher neighbours, so the neighbours are in ascending order.
  for (int end = 1; end >= 0; --end)
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
      rings.targets[static_cast<std::size_t>(next[static_cast<std::size_t>(edges(e, end))]++)] =
          edges(e, 1 - end);
  return rings;
}

}  // namespace

RestMesh::RestMesh(TriangleMesh mesh, Positions named) : RestMesh(std::move(mesh)) {
  named_ = std::move(named);
}

RestMesh::RestMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  std::vector<std::array<int, 2>> edges;
  const auto opposite = [&](const HalfEdge<int>& side) {
    return triangles()(side.triangle(), (side.corner() + 2) % 3);
  };
  for_each_edge(half_edges(mesh_.triangles), [&](std::span<const HalfEdge<int>> sides) {
    const std::array edge = {sides[0].low, sides[0].high};
    edges.push_back(edge);
    if (sides.size() == 2 && opposite(sides[0]) != opposite(sides[1]))
      hinges_.push_back({edge, {opposite(sides[0]), opposite(sides[1])}});
  });
  edges_.resize(static_cast<Eigen::Index>(edges.size()), 2);
  double length = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    edges_.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1];
    length += (position(edges[e][0]) - position(edges[e][1])).norm();
  }
  mean_edge_length_ = edges.empty() ? 0 : length / static_cast<double>(edges.size());
  one_ring_ = adjacency_of(edges_, vertex_count());

  areas_.reserve(static_cast<std::size_t>(triangle_count()));
  for (int t = 0; t < triangle_count(); ++t) {
    const Vector3 p0 = position(triangles()(t, 0));
    areas_.push_back(0.5 * (position(triangles()(t, 1)) - p0).cross(position(triangles()(t, 2)) - p0).norm());
  }
  box_min_ = mesh_.positions.colwise().minCoeff().transpose();
  box_max_ = mesh_.positions.colwise().maxCoeff().transpose();
}

}  // namespace bendlab
