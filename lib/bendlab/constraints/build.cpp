#include "bendlab/constraints/build.hpp"

#include <algorithm>
#include <numeric>

#include "bendlab/mesh/bad_triangles.hpp"

namespace bendlab {
namespace {

// #V: whether the vertex belongs to a triangle that is not degenerate.
std::vector<char> on_sound_triangles(const RestMesh& rest, const std::vector<char>& degenerate) {
  std::vector<char> sound(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      sound[static_cast<std::size_t>(rest.triangles()(t, c))] |= degenerate[static_cast<std::size_t>(t)] == 0;
  return sound;
}

}  // namespace

std::vector<char> dispensable_triangles(const RestMesh& rest) {
  std::vector<char> degenerate = triangles_without_area(rest.mesh());
  const std::vector<char> sound = on_sound_triangles(rest, degenerate);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      degenerate[static_cast<std::size_t>(t)] &= sound[static_cast<std::size_t>(rest.triangles()(t, c))];
  return degenerate;
}

StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest,
                                     const std::vector<char>& off, const std::vector<double>& factor) {
  StrainConstraints list;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    if (!off.empty() && off[static_cast<std::size_t>(t)] != 0) continue;
    if (pins.pinned(corner(0)) && pins.pinned(corner(1)) && pins.pinned(corner(2))) continue;
    list.vertices.push_back({corner(0), corner(1), corner(2)});
    list.inverse_rest.push_back(inverse_rest[static_cast<std::size_t>(t)]);
    if (!factor.empty()) list.softness.push_back(1 / factor[static_cast<std::size_t>(t)]);
  }
  return list;
}

DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins) {
  DistanceConstraints list = springs_at_rest_in(rest.positions());
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e) {
    const int a = rest.edges()(e, 0), b = rest.edges()(e, 1);
    if (pins.pinned(a) && pins.pinned(b)) continue;
    list.vertices.push_back({a, b});
  }
  return list;
}

std::vector<double> lumped_masses(const RestMesh& rest, double density, const std::vector<double>& factor) {
  std::vector<double> mass(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      mass[static_cast<std::size_t>(rest.triangles()(t, c))] +=
          density * (factor.empty() ? 1 : factor[static_cast<std::size_t>(t)]) *
          rest.areas()[static_cast<std::size_t>(t)] / 3;
  const std::vector<char> sound = on_sound_triangles(rest, triangles_without_area(rest.mesh()));
  constexpr double least = 0.01;  // of the mean: light compared with the neighbours, but PBD still converges
  const double mean = std::accumulate(mass.begin(), mass.end(), 0.0) / static_cast<double>(mass.size());
  for (std::size_t v = 0; v < mass.size(); ++v)
    if (sound[v] == 0) mass[v] = std::max(mass[v], least * mean);
  return mass;
}

}  // namespace bendlab
