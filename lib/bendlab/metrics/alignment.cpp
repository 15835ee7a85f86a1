#include "bendlab/metrics/alignment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace bendlab {
namespace {

// Which triangles hang together by edges: for each the lowest one of its part.
std::vector<int> parts_of(const Triangles& triangles) {
  std::vector<int> parent(static_cast<std::size_t>(triangles.rows()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int t) {
    while (parent[static_cast<std::size_t>(t)] != t)
      t = parent[static_cast<std::size_t>(t)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(t)])];
    return t;
  };
  std::map<std::array<int, 2>, int> first_at;
  for (int t = 0; t < triangles.rows(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = triangles(t, c), b = triangles(t, (c + 1) % 3);
      const auto [entry, is_new] = first_at.try_emplace({std::min(a, b), std::max(a, b)}, t);
      const int one = find(entry->second), other = find(t);
      parent[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  for (int t = 0; t < triangles.rows(); ++t) parent[static_cast<std::size_t>(t)] = find(t);
  return parent;
}

Eigen::MatrixX3d rows_of(const Positions& positions, const std::vector<int>& vertices) {
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = positions.row(vertices[i]);
  return rows;
}

// Sum of the squared distances that the best rotation and translation leave.
double squared_distance(Eigen::MatrixX3d rest, Eigen::MatrixX3d now) {
  rest.rowwise() -= rest.colwise().mean().eval();
  now.rowwise() -= now.colwise().mean().eval();
  const Eigen::Matrix3d covariance = now.transpose() * rest;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return (now - rest * rotation.transpose()).squaredNorm();
}

}  // namespace

Alignment::Alignment(const RestMesh& rest) : rest_(rest.positions()) {
  std::map<int, std::vector<int>> found;
  const std::vector<int> part = parts_of(rest.triangles());
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) found[part[static_cast<std::size_t>(t)]].push_back(rest.triangles()(t, c));
  for (auto& [lowest, vertices] : found) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    parts_.push_back(std::move(vertices));
  }
}

double Alignment::distance(const Positions& positions) const {
  double sum = 0;
  std::size_t count = 0;
  for (const std::vector<int>& part : parts_) {
    const Eigen::MatrixX3d now = rows_of(positions, part);
    if (!now.allFinite()) return std::numeric_limits<double>::quiet_NaN();
    sum += squared_distance(rows_of(rest_, part), now);
    count += part.size();
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace bendlab
