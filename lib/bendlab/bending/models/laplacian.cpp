// Quadratic bending by the Laplacian at each vertex.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"

namespace bendlab {
namespace laplacian_model {

constexpr std::size_t most_neighbours = LaplacianBend::arity - 1;

double cotangent(const Vector3& a, const Vector3& b) {
  return a.dot(b) / a.cross(b).norm();
}

// The row of the integrated Laplacian of each vertex: weights by vertex. At the border, half of the normal
// derivative's integral along both border edges is added, so that the row is 0 for every linear function.
std::vector<std::map<int, double>> rows_of(const RestMesh& rest, const std::vector<RestFace>& faces) {
  std::vector<std::map<int, double>> rows(static_cast<std::size_t>(rest.vertex_count()));
  const auto add = [&](int row, int column, double value) {
    rows[static_cast<std::size_t>(row)][column] += value;
  };
  for (const RestFace& face : faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = face.vertices[(i + 1) % 3], b = face.vertices[(i + 2) % 3], top = face.vertices[i];
      const Vector3 pa = rest.position(a), pb = rest.position(b), pt = rest.position(top);
      const double half = 0.5 * cotangent(pa - pt, pb - pt);
      add(a, b, half), add(a, a, -half), add(b, a, half), add(b, b, -half);
      if (face.side[i] != EdgeSide::border) continue;
      const double at_a = 0.5 * cotangent(pt - pa, pb - pa), at_b = 0.5 * cotangent(pt - pb, pa - pb);
      for (const int v : {a, b}) add(v, a, at_b), add(v, b, at_a), add(v, top, -at_a - at_b);
    }
  return rows;
}

BendingConstraints build(const Laplacian&, const BendingInput& input) {
  BendingConstraints constraints;
  auto& list = std::get<ElementList<LaplacianBend>>(constraints.elements);
  const RestMesh& rest = input.rest;
  const std::vector<RestFace> faces = rest_faces(rest, input.pins);
  std::vector<double> area(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (const RestFace& face : faces)
    for (const int v : face.vertices) area[static_cast<std::size_t>(v)] += face.area / 3;
  const std::vector<std::map<int, double>> rows = rows_of(rest, faces);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const std::map<int, double>& row = rows[static_cast<std::size_t>(v)];
    if (row.empty() || std::ranges::all_of(row, [&](const auto& e) { return input.pins.pinned(e.first); }))
      continue;
    if (row.size() - 1 > most_neighbours)
      throw std::invalid_argument(fmt::format(
          "the model laplacian takes vertices with at most {} neighbours, but vertex {} has {}: choose "
          "another model, such as mid_edge or discrete_shells, or a mesh without such vertices",
          most_neighbours, v, row.size() - 1));
    std::array<int, LaplacianBend::arity> corner;
    corner.fill(v);
    std::array<double, LaplacianBend::rest_values> values{};
    std::size_t next = most_neighbours - (row.size() - 1);
    Vector3 bend = Vector3::Zero();
    for (const auto& [neighbour, weight] : row) {
      if (neighbour == v) continue;
      corner[next] = neighbour, values[next++] = weight;
      values[most_neighbours] -= weight;
      bend += weight * (rest.position(neighbour) - rest.position(v));
    }
    const double length = std::sqrt(area[static_cast<std::size_t>(v)]);
    // Rounding of the sum must not count as rest curvature, so flat rings get exactly 0.
    values[LaplacianBend::arity] = !input.is_flat && bend.norm() > 1e-12 * length ? bend.norm() : 0;
    values[LaplacianBend::arity + 1] = length;
    list.vertices.push_back(corner);
    list.rest.push_back(values);
    list.softness.push_back(area[static_cast<std::size_t>(v)]);
  }
  return constraints;
}

}  // namespace laplacian_model

constinit const BendingKind Laplacian::kind{
    .name = "laplacian",
    .label = "Laplacian",
    .summary = "the square of the mean curvature at every vertex, as the Laplacian of the positions",
    .source =
        "Wardetzky et al. 2007, Discrete quadratic curvature energies, with piecewise linear functions; "
        "border terms: Chen, Kaufman and Vouga 2026",
    .limits =
        "has Poisson's ratio 1, so a sheet bends to a saddle without bending energy, and a narrow strip has "
        "next to no rigidity at small deflections; takes vertices with at most 12 neighbours; cannot "
        "distinguish the two directions of a fold",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder",
    .settings = table_of<Laplacian>({}),
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .softens = true,
    .build = erased<laplacian_model::build>,
};
}  // namespace bendlab
