#include "bendlab/constraints/build.hpp"

namespace bendlab {

StrainConstraints strain_constraints(const RestMesh& rest, const Pins& pins,
                                     const std::vector<InverseRest>& inverse_rest) {
  StrainConstraints list;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    if (pins.pinned(corner(0)) && pins.pinned(corner(1)) && pins.pinned(corner(2))) continue;
    list.vertices.push_back({corner(0), corner(1), corner(2)});
    list.inverse_rest.push_back(inverse_rest[static_cast<std::size_t>(t)]);
  }
  return list;
}

DistanceConstraints edge_springs(const RestMesh& rest, const Pins& pins) {
  DistanceConstraints list;
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e) {
    const int a = rest.edges()(e, 0), b = rest.edges()(e, 1);
    if (pins.pinned(a) && pins.pinned(b)) continue;
    list.vertices.push_back({a, b});
    list.rest_length.push_back((rest.position(a) - rest.position(b)).norm());
  }
  return list;
}

std::vector<double> lumped_masses(const RestMesh& rest, double density) {
  std::vector<double> mass(static_cast<std::size_t>(rest.vertex_count()), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      mass[static_cast<std::size_t>(rest.triangles()(t, c))] +=
          density * rest.areas()[static_cast<std::size_t>(t)] / 3;
  return mass;
}

}  // namespace bendlab
