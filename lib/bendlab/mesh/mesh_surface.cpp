#include "bendlab/mesh/mesh_surface.hpp"

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>
#if __has_include(<CGAL/AABB_traits_3.h>)  // CGAL 6 renamed both headers
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Iterator = std::vector<Triangle>::const_iterator;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Iterator>;
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

Point point_of(const Vector3& x) {
  return {x.x(), x.y(), x.z()};
}

// rad. An edge that bends less is no ridge: cloth that touches such an edge also touches one of its faces.
constexpr double flat = 0.01;

// CGAL's predicates divide by zero if a coordinate or its square is not finite.
bool can_be_compared(const Vector3& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < 1e100;
}

}  // namespace

Vector3 nearest_weights(const Vector3& x, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double of_a = d3 * d6 - d5 * d4, from_b = d4 - d3, from_c = d5 - d6;
  if (of_a <= 0 && from_b >= 0 && from_c >= 0)
    return {0, from_c / (from_b + from_c), from_b / (from_b + from_c)};
  return Vector3(of_a, of_b, of_c) / (of_a + of_b + of_c);
}

struct MeshSurface::Tree {
  std::vector<Triangle> triangles;
  CGAL::AABB_tree<Traits> tree;

  explicit Tree(const TriangleMesh& mesh) {
    for (const auto& t : mesh.triangles.rowwise()) {
      const auto corner = [&](Eigen::Index i) { return point_of(mesh.positions.row(t(i)).transpose()); };
      triangles.emplace_back(corner(0), corner(1), corner(2));
    }
    tree.insert(triangles.cbegin(), triangles.cend());
    tree.build();
    tree.accelerate_distance_queries();
  }

  int index(Iterator triangle) const { return static_cast<int>(triangle - triangles.cbegin()); }

  template <class Query>
  std::vector<int> intersected(const Query& query) const {
    std::vector<Iterator> primitives;
    tree.all_intersected_primitives(query, std::back_inserter(primitives));
    std::vector<int> indices;
    for (const Iterator& triangle : primitives) indices.push_back(index(triangle));
    std::ranges::sort(indices);
    return indices;
  }
};

std::string cgal_version() {
  return CGAL_VERSION_STR;
}

MeshSurface::MeshSurface(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  double volume = 0;  // times six; negative if the normals of a closed mesh point inwards
  for (const auto& t : mesh_.triangles.rowwise())
    volume += (corner(t(0)) - corner(0)).dot((corner(t(1)) - corner(0)).cross(corner(t(2)) - corner(0)));
  for_each_edge(half_edges(mesh_.triangles),
                [&](std::span<const HalfEdge<int>> sides) { closed_ &= sides.size() == 2; });
  if (closed_ && volume < 0) mesh_.triangles.col(1).swap(mesh_.triangles.col(2));
  find_normals();
  find_ridges();
  tree_ = std::make_unique<Tree>(mesh_);
}

MeshSurface::~MeshSurface() = default;

// Normals at corners are weighted by angles, so the sign of (x - nearest) · normal tells on which side x is.
void MeshSurface::find_normals() {
  corner_normals_.assign(static_cast<std::size_t>(mesh_.vertex_count()), Vector3::Zero());
  for (const auto& t : mesh_.triangles.rowwise()) {
    const std::array<Vector3, 3> x = {corner(t(0)), corner(t(1)), corner(t(2))};
    const Vector3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    face_normals_.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 to_next = x[(i + 1) % 3] - x[i], to_previous = x[(i + 2) % 3] - x[i];
      corner_normals_[static_cast<std::size_t>(t(static_cast<Eigen::Index>(i)))] +=
          std::atan2(to_next.cross(to_previous).norm(), to_next.dot(to_previous)) * normal;
    }
  }
  for (Vector3& normal : corner_normals_) normal.normalize();
  edge_normals_.resize(face_normals_.size());
  for_each_edge(half_edges(mesh_.triangles), [&](std::span<const HalfEdge<int>> sides) {
    Vector3 sum = Vector3::Zero();
    for (const HalfEdge<int>& side : sides) sum += face_normals_[static_cast<std::size_t>(side.triangle())];
    for (const HalfEdge<int>& side : sides)
      edge_normals_[static_cast<std::size_t>(side.triangle())][static_cast<std::size_t>(side.corner())] =
          sum.normalized();
  });
}

// Ridges are convex edges. In an open mesh, which has no outside, all bent edges and boundary edges are
// ridges.
void MeshSurface::find_ridges() {
  ridges_of_.assign(static_cast<std::size_t>(mesh_.triangle_count()), {-1, -1, -1});
  pointed_.assign(static_cast<std::size_t>(mesh_.vertex_count()), 0);
  for_each_edge(half_edges(mesh_.triangles), [&](std::span<const HalfEdge<int>> sides) {
    const auto index = [](int i) { return static_cast<std::size_t>(i); };
    const int low = sides[0].low, high = sides[0].high;
    if (sides.size() == 2) {
      const Vector3 &first = face_normals_[index(sides[0].triangle())],
                    &second = face_normals_[index(sides[1].triangle())];
      const int opposite = mesh_.triangles(sides[1].triangle(), (sides[1].corner() + 2) % 3);
      const bool bent = first.cross(second).norm() > flat || first.dot(second) < 0;
      const bool concave = first.dot(corner(opposite) - corner(low)) > 0;
      if (!bent || (closed_ && concave)) return;
    }
    for (const HalfEdge<int>& side : sides)
      ridges_of_[index(side.triangle())][index(side.corner())] = static_cast<int>(ridges_.size());
    ridges_.push_back({{low, high}, edge_normals_[index(sides[0].triangle())][index(sides[0].corner())]});
    pointed_[index(low)] = pointed_[index(high)] = 1;
  });
}

MeshSurface::Nearest MeshSurface::nearest(const Vector3& x) const {
  if (!can_be_compared(x))
    return {.point = corner(mesh_.triangles(0, 0)),
            .normal = face_normals_.front(),
            .distance = std::numeric_limits<double>::infinity(),
            .inside = false};
  const int triangle = tree_->index(tree_->tree.closest_point_and_primitive(point_of(x)).second);
  const auto at = static_cast<std::size_t>(triangle);
  const std::array<int, 3> corners = {mesh_.triangles(triangle, 0), mesh_.triangles(triangle, 1),
                                      mesh_.triangles(triangle, 2)};
  const Vector3 w = nearest_weights(x, corner(corners[0]), corner(corners[1]), corner(corners[2]));
  Nearest result;
  result.point = w(0) * corner(corners[0]) + w(1) * corner(corners[1]) + w(2) * corner(corners[2]);
  result.normal = face_normals_[at];
  for (int i = 0; i < 3; ++i) {
    if (w((i + 2) % 3) == 0) result.normal = edge_normals_[at][static_cast<std::size_t>(i)];
  }
  for (int i = 0; i < 3; ++i)
    if (w(i) == 1)
      result.normal = corner_normals_[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
  result.distance = (x - result.point).norm();
  result.inside = closed_ && (x - result.point).dot(result.normal) < 0;
  return result;
}

std::optional<MeshSurface::Crossing> MeshSurface::first_crossing(const Vector3& from,
                                                                 const Vector3& to) const {
  if (from == to || !can_be_compared(from) || !can_be_compared(to)) return std::nullopt;
  std::optional<Crossing> first;
  double earliest = 2;
  for (const int t : tree_->intersected(Kernel::Segment_3(point_of(from), point_of(to)))) {
    const Vector3& normal = face_normals_[static_cast<std::size_t>(t)];
    const double height = normal.dot(from - corner(mesh_.triangles(t, 0))), fall = normal.dot(from - to);
    if (fall == 0) continue;  // parallel to this triangle: the segment crosses another triangle
    if (const double s = std::clamp(height / fall, 0.0, 1.0); s < earliest) {
      earliest = s;
      first = Crossing{from + s * (to - from), fall > 0 ? normal : Vector3(-normal), fall > 0};
    }
  }
  return first;
}

void MeshSurface::triangles_in_box(const Vector3& low, const Vector3& high,
                                   std::vector<int>& triangles) const {
  if (!can_be_compared(low) || !can_be_compared(high)) return;
  const std::vector<int> in_box =
      tree_->intersected(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
  triangles.insert(triangles.end(), in_box.begin(), in_box.end());
}

}  // namespace bendlab
