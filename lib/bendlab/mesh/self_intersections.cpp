#include "bendlab/mesh/self_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace bendlab {
namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

Mesh surface(const Positions& positions, const Triangles& triangles) {
  Mesh mesh;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    mesh.add_vertex({positions(v, 0), positions(v, 1), positions(v, 2)});
  const auto corner = [&](Eigen::Index t, Eigen::Index c) {
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(triangles(t, c)));
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (mesh.add_face(corner(t, 0), corner(t, 1), corner(t, 2)) == Mesh::null_face())
      throw std::invalid_argument(fmt::format(
          "self_intersections: triangle {} cannot be part of an oriented manifold mesh; run `bendlab mesh "
          "FILE` to see the problems of the mesh",
          t));
  return mesh;
}

}  // namespace

std::vector<std::array<int, 2>> self_intersections(const Positions& positions, const Triangles& triangles) {
  if (!positions.allFinite())
    throw std::invalid_argument(
        "self_intersections: a position is not finite; use a frame from before the cloth diverged");
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> face_pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface(positions, triangles),
                                                    std::back_inserter(face_pairs));
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [a, b] : face_pairs) {
    const auto [first, second] = std::minmax(a, b);
    pairs.push_back({static_cast<int>(first.idx()), static_cast<int>(second.idx())});
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace bendlab
