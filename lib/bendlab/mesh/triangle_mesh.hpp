// A mesh of positions, triangles and, if it has a texture, texture coordinates. Files, generators and metrics
// exchange meshes in this form.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace bendlab {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< #V by 3, m
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;     ///< #T by 3, vertex indices
using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;         ///< #E by 2, first < second
using TextureCoordinates = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  ///< 3#T by 2, or empty

/// A view of numbers as rows of three. The numbers have to exist as long as the view.
inline Eigen::Map<const Positions> as_rows(const std::vector<double>& numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size() / 3), 3};
}
inline Eigen::Map<const Triangles> as_rows(const std::vector<int>& numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size() / 3), 3};
}

struct TriangleMesh {
  Positions positions;
  Triangles triangles;
  /// Row 3t + c belongs to corner c of triangle t, because a vertex on a seam has several texture
  /// coordinates. Empty if the mesh has no texture.
  TextureCoordinates texture_coordinates;

  Eigen::Index vertex_count() const { return positions.rows(); }
  Eigen::Index triangle_count() const { return triangles.rows(); }
};

}  // namespace bendlab
