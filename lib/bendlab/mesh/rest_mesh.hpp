// The rest state of a cloth: the mesh, and its edges, one-rings, hinges, areas and size.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

///        opposite[0]
///           /  \          An interior edge and its two triangles.
///   edge[0] ---- edge[1]
///           \  /
///        opposite[1]
struct Hinge {
  std::array<int, 2> edge;
  std::array<int, 2> opposite;
};

/// The neighbours of all vertices in one array. The neighbours of v are targets[offsets[v]] to
/// targets[offsets[v + 1] - 1], in ascending order.
struct Adjacency {
  std::vector<int> offsets;  ///< #V + 1
  std::vector<int> targets;

  std::span<const int> operator[](int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(targets).subspan(static_cast<std::size_t>(offsets[v]),
                                      static_cast<std::size_t>(offsets[v + 1] - offsets[v]));
  }
};

class RestMesh {
 public:
  /// Expects indices in range and finite positions, as in the meshes of read_mesh() (files.hpp). An edge with
  /// more than two triangles gives no hinge.
  explicit RestMesh(TriangleMesh mesh);
  /// A mesh whose places (pins.hpp) have their names in another shape (#V by 3), for example flat.
  RestMesh(TriangleMesh mesh, Positions named);

  const TriangleMesh& mesh() const { return mesh_; }
  const Positions& positions() const { return mesh_.positions; }
  /// #V by 3, m: the shape in which places have their names; usually positions().
  const Positions& named_positions() const { return named_.rows() > 0 ? named_ : mesh_.positions; }
  const Triangles& triangles() const { return mesh_.triangles; }
  const Edges& edges() const { return edges_; }
  const Adjacency& one_ring() const { return one_ring_; }
  const std::vector<Hinge>& hinges() const { return hinges_; }  ///< in the order of their edges
  const std::vector<double>& areas() const { return areas_; }   ///< #T, m²

  int vertex_count() const { return static_cast<int>(mesh_.positions.rows()); }
  int triangle_count() const { return static_cast<int>(mesh_.triangles.rows()); }

  Vector3 box_min() const { return box_min_; }
  Vector3 box_max() const { return box_max_; }
  Vector3 centre() const { return 0.5 * (box_min_ + box_max_); }
  double size() const { return (box_max_ - box_min_).norm(); }   ///< diagonal of the rest box, m
  double mean_edge_length() const { return mean_edge_length_; }  ///< m
  Vector3 position(int vertex) const { return mesh_.positions.row(vertex).transpose(); }

 private:
  TriangleMesh mesh_;
  Positions named_;
  Edges edges_;
  Adjacency one_ring_;
  std::vector<Hinge> hinges_;
  std::vector<double> areas_;
  Vector3 box_min_, box_max_;
  double mean_edge_length_ = 0;
};

}  // namespace bendlab
