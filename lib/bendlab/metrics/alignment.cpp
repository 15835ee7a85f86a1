#include "bendlab/metrics/alignment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "bendlab/mesh/disjoint_sets.hpp"
#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

// The connected parts of the mesh: sets of triangles.
DisjointSets parts_of(const Triangles& triangles) {
  DisjointSets parts(static_cast<std::size_t>(triangles.rows()));
  for_each_edge(half_edges(triangles), [&](std::span<const HalfEdge<int>> sides) {
    for (const HalfEdge<int>& side : sides)
      parts.join(static_cast<std::size_t>(sides[0].triangle()), static_cast<std::size_t>(side.triangle()));
  });
  return parts;
}

Positions rows_of(const Positions& positions, const std::vector<int>& vertices) {
  Positions rows(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = positions.row(vertices[i]);
  return rows;
}

Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> weight) {
  return {weight.data(), static_cast<Eigen::Index>(weight.size())};
}

Vector3 mean_of(const Positions& positions, std::span<const double> weight) {
  const auto w = as_vector(weight);
  return positions.transpose() * w / w.sum();
}

}  // namespace

RigidMotion nearest_motion(const Positions& from, const Positions& to, std::span<const double> weight) {
  const Vector3 from_mean = mean_of(from, weight), to_mean = mean_of(to, weight);
  const Positions a = from.rowwise() - from_mean.transpose(), b = to.rowwise() - to_mean.transpose();
  const Eigen::Matrix3d covariance = b.transpose() * as_vector(weight).asDiagonal() * a;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return {rotation, to_mean - rotation * from_mean};
}

// The best angle φ maximises Σ w b·(R a) = cos φ Σ w a·b + sin φ Σ w axis·(a × b), with a and b perpendicular
// to the axis. With C and S for the two sums, φ is the polar angle of (C, S).
RigidMotion nearest_turn(const Positions& from, const Positions& to, std::span<const double> weight,
                         const Vector3& centre, const Vector3& axis) {
  double cosine = 0, sine = 0;
  for (Eigen::Index v = 0; v < from.rows(); ++v) {
    const Vector3 a = from.row(v).transpose() - centre, b = to.row(v).transpose() - centre;
    const double w = weight[static_cast<std::size_t>(v)];
    cosine += w * (a.dot(b) - a.dot(axis) * b.dot(axis));
    sine += w * axis.dot(a.cross(b));
  }
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
  return {rotation, centre - rotation * centre};
}

Alignment::Alignment(const RestMesh& rest) : rest_(rest.positions()) {
  std::map<std::size_t, std::vector<int>> vertices_of_part;
  DisjointSets parts = parts_of(rest.triangles());
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      vertices_of_part[parts.find(static_cast<std::size_t>(t))].push_back(rest.triangles()(t, c));
  for (auto& [lowest, vertices] : vertices_of_part) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    parts_.push_back(std::move(vertices));
  }
}

double Alignment::distance(const Positions& positions) const {
  double sum = 0;
  std::size_t count = 0;
  for (const std::vector<int>& part : parts_) {
    const Positions now = rows_of(positions, part), rest = rows_of(rest_, part);
    if (!now.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> equal_weights(part.size(), 1);
    sum += (nearest_motion(rest, now, equal_weights).moved(rest) - now).squaredNorm();
    count += part.size();
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace bendlab
