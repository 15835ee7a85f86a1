// A triangle mesh as a surface to keep away from: nearest points with their side, crossings, what lies in a
// box. Queries go through CGAL's AABB tree; the same object may be asked by one thread at a time.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Weights, each in [0, 1] with sum 1, of the point of the triangle a, b, c that is nearest to x; exactly 0
/// where it lies on an edge or a corner. (Ericson 2005, §5.1.5.)
Vector3 nearest_weights(const Vector3& x, const Vector3& a, const Vector3& b, const Vector3& c);

class MeshSurface {
 public:
  struct Nearest {
    Vector3 point;    ///< of the mesh, m
    Vector3 normal;   ///< unit, of the face, edge or corner there (angle-weighted)
    double distance;  ///< m, at least 0
    bool inside;      ///< of a closed mesh: behind the surface (Bærentzen & Aanæs 2005)
  };

  struct Crossing {
    Vector3 point;    ///< m
    Vector3 normal;   ///< unit, of the triangle, to the side that the segment comes from
    bool from_front;  ///< that side is the one the triangle's normal points to
  };

  /// An edge that is bent by more than a trifle, so that something may touch it and no face.
  struct Ridge {
    std::array<int, 2> corners;
    Vector3 normal;  ///< unit, mean of its triangles'
  };

  /// A mesh that was diagnosed (see files.hpp).
  explicit MeshSurface(TriangleMesh mesh);
  ~MeshSurface();
  MeshSurface(const MeshSurface&) = delete;
  MeshSurface& operator=(const MeshSurface&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  /// Every edge has two triangles: the mesh has an inside (if its normals point out of it; a mesh inside out
  /// is turned, see the constructor's source).
  bool closed() const { return closed_; }

  Nearest nearest(const Vector3& x) const;
  /// Where the segment first meets the mesh.
  std::optional<Crossing> first_crossing(const Vector3& from, const Vector3& to) const;
  /// Adds the triangles that meet the box to `triangles`, ascending.
  void triangles_in_box(const Vector3& low, const Vector3& high, std::vector<int>& triangles) const;

  Vector3 corner(int vertex) const { return mesh_.positions.row(vertex).transpose(); }
  const Vector3& corner_normal(int vertex) const { return corner_normals_[static_cast<std::size_t>(vertex)]; }
  const std::vector<Ridge>& ridges() const { return ridges_; }
  /// Of each triangle's edges (0 to 1, 1 to 2, 2 to 0), the index into ridges(), or -1: none, or concave.
  const std::array<int, 3>& ridges_of(int triangle) const {
    return ridges_of_[static_cast<std::size_t>(triangle)];
  }
  /// Whether any ridge ends there: something may touch the corner alone.
  bool is_pointed(int vertex) const { return pointed_[static_cast<std::size_t>(vertex)] != 0; }

 private:
  struct Tree;

  void find_normals();
  void find_ridges();

  TriangleMesh mesh_;
  bool closed_ = true;
  std::vector<Vector3> face_normals_, corner_normals_;
  std::vector<std::array<Vector3, 3>> edge_normals_;  // #T, of the edges 0 to 1, 1 to 2, 2 to 0
  std::vector<Ridge> ridges_;
  std::vector<std::array<int, 3>> ridges_of_;
  std::vector<char> pointed_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace bendlab
