#include "bendlab/bending/rest_faces.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "bendlab/constraints/corners.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

// Fills what follows from the corners of a triangle alone.
void measure(RestFace& face, const RestMesh& rest) {
  const std::array<Vector3, 3> p = corners(rest.positions(), face.vertices);
  const Vector3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  face.x = (p[1] - p[0]).normalized(), face.y = normal.normalized().cross(face.x);
  face.area = 0.5 * normal.norm();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 e = p[(i + 2) % 3] - p[(i + 1) % 3], inwards = normal.cross(e).normalized();
    face.height[i] = 2 * face.area / e.norm();
    face.inwards[i] = {inwards.dot(face.x), inwards.dot(face.y)};
  }
}

}  // namespace

std::vector<RestFace> rest_faces(const RestMesh& rest, const Pins& pins) {
  const std::vector<char> degenerate = triangles_without_area(rest.mesh());
  const auto count = static_cast<std::size_t>(rest.triangle_count());
  std::vector<RestFace> all(count);
  std::vector<char> is_held(count, 1);  // all vertices pinned
  for (std::size_t t = 0; t < count; ++t) {
    RestFace& face = all[t];
    face.triangle = static_cast<int>(t);
    for (std::size_t c = 0; c < 3; ++c) {
      face.vertices[c] = rest.triangles()(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(c));
      if (!pins.pinned(face.vertices[c])) is_held[t] = 0;
    }
    face.beyond = face.vertices;
    face.edge.fill(-1), face.side.fill(EdgeSide::border), face.turns.fill(1), face.height_beyond.fill(0);
    if (degenerate[t] == 0) measure(face, rest);
  }
  int next_edge = 0;
  for_each_edge(half_edges(rest.triangles()), [&](std::span<const HalfEdge<int>> sides) {
    std::vector<HalfEdge<int>> sound;
    for (const HalfEdge<int>& side : sides)
      if (degenerate[static_cast<std::size_t>(side.triangle())] == 0) sound.push_back(side);
    // A side that begins at corner c lies opposite corner c + 2.
    const auto opposite = [](const HalfEdge<int>& side) {
      return static_cast<std::size_t>((side.corner() + 2) % 3);
    };
    for (const HalfEdge<int>& side : sound)
      all[static_cast<std::size_t>(side.triangle())].edge[opposite(side)] = next_edge;
    ++next_edge;
    if (sound.size() > 2)  // every triangle ends here: an edge for each
      for (const HalfEdge<int>& side : sound)
        all[static_cast<std::size_t>(side.triangle())].edge[opposite(side)] = next_edge++;
    if (sound.size() != 2) return;
    for (const std::size_t s : {0U, 1U}) {
      const auto own = static_cast<std::size_t>(sound[s].triangle()),
                 other = static_cast<std::size_t>(sound[1 - s].triangle());
      RestFace& face = all[own];
      const std::size_t i = opposite(sound[s]), j = opposite(sound[1 - s]);
      face.beyond[i] = all[other].vertices[j];
      face.side[i] = is_held[other] != 0 ? EdgeSide::clamped : EdgeSide::inside;
      face.height_beyond[i] = all[other].height[j];
      const auto start = [&](const RestFace& of, std::size_t corner) {
        return of.vertices[(corner + 1) % 3];
      };
      const bool same_direction = start(face, i) == start(all[other], j);
      face.turns[i] = s == 1 && !same_direction ? -1 : 1;
    }
  });
  std::vector<RestFace> faces;
  for (std::size_t t = 0; t < count; ++t)
    if (degenerate[t] == 0) faces.push_back(all[t]);
  return faces;
}

int edge_count(const std::vector<RestFace>& faces) {
  int count = 0;
  for (const RestFace& face : faces) count = std::max(count, 1 + *std::ranges::max_element(face.edge));
  return count;
}

std::array<double, 6> upper_factor(const RestFace& face, const std::array<double, 3>& curvature,
                                   const BendingInput& input) {
  // The energy of the curvatures t_i t_iᵀ and t_j t_jᵀ, for a rigidity of 1.
  const auto energy_of = [&](std::size_t i, std::size_t j) {
    const double nu = input.poisson_ratio, cosine = face.inwards[i].dot(face.inwards[j]);
    if (input.directed == nullptr) return (1 - nu) * cosine * cosine + nu;
    const Vector3& warp = input.directed->warp[static_cast<std::size_t>(face.triangle)];
    const Vector2 axis(warp.dot(face.x), warp.dot(face.y));
    const auto curvature_of = [&](std::size_t k) -> Eigen::Vector3d {
      const double c = face.inwards[k].dot(axis),
                   s = axis.x() * face.inwards[k].y() - axis.y() * face.inwards[k].x();
      return {c * c, s * s, 2 * c * s};
    };
    const OrthotropicRigidity& rigidity = input.directed->rigidity;
    return rigidity.product(curvature_of(i), curvature_of(j)) / rigidity.mean();
  };
  Eigen::Matrix3d energy;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      energy(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          face.area * curvature[i] * curvature[j] * energy_of(i, j);
  const Eigen::Matrix3d u = energy.llt().matrixU();
  return {u(0, 0), u(0, 1), u(0, 2), u(1, 1), u(1, 2), u(2, 2)};
}

ElementList<FoldBend> fold_constraints(const BendingInput& input, FoldBend::Law law, double share,
                                       const std::function<double(const RestFace&, std::size_t)>& curvature) {
  ElementList<FoldBend> list;
  list.law = law;
  for (const RestFace& face : rest_faces(input.rest, input.pins)) {
    const auto is_free = [&](int v) { return !input.pins.pinned(v); };
    if (std::ranges::none_of(face.vertices, is_free) && std::ranges::none_of(face.beyond, is_free)) continue;
    std::array<double, FoldBend::rest_values> rest{};
    std::array<double, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_border = face.side[i] == EdgeSide::border;
      rest[i] = is_border ? 0 : share;
      // The turn of a border is always 0, so any curvature will do.
      c[i] = is_border ? 2 / (face.height[i] * face.height[i]) : curvature(face, i);
    }
    std::ranges::copy(upper_factor(face, c, input), rest.begin() + 6);
    rest[12] = std::sqrt(2 * face.area);
    const std::array<int, 6> corner = {face.beyond[0],   face.beyond[1],   face.beyond[2],
                                       face.vertices[0], face.vertices[1], face.vertices[2]};
    if (!input.is_flat)
      std::ranges::copy(FoldBend::turns(corners(input.rest.positions(), corner), rest, law),
                        rest.begin() + 3);
    list.vertices.push_back(corner);
    list.rest.push_back(rest);
    list.softness.push_back(1);
  }
  return list;
}

}  // namespace bendlab
