#include "bendlab/mesh/refined.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/settings/random_numbers.hpp"

namespace bendlab {
namespace {

// New vertices in the middle of edges, numbered after the vertices of the mesh.
class Middles {
 public:
  explicit Middles(const TriangleMesh& mesh) : mesh_(mesh), next_(static_cast<int>(mesh.vertex_count())) {}

  int between(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto edge = (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high);
    const auto [entry, is_new] = vertex_.try_emplace(edge, next_);
    if (is_new) {
      ++next_;
      points_.push_back(0.5 * (mesh_.positions.row(a) + mesh_.positions.row(b)));
    }
    return entry->second;
  }

  // The positions of the mesh's vertices, followed by the middles of edges.
  Positions positions() const {
    Positions all(next_, 3);
    all.topRows(mesh_.vertex_count()) = mesh_.positions;
    for (std::size_t i = 0; i < points_.size(); ++i)
      all.row(mesh_.vertex_count() + static_cast<Eigen::Index>(i)) = points_[i];
    return all;
  }

 private:
  const TriangleMesh& mesh_;
  std::unordered_map<std::uint64_t, int> vertex_;  // key: smaller end << 32 | larger end
  std::vector<Eigen::RowVector3d> points_;
  int next_;
};

//        2
//       / \        c: a corner; c + 3: the middle of the edge from corner c to the next corner.
//     5 --- 4      First the three triangles at the corners, then the triangle in the middle.
//     / \ / \      .
//    0 - 3 - 1     .
constexpr std::array<std::array<int, 3>, 4> quarters = {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

TriangleMesh refined_once(const TriangleMesh& mesh) {
  Middles middles(mesh);
  const bool textured = mesh.texture_coordinates.rows() > 0;
  TriangleMesh fine{.positions = {},
                    .triangles = Triangles(4 * mesh.triangle_count(), 3),
                    .texture_coordinates = TextureCoordinates(textured ? 12 * mesh.triangle_count() : 0, 2)};
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
    std::array<int, 6> vertex{};
    std::array<Eigen::RowVector2d, 6> texture;
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      vertex[static_cast<std::size_t>(c)] = mesh.triangles(t, c);
      vertex[static_cast<std::size_t>(c + 3)] =
          middles.between(mesh.triangles(t, c), mesh.triangles(t, next));
      if (!textured) continue;
      texture[static_cast<std::size_t>(c)] = mesh.texture_coordinates.row(3 * t + c);
      texture[static_cast<std::size_t>(c + 3)] =
          0.5 * (mesh.texture_coordinates.row(3 * t + c) + mesh.texture_coordinates.row(3 * t + next));
    }
    for (std::size_t q = 0; q < quarters.size(); ++q)
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Index row = 4 * t + static_cast<Eigen::Index>(q);
        const auto corner = static_cast<std::size_t>(quarters[q][c]);
        fine.triangles(row, static_cast<Eigen::Index>(c)) = vertex[corner];
        if (textured) fine.texture_coordinates.row(3 * row + static_cast<Eigen::Index>(c)) = texture[corner];
      }
  }
  fine.positions = middles.positions();
  return fine;
}

// For each vertex: smallest height of the adjacent triangles (m), and sum of their normals, weighted by
// areas.
struct Surroundings {
  std::vector<double> height;
  std::vector<Vector3> normal;

  explicit Surroundings(const RestMesh& rest)
      : height(static_cast<std::size_t>(rest.vertex_count()), std::numeric_limits<double>::infinity()),
        normal(height.size(), Vector3::Zero()) {
    for (const auto& row : rest.triangles().rowwise()) {
      const Vector3 a = rest.position(row(0)), b = rest.position(row(1)), c = rest.position(row(2)),
                    twice_area = (b - a).cross(c - a);
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      for (const int v : row) {
        const auto at = static_cast<std::size_t>(v);
        height[at] = std::min(height[at], twice_area.norm() / longest);
        normal[at] += twice_area;
      }
    }
  }
};

}  // namespace

int most_refinements(std::int64_t triangles) {
  int times = 0;
  for (; triangles > 0 && triangles <= most_refined_triangles / 4; triangles *= 4) ++times;
  return times;
}

TriangleMesh refined(const TriangleMesh& mesh, int times) {
  if (const int most = most_refinements(mesh.triangle_count()); times > most)
    throw std::invalid_argument(
        fmt::format("refining {} triangles {} times would give more than {} triangles; this mesh can be "
                    "refined at most {} times",
                    mesh.triangle_count(), times, most_refined_triangles, most));
  TriangleMesh fine = mesh;
  for (int i = 0; i < times; ++i) fine = refined_once(fine);
  return fine;
}

TriangleMesh jittered(const TriangleMesh& mesh, double share, std::uint64_t seed) {
  if (mesh.texture_coordinates.rows() > 0)
    throw std::invalid_argument(
        "can't jitter a mesh with texture coordinates, because the texture would not fit: remove jitter");
  const RestMesh rest(mesh);
  const Surroundings around(rest);
  std::vector<int> triangles(around.height.size(), 0);
  for (const auto& row : mesh.triangles.rowwise())
    for (const int v : row) ++triangles[static_cast<std::size_t>(v)];
  std::mt19937_64 random(seed);
  TriangleMesh moved = mesh;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    const double angle = 2 * std::numbers::pi * uniform(random), radius = std::sqrt(uniform(random));
    const bool inside = triangles[at] > 0 && triangles[at] == static_cast<int>(rest.one_ring()[v].size());
    if (!inside || around.normal[at].norm() == 0) continue;
    const Vector3 normal = around.normal[at].normalized(), along = normal.unitOrthogonal();
    const Vector3 direction = std::cos(angle) * along + std::sin(angle) * normal.cross(along);
    moved.positions.row(v) += (share * around.height[at] * radius * direction).transpose();
  }
  return moved;
}

}  // namespace bendlab
