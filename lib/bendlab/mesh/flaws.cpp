#include "bendlab/mesh/flaws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 12> flaws = {"none",
                                                    "needles",
                                                    "caps",
                                                    "degenerate",
                                                    "duplicate_vertices",
                                                    "duplicate_faces",
                                                    "non_manifold_edge",
                                                    "bow_tie",
                                                    "isolated_vertices",
                                                    "pieces",
                                                    "mixed_orientation",
                                                    "hole"};

constexpr int every = 20;  // one of this many vertices, triangles or edges gets the flaw

void refuse_texture(const TriangleMesh& mesh) {
  if (mesh.texture_coordinates.rows() > 0)
    throw std::invalid_argument("a mesh with texture coordinates can't get a flaw or be renumbered");
}

TriangleMesh with_triangles(TriangleMesh mesh, const std::vector<Eigen::RowVector3i>& triangles) {
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return mesh;
}

std::vector<Eigen::RowVector3i> triangles_of(const TriangleMesh& mesh) {
  std::vector<Eigen::RowVector3i> list;
  for (const auto& row : mesh.triangles.rowwise()) list.emplace_back(row);
  return list;
}

void add_vertices(TriangleMesh& mesh, const std::vector<Vector3>& points) {
  const Eigen::Index before = mesh.vertex_count();
  mesh.positions.conservativeResize(before + static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.positions.row(before + static_cast<Eigen::Index>(i)) = points[i].transpose();
}

// The mesh without the vertices that no triangle uses.
TriangleMesh compacted(const TriangleMesh& mesh) {
  std::vector<int> new_index(static_cast<std::size_t>(mesh.vertex_count()), -1);
  for (const auto& row : mesh.triangles.rowwise())
    for (const int v : row) new_index[static_cast<std::size_t>(v)] = 0;
  int kept = 0;
  for (int& at : new_index)
    if (at == 0) at = kept++;
  TriangleMesh result{
      .positions = Positions(kept, 3), .triangles = mesh.triangles, .texture_coordinates = {}};
  for (std::size_t v = 0; v < new_index.size(); ++v)
    if (new_index[v] >= 0)
      result.positions.row(new_index[v]) = mesh.positions.row(static_cast<Eigen::Index>(v));
  for (Eigen::Index i = 0; i < result.triangles.size(); ++i)
    result.triangles.data()[i] = new_index[static_cast<std::size_t>(result.triangles.data()[i])];
  return result;
}

// An interior vertex and its triangles.
struct Star {
  int vertex;
  std::vector<Eigen::RowVector3i> triangles;  // each turned so that the vertex comes first
};

// Interior vertices, chosen so that no two of them have a common neighbour.
std::vector<Star> scattered_stars(const TriangleMesh& mesh) {
  const RestMesh rest(mesh);
  std::vector<char> taken(static_cast<std::size_t>(rest.vertex_count()), 0);
  std::vector<Star> all(taken.size());
  for (const auto& row : mesh.triangles.rowwise())
    for (int c = 0; c < 3; ++c)
      all[static_cast<std::size_t>(row(c))].triangles.push_back({row(c), row((c + 1) % 3), row((c + 2) % 3)});
  std::vector<Star> stars;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto ring = rest.one_ring()[v];
    Star& star = all[static_cast<std::size_t>(v)];
    const bool interior = star.triangles.size() == ring.size();
    const bool clear =
        std::ranges::none_of(ring, [&](int u) { return taken[static_cast<std::size_t>(u)] != 0; });
    if (!interior || !clear || taken[static_cast<std::size_t>(v)] != 0) continue;
    star.vertex = v;
    stars.push_back(star);
    for (const int u : ring)
      for (const int w : rest.one_ring()[u]) taken[static_cast<std::size_t>(w)] = 1;
  }
  return stars;
}

// Moves the vertex of every star to target(p, a, b): p is the vertex's position, a and b are the positions of
// the other two corners of one of its triangles.
template <class Target>
TriangleMesh with_moved(TriangleMesh mesh, Target target) {
  for (const Star& star : scattered_stars(mesh)) {
    const Eigen::RowVector3i& corners = star.triangles.front();
    const Vector3 p = mesh.positions.row(corners(0)), a = mesh.positions.row(corners(1)),
                  b = mesh.positions.row(corners(2));
    mesh.positions.row(star.vertex) = target(p, a, b).transpose();
  }
  return mesh;
}

TriangleMesh with_duplicate_faces(const TriangleMesh& mesh) {
  std::vector<Eigen::RowVector3i> triangles = triangles_of(mesh);
  for (Eigen::Index t = every / 2; t < mesh.triangle_count(); t += every)
    triangles.emplace_back(mesh.triangles.row(t));
  return with_triangles(mesh, triangles);
}

TriangleMesh with_fins(TriangleMesh mesh) {
  const RestMesh rest(mesh);
  std::vector<Eigen::RowVector3i> triangles = triangles_of(mesh);
  std::vector<Vector3> tips;
  for (std::size_t h = every / 2; h < rest.hinges().size(); h += every) {
    const Hinge& hinge = rest.hinges()[h];
    const Vector3 a = rest.position(hinge.edge[0]), b = rest.position(hinge.edge[1]),
                  c = rest.position(hinge.opposite[0]);
    const Vector3 up = (b - a).cross(c - a).normalized();
    triangles.emplace_back(hinge.edge[0], hinge.edge[1], rest.vertex_count() + static_cast<int>(tips.size()));
    tips.push_back(0.5 * (a + b) + (b - a).norm() * up);
  }
  add_vertices(mesh, tips);
  return with_triangles(std::move(mesh), triangles);
}

TriangleMesh with_bow_ties(const TriangleMesh& mesh) {
  std::vector<Eigen::RowVector3i> removed;
  const auto key = [](const Eigen::RowVector3i& t) {
    std::array<int, 3> corners = {t(0), t(1), t(2)};
    std::ranges::sort(corners);
    return corners;
  };
  for (const Star& star : scattered_stars(mesh)) {
    const Eigen::RowVector3i& first = star.triangles.front();
    const auto apart = std::ranges::find_if(star.triangles, [&](const Eigen::RowVector3i& t) {
      return t(1) != first(1) && t(1) != first(2) && t(2) != first(1) && t(2) != first(2);
    });
    if (apart == star.triangles.end()) continue;
    removed.push_back(first);
    removed.push_back(*apart);
  }
  std::vector<Eigen::RowVector3i> triangles = triangles_of(mesh);
  std::erase_if(triangles, [&](const Eigen::RowVector3i& t) {
    return std::ranges::any_of(removed, [&](const Eigen::RowVector3i& r) { return key(r) == key(t); });
  });
  return compacted(with_triangles(mesh, triangles));
}

TriangleMesh with_isolated_vertices(TriangleMesh mesh) {
  const RestMesh rest(mesh);
  std::vector<Vector3> points;
  for (int i = 0; i < 5; ++i)
    points.push_back(rest.box_max() + i * rest.mean_edge_length() * Vector3::UnitX());
  add_vertices(mesh, points);
  return mesh;
}

TriangleMesh cut_in_two(TriangleMesh mesh) {
  const RestMesh rest(mesh);
  std::vector<char> left(static_cast<std::size_t>(rest.vertex_count()), 0), right = left;
  std::vector<char> on_the_right;
  for (const auto& row : mesh.triangles.rowwise()) {
    const double x = (mesh.positions(row(0), 0) + mesh.positions(row(1), 0) + mesh.positions(row(2), 0)) / 3;
    on_the_right.push_back(x > rest.centre().x());
    for (const int v : row) (on_the_right.back() ? right : left)[static_cast<std::size_t>(v)] = 1;
  }
  std::vector<int> copy(left.size(), -1);
  std::vector<Vector3> points;
  for (std::size_t v = 0; v < left.size(); ++v)
    if (left[v] && right[v]) {
      copy[v] = rest.vertex_count() + static_cast<int>(points.size());
      points.push_back(rest.position(static_cast<int>(v)));
    }
  add_vertices(mesh, points);
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      if (int& v = mesh.triangles(t, c);
          on_the_right[static_cast<std::size_t>(t)] && copy[static_cast<std::size_t>(v)] >= 0)
        v = copy[static_cast<std::size_t>(v)];
  return mesh;
}

TriangleMesh with_mixed_orientation(TriangleMesh mesh) {
  for (Eigen::Index t = 0; t < mesh.triangle_count(); t += 2)
    std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
  return mesh;
}

TriangleMesh with_hole(const TriangleMesh& mesh) {
  const RestMesh rest(mesh);
  constexpr double radius = 0.15;  // mesh sizes
  std::vector<Eigen::RowVector3i> triangles = triangles_of(mesh);
  std::erase_if(triangles, [&](const Eigen::RowVector3i& t) {
    const Vector3 middle = (rest.position(t(0)) + rest.position(t(1)) + rest.position(t(2))) / 3;
    return (middle - rest.centre()).norm() < radius * rest.size();
  });
  return compacted(with_triangles(mesh, triangles));
}

// A permutation of 0 … count - 1 (Fisher and Yates). The result of std::shuffle differs between libraries.
std::vector<int> permutation(Eigen::Index count, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t last = order.size(); last > 1; --last) std::swap(order[last - 1], order[random() % last]);
  return order;
}

}  // namespace

std::span<const std::string_view> mesh_flaws() {
  return flaws;
}

TriangleMesh with_flaw(TriangleMesh mesh, std::string_view flaw) {
  if (flaw == "none") return mesh;
  refuse_texture(mesh);
  constexpr double nearly_straight = 179.9 * std::numbers::pi / 180;
  if (flaw == "needles")
    return with_moved(std::move(mesh), [](const Vector3& p, const Vector3& a, const Vector3& b) -> Vector3 {
      return a + 1e-3 * (b - a).norm() * (p - a).normalized();
    });
  if (flaw == "caps")
    return with_moved(std::move(mesh), [](const Vector3& p, const Vector3& a, const Vector3& b) -> Vector3 {
      const Vector3 middle = 0.5 * (a + b), along = (b - a).normalized();
      const Vector3 inward = ((p - middle) - (p - middle).dot(along) * along).normalized();
      return middle + 0.5 * (b - a).norm() / std::tan(0.5 * nearly_straight) * inward;
    });
  if (flaw == "degenerate")
    return with_moved(std::move(mesh), [](const Vector3&, const Vector3& a, const Vector3& b) -> Vector3 {
      return 0.5 * (a + b);
    });
  if (flaw == "duplicate_vertices")
    return with_moved(std::move(mesh),
                      [](const Vector3&, const Vector3& a, const Vector3&) -> Vector3 { return a; });
  if (flaw == "duplicate_faces") return with_duplicate_faces(mesh);
  if (flaw == "non_manifold_edge") return with_fins(std::move(mesh));
  if (flaw == "bow_tie") return with_bow_ties(mesh);
  if (flaw == "isolated_vertices") return with_isolated_vertices(std::move(mesh));
  if (flaw == "pieces") return cut_in_two(std::move(mesh));
  if (flaw == "mixed_orientation") return with_mixed_orientation(std::move(mesh));
  if (flaw == "hole") return with_hole(mesh);
  throw std::invalid_argument(
      fmt::format("'{}' is not a known flaw; known flaws are {}", flaw, fmt::join(flaws, ", ")));
}

TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  refuse_texture(mesh);
  std::mt19937_64 random(seed);
  const std::vector<int> new_index = permutation(mesh.vertex_count(), random),
                         order = permutation(mesh.triangle_count(), random);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < new_index.size(); ++v)
    result.positions.row(new_index[v]) = mesh.positions.row(static_cast<Eigen::Index>(v));
  for (std::size_t t = 0; t < order.size(); ++t)
    for (int c = 0; c < 3; ++c)
      result.triangles(order[t], c) =
          new_index[static_cast<std::size_t>(mesh.triangles(static_cast<Eigen::Index>(t), c))];
  return result;
}

}  // namespace bendlab
