#include "bendlab/mesh/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace bendlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

}  // namespace

Triangles delaunay_triangles(std::span<const Vector2> points) {
  std::vector<std::pair<Kernel::Point_2, int>> indexed;
  indexed.reserve(points.size());
  for (const Vector2& p : points)
    indexed.emplace_back(Kernel::Point_2(p.x(), p.y()), static_cast<int>(indexed.size()));
  const Triangulation triangulation(indexed.begin(), indexed.end());

  std::vector<std::array<int, 3>> faces;  // sorted: CGAL does not document its order of faces
  for (const auto& face : triangulation.finite_face_handles()) {
    std::array<int, 3> corners = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());

  Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t t = 0; t < faces.size(); ++t)
    triangles.row(static_cast<Eigen::Index>(t)) << faces[t][0], faces[t][1], faces[t][2];
  return triangles;
}

}  // namespace bendlab
