#include "bendlab/mesh/rest_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace bendlab {
namespace {

struct DirectedEdge {
  int low, high;  // the edge's vertices, low < high
  int opposite;   // the triangle's third vertex
};

std::vector<DirectedEdge> sorted_half_edges(const Triangles& triangles) {
  std::vector<DirectedEdge> half_edges;
  half_edges.reserve(static_cast<std::size_t>(3 * triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = triangles(t, c), b = triangles(t, (c + 1) % 3);
      half_edges.push_back({std::min(a, b), std::max(a, b), triangles(t, (c + 2) % 3)});
    }
  std::stable_sort(half_edges.begin(), half_edges.end(), [](const DirectedEdge& l, const DirectedEdge& r) {
    return l.low != r.low ? l.low < r.low : l.high < r.high;
  });
  return half_edges;
}

Adjacency adjacency_of(const Edges& edges, int vertex_count) {
  Adjacency rings;
  rings.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (Eigen::Index e = 0; e < edges.rows(); ++e)
    for (int end = 0; end < 2; ++end) ++rings.offsets[static_cast<std::size_t>(edges(e, end)) + 1];
  for (std::size_t v = 0; v + 1 < rings.offsets.size(); ++v) rings.offsets[v + 1] += rings.offsets[v];
  rings.targets.resize(static_cast<std::size_t>(2 * edges.rows()));
  std::vector<int> next(rings.offsets.begin(), rings.offsets.end() - 1);
  // Edges are sorted by (low, high): a vertex first meets its lower neighbours, then its higher ones,
  // ascending.
  for (int end = 1; end >= 0; --end)
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
      rings.targets[static_cast<std::size_t>(next[static_cast<std::size_t>(edges(e, end))]++)] =
          edges(e, 1 - end);
  return rings;
}

}  // namespace

RestMesh::RestMesh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  const std::vector<DirectedEdge> half_edges = sorted_half_edges(mesh_.triangles);
  std::vector<std::array<int, 2>> edges;
  for (std::size_t first = 0, last; first < half_edges.size(); first = last) {
    last = first + 1;
    const DirectedEdge& h = half_edges[first];
    while (last < half_edges.size() && half_edges[last].low == h.low && half_edges[last].high == h.high)
      ++last;
    edges.push_back({h.low, h.high});
    if (last - first == 2 && h.opposite != half_edges[first + 1].opposite)
      hinges_.push_back({{h.low, h.high}, {h.opposite, half_edges[first + 1].opposite}});
  }
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
