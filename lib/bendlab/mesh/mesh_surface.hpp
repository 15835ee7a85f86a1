// The surface of an obstacle: finds nearest points, crossings with a segment, and triangles in a box, by
// CGAL's AABB tree. Only one thread at a time may use an object.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Barycentric weights of the point of the triangle a, b, c that is nearest to x. If that point is on an
/// edge, the weight of the opposite corner is exactly 0 (Ericson 2005, §5.1.5).
Vector3 nearest_weights(const Vector3& x, const Vector3& a, const Vector3& b, const Vector3& c);

std::string cgal_version();

class MeshSurface {
 public:
  struct Nearest {
    Vector3 point;    ///< nearest point of the mesh, m
    Vector3 normal;   ///< unit normal of the face, edge or corner there; angle-weighted at corners
    double distance;  ///< m, at least 0
    bool inside;      ///< x is behind the surface (Bærentzen & Aanæs 2005); false for an open mesh
  };

  struct Crossing {
    Vector3 point;    ///< m
    Vector3 normal;   ///< unit normal of the triangle, towards the side that the segment comes from
    bool from_front;  ///< whether the triangle's own normal points to that side
  };

  /// An edge so sharp that cloth can touch the edge without touching a face.
  struct Ridge {
    std::array<int, 2> corners;
    Vector3 normal;  ///< unit, mean of the normals of the edge's triangles
  };

  /// Expects a mesh in which diagnose() finds no problem, for example from read_mesh() (files.hpp). If the
  /// normals of a closed mesh point inwards, all triangles are reversed.
  explicit MeshSurface(TriangleMesh mesh);
  ~MeshSurface();
  MeshSurface(const MeshSurface&) = delete;
  MeshSurface& operator=(const MeshSurface&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  /// Whether every edge has two triangles, so that the mesh has an inside.
  bool closed() const { return closed_; }

  /// The nearest point. If x is not finite, the distance is infinite, so that callers find no contact.
  Nearest nearest(const Vector3& x) const;
  /// Where the segment first meets the mesh.
  std::optional<Crossing> first_crossing(const Vector3& from, const Vector3& to) const;
  /// Appends the triangles that intersect the box to `triangles`, in ascending order.
  void triangles_in_box(const Vector3& low, const Vector3& high, std::vector<int>& triangles) const;

  Vector3 corner(int vertex) const { return mesh_.positions.row(vertex).transpose(); }
  const Vector3& corner_normal(int vertex) const { return corner_normals_[static_cast<std::size_t>(vertex)]; }
  const std::vector<Ridge>& ridges() const { return ridges_; }
  /// The index in ridges(), or -1 if there is none, for the edges 0 to 1, 1 to 2 and 2 to 0 of a triangle.
  const std::array<int, 3>& ridges_of(int triangle) const {
    return ridges_of_[static_cast<std::size_t>(triangle)];
  }
  /// Whether a ridge ends at the vertex, so that cloth may touch only the vertex.
  bool is_pointed(int vertex) const { return pointed_[static_cast<std::size_t>(vertex)] != 0; }

 private:
  struct Tree;

  void find_normals();
  void find_ridges();

  TriangleMesh mesh_;
  bool closed_ = true;
  std::vector<Vector3> face_normals_, corner_normals_;
  std::vector<std::array<Vector3, 3>> edge_normals_;  // #T: edges 0 to 1, 1 to 2, 2 to 0
  std::vector<Ridge> ridges_;
  std::vector<std::array<int, 3>> ridges_of_;
  std::vector<char> pointed_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace bendlab
