// Triangles in their rest state with the folds at their edges, from which the models that bend triangles
// (constraints/face_bend.hpp) build their constraints.
#pragma once

#include <functional>
#include <vector>

#include "bendlab/bending/model.hpp"

namespace bendlab {

/// What the sheet is like at an edge of a triangle.
enum class EdgeSide {
  border,   ///< the sheet ends; or more than two triangles meet, or the neighbour has no area
  inside,   ///< a neighbour
  clamped,  ///< a neighbour whose vertices are all pinned, so that its normal does not turn
};

struct RestFace {
  int triangle;  ///< index in the mesh
  std::array<int, 3> vertices;
  std::array<int, 3> beyond;  ///< the vertex beyond edge i, which lies opposite vertices[i]; else vertices[i]
  std::array<int, 3> edge;    ///< index of edge i among all edges
  std::array<EdgeSide, 3> side;
  std::array<double, 3>
      turns;  ///< +1 or -1: the two triangles of an edge differ, unless one lies upside down
  std::array<double, 3> height;         ///< of the triangle above edge i, m
  std::array<double, 3> height_beyond;  ///< of the neighbour above edge i, m; 0 at a border
  std::array<Vector2, 3> inwards;       ///< t_i in coordinates of the triangle's plane, along x and y
  Vector3 x, y;                         ///< unit: along the triangle's first edge, and across it
  double area;                          ///< m²
};

/// All triangles that have an area, in the order of the mesh.
std::vector<RestFace> rest_faces(const RestMesh& rest, const Pins& pins);
/// The number of edges that RestFace::edge counts.
int edge_count(const std::vector<RestFace>& faces);

/// Elements of FaceBend, without directors, one for each triangle that has a free vertex or neighbour.
/// `share` is a_i of an inner edge, and `curvature` is c_i for edge i of a face, 1/m (see face_bend.hpp).
ElementList<FoldBend> fold_constraints(const BendingInput& input, FoldBend::Law law, double share,
                                       const std::function<double(const RestFace&, std::size_t)>& curvature);

/// U of face_bend.hpp for one triangle, in the order of its rest values. `curvature`: c_i of each edge. If
/// the sheet's rigidity depends on the direction, U has this rigidity divided by its mean.
std::array<double, 6> upper_factor(const RestFace& face, const std::array<double, 3>& curvature,
                                   const BendingInput& input);

}  // namespace bendlab
