#include "bendlab/solver/simulation.hpp"

namespace bendlab {

Positions SimulationInput::points() const {
  return start_directors.rows() > 0 ? joined(positions, start_directors) : points_at(positions);
}

Positions SimulationInput::points_at(const Positions& vertices) const {
  if (directors.count() == 0) return vertices;
  return joined(vertices, relaxed_directors(directors, elements, own, vertices, directors.rest));
}

Positions SimulationInput::rest_points() const {
  return rest.rows() == 0 ? rest : joined(rest, directors.rest);
}

double SimulationInput::mass_of(std::size_t point) const {
  if (point < mass.size()) return mass[point];
  const auto [a, b] = directors.vertices[point - mass.size()];
  return Directors::mass_share * 0.5 *
         (mass[static_cast<std::size_t>(a)] + mass[static_cast<std::size_t>(b)]);
}

bool SimulationInput::is_free(std::size_t point) const {
  const bool pinned =
      point < mass.size() ? is_pinned[point] != 0 : directors.is_pinned[point - mass.size()] != 0;
  return !pinned && mass_of(point) > 0;
}

}  // namespace bendlab
