// Constraints that models build, bent shapes, and the energy of these constraints in these shapes.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "bendlab/constraints/energy.hpp"
#include "tests/support.hpp"

namespace bendlab::test {

using Changed = Changes;

/// The constraints of a model, with some settings changed from their defaults.
inline BendingConstraints built(std::string_view model, const RestMesh& rest, const Pins& pins,
                                const Changed& changed = {}) {
  return constraints_of(chosen(*find_bending_model(model), changed), {rest, pins});
}
inline BendingConstraints built(std::string_view model, const RestMesh& rest, const Changed& changed = {}) {
  return built(model, rest, make_pins(rest, {}, 0), changed);
}

/// Bending energy, J, at compliance 1.
inline double energy(const BendingConstraints& constraints, const Positions& positions) {
  const Directors& directors = constraints.directors;
  const Positions points = joined(positions, relaxed_directors(directors, constraints.elements,
                                                               constraints.own, positions, directors.rest));
  return elastic_energy(constraints.distance, points) + elastic_energy(constraints.elements, points) +
         elastic_energy(constraints.own, points);
}

/// A flat sheet laid on a cylinder of curvature κ, whose axis is at `angle` to the x axis.
inline Positions bent(const RestMesh& rest, double curvature, double angle) {
  Positions positions = rest.positions();
  const double c = std::cos(angle), s = std::sin(angle);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double along = c * positions(v, 0) + s * positions(v, 1);
    const double across = -s * positions(v, 0) + c * positions(v, 1), turn = across * curvature;
    const double x = std::sin(turn) / curvature, z = (1 - std::cos(turn)) / curvature;
    positions.row(v) << c * along - s * x, s * along + c * x, z;
  }
  return positions;
}

}  // namespace bendlab::test
