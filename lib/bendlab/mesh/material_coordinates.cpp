#include "bendlab/mesh/material_coordinates.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bendlab/mesh/bad_triangles.hpp"

namespace bendlab {
namespace {

struct RestTriangle {
  Vector3 e1, e2, normal;

  // `least_height` is above 0 for a triangle without area.
  RestTriangle(const TriangleMesh& mesh, Eigen::Index t, double least_height)
      : e1((mesh.positions.row(mesh.triangles(t, 1)) - mesh.positions.row(mesh.triangles(t, 0))).transpose()),
        e2((mesh.positions.row(mesh.triangles(t, 2)) - mesh.positions.row(mesh.triangles(t, 0))).transpose()),
        normal(e1.cross(e2).normalized()) {
    if (least_height > 0) regularise(least_height);
  }

  // Gives the triangle a height: moves the corner opposite the longest edge away from that edge's line. If
  // the line is shorter than the height, the line is made as long as the height first. The direction is
  // arbitrary: towards the coordinate axis with the largest angle to the line.
  void regularise(double height) {
    std::array<Vector3, 3> corner = {Vector3::Zero(), e1, e2};
    std::size_t apex = 0;  // opposite the longest edge
    double base = -1;
    for (std::size_t c = 0; c < 3; ++c)
      if (const double length = (corner[(c + 1) % 3] - corner[(c + 2) % 3]).norm(); length > base)
        apex = c, base = length;
    Vector3 &from = corner[(apex + 1) % 3], &to = corner[(apex + 2) % 3];
    height = std::max(height, regular_height_of_edge * base);
    const Vector3 along = base > 0 ? Vector3((to - from) / base) : Vector3::UnitX();
    if (base < height) to = from + height * along, base = height;
    Eigen::Index least;
    along.cwiseAbs().minCoeff(&least);
    const Vector3 across = along.cross(Vector3::Unit(least)).cross(along).normalized();
    corner[apex] = from + std::clamp(along.dot(corner[apex] - from), 0.0, base) * along + height * across;
    e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    normal = e1.cross(e2).normalized();
  }

  // Q⁻¹ for the warp axis, which is `warp` projected into the triangle's plane.
  InverseRest inverse_along(const Vector3& warp) const {
    constexpr double perpendicular = 1e-6;  // of |warp|: a shorter projection has no useful direction
    Vector3 axis = warp - warp.dot(normal) * normal;
    if (axis.norm() <= perpendicular * warp.norm()) axis = e1;
    const Vector3 u = axis.normalized(), v = normal.cross(u);
    Eigen::Matrix2d q;
    q << u.dot(e1), u.dot(e2), v.dot(e1), v.dot(e2);
    Eigen::Matrix2d inverse = q.inverse();
    for (int column = 0; column < 2; ++column) snap(inverse(0, column), inverse(1, column));
    return {inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1)};
  }

  // A column of Q⁻¹ holds the gradients b and c of a stretch at two corners; the gradient at the third corner
  // is -(b + c). If an edge lies along the axis, the gradient at the opposite corner is zero up to rounding.
  // Such a gradient is set to zero, because a projection would divide by the rounding error if the edge is
  // pinned.
  static void snap(double& b, double& c) {
    constexpr double rounding = 1e-9;  // of the column's largest entry
    const double limit = rounding * std::max(std::abs(b), std::abs(c));
    if (std::abs(b) < limit) b = 0;
    if (std::abs(c) < limit) c = 0;
    if (std::abs(b + c) < limit) c = -b;
  }
};

// #T, m: the least height of a degenerate triangle's rest shape; 0 for the other triangles.
std::vector<double> least_heights(const TriangleMesh& mesh) {
  const std::vector<char> degenerate = triangles_without_area(mesh);
  const double height = regular_height_of_size *
                        (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  std::vector<double> heights;
  for (const char is_degenerate : degenerate) heights.push_back(is_degenerate != 0 ? height : 0);
  return heights;
}

}  // namespace

std::vector<InverseRest> inverse_rest_from_warp(const TriangleMesh& mesh, const Vector3& warp_direction) {
  std::vector<InverseRest> inverses;
  inverses.reserve(static_cast<std::size_t>(mesh.triangle_count()));
  const std::vector<double> heights = least_heights(mesh);
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    inverses.push_back(
        RestTriangle(mesh, t, heights[static_cast<std::size_t>(t)]).inverse_along(warp_direction));
  return inverses;
}

std::vector<InverseRest> inverse_rest_from_texture(const TriangleMesh& mesh) {
  if (mesh.texture_coordinates.rows() != 3 * mesh.triangle_count())
    throw std::invalid_argument(
        "the mesh has no texture coordinates: use an OBJ file in which all faces have texture indices (f 1/1 "
        "2/2 3/3), or set /material/coordinates to warp");
  std::vector<InverseRest> inverses;
  inverses.reserve(static_cast<std::size_t>(mesh.triangle_count()));
  const std::vector<double> heights = least_heights(mesh);
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
    const RestTriangle triangle(mesh, t, heights[static_cast<std::size_t>(t)]);
    if (heights[static_cast<std::size_t>(t)] > 0) {  // the triangle's texture is degenerate, too
      inverses.push_back(triangle.inverse_along(triangle.e1));
      continue;
    }
    const auto corner = mesh.texture_coordinates.middleRows<3>(3 * t);
    Eigen::Matrix2d texture;
    texture.col(0) = (corner.row(1) - corner.row(0)).transpose();
    texture.col(1) = (corner.row(2) - corner.row(0)).transpose();
    const double longest = texture.colwise().squaredNorm().maxCoeff();
    constexpr double degenerate = 1e-12;  // of the longest texture edge squared
    if (!(std::abs(texture.determinant()) > degenerate * longest))
      throw std::invalid_argument(fmt::format(
          "triangle {} has degenerate texture coordinates: repair the texture, or set coordinates to warp",
          t));
    // The warp axis is t_u, the direction in which u grows: [t_u, t_v] = [e1, e2] texture⁻¹.
    const Eigen::Vector2d first = texture.inverse().col(0);
    inverses.push_back(triangle.inverse_along(first(0) * triangle.e1 + first(1) * triangle.e2));
  }
  return inverses;
}

}  // namespace bendlab
