#include "experiments/dialects/hinges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "bendlab/bending/rest_hinges.hpp"
#include "bendlab/constraints/build.hpp"
#include "bendlab/mesh/pins.hpp"

namespace bendlab {
namespace {

// Directions in steps of 5°. Their mean is exact for a polynomial of degree 8 in the direction, such as θ⁴.
std::array<Vector2, 36> directions() {
  std::array<Vector2, 36> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(result.size());
    result[i] = {std::cos(angle), std::sin(angle)};
  }
  return result;
}

}  // namespace

std::vector<MeshHinge> mesh_hinges(const RestMesh& rest) {
  const std::vector<double> vertex_area = lumped_masses(rest, 1);
  const std::vector<Vector2> plane = plane_coordinates(rest);
  std::vector<MeshHinge> hinges;
  for (const RestHinge& hinge : rest_hinges(rest, make_pins(rest, {}, 0))) {
    std::array<Vector2, 4> q = unfolded(hinge.position);
    MeshHinge& added = hinges.emplace_back(
        MeshHinge{.edge = hinge.edge, .area = hinge.area, .height = hinge.area / hinge.edge});
    const std::array<double, 4> slope = fold_weights(q);  // |∂θ/∂x| of each vertex
    for (std::size_t i = 0; i < 4; ++i) {
      const auto v = static_cast<std::size_t>(hinge.vertices[i]);
      added.mobility += slope[i] * slope[i] / vertex_area[v];
      if (!plane.empty()) q[i] = plane[v];
    }
    added.fold = fold(q);
  }
  if (hinges.empty())
    throw std::invalid_argument("the mesh has no edge between two triangles, so it cannot bend");
  return hinges;
}

DirectionalMean directional_mean(const RestMesh& rest,
                                 const std::function<double(const MeshHinge&)>& stiffness, int power) {
  const auto all = directions();
  std::array<double, std::tuple_size_v<decltype(directions())>> sums{};
  for (const MeshHinge& hinge : mesh_hinges(rest)) {
    const double k = stiffness(hinge);
    for (std::size_t d = 0; d < all.size(); ++d) sums[d] += k * std::pow(value_in(hinge.fold, all[d]), power);
  }
  const double area = std::accumulate(rest.areas().begin(), rest.areas().end(), 0.0);
  for (double& sum : sums) sum /= area;
  DirectionalMean result{.mean = std::accumulate(sums.begin(), sums.end(), 0.0) / sums.size()};
  const auto [least, most] = std::ranges::minmax(sums);
  if (!plane_coordinates(rest).empty()) result.range = {least, most};
  return result;
}

}  // namespace bendlab
