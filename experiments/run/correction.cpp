#include "experiments/run/correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "bendlab/constraints/corners.hpp"
#include "bendlab/constraints/oracle.hpp"

namespace bendlab {
namespace {

template <std::size_t N>
double correction_length(const SimulationInput& input, const std::array<int, N>& vertices, int vertex,
                         const ConstraintValue<double, N>& c) {
  if (!c.defined) return 0;
  double sum = 0, own = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const auto v = static_cast<std::size_t>(vertices[i]);
    const double w = input.is_free(v) ? 1 / input.mass_of(v) : 0;
    sum += w * c.gradient[i].squaredNorm();
    if (vertices[i] == vertex) own = w * c.gradient[i].norm();
  }
  return sum > 0 ? std::abs(c.value) * own / sum : 0;
}

template <class Visit>
void for_own_corrections(const SimulationInput& input, const Positions& positions, int vertex, Visit visit) {
  const OwnElements& own = input.own;
  if (own.size() == 0) return;
  const OwnValues all = evaluate(own, positions);
  for (std::size_t c = 0; c < own.size(); ++c) {
    const double value = own.function->is_energy() ? std::sqrt(2 * all.values[c]) : all.values[c];
    const double scale = own.function->is_energy() ? 1 / value : 1;
    const auto gradient = [&](std::size_t corner) {
      return scale * Eigen::Map<const Vector3>(&all.gradients[3 * (c * own.arity + corner)]);
    };
    const auto inverse_mass = [&](int v) {
      const auto point = static_cast<std::size_t>(v);
      return input.is_free(point) ? 1 / input.mass_of(point) : 0;
    };
    const std::span<const int> vertices = own.corners(c);
    double sum = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      sum += inverse_mass(vertices[i]) * gradient(i).squaredNorm();
    if (!(sum > 0) || !std::isfinite(sum)) continue;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (vertex < 0 || vertices[i] == vertex)
        visit(own.function->name(), std::abs(value) * inverse_mass(vertices[i]) * gradient(i).norm() / sum);
  }
}

// Calls visit(kind, correction length) for every constraint of `vertex`; if `vertex` is -1, for every vertex
// of every constraint.
template <class Visit>
void for_corrections(const SimulationInput& input, const Positions& positions, int vertex, bool membrane,
                     Visit visit) {
  const auto visit_vertices = [&](std::string_view kind, const auto& vertices, const auto& value) {
    for (const int v : vertices)
      if (vertex < 0 || v == vertex) visit(kind, correction_length(input, vertices, v, value));
  };
  const auto concerns = [&](const auto& vertices) {
    return vertex < 0 || std::ranges::find(vertices, vertex) != vertices.end();
  };
  const auto springs = [&](std::string_view kind, const DistanceConstraints& list) {
    for (std::size_t c = 0; c < list.size(); ++c)
      if (concerns(list.vertices[c]))
        visit_vertices(kind, list.vertices[c],
                       distance_constraint<double>(corners(positions, list.vertices[c]), list.rest(c)));
  };
  const StrainForm form = input.strain_stiffness.form;
  for (std::size_t c = 0; membrane && c < input.strain.size(); ++c) {
    const auto& vertices = input.strain.vertices[c];
    if (!concerns(vertices)) continue;
    const auto p = corners(positions, vertices);
    const std::array<double, 4>& q = input.strain.inverse_rest[c];
    visit_vertices("strain", vertices, stretch_constraint(p, q, 0, form));
    visit_vertices("strain", vertices, stretch_constraint(p, q, 1, form));
    visit_vertices("strain", vertices, shear_constraint(p, q, form));
  }
  if (membrane) springs("edge", input.edges);
  springs("distance", input.distance);
  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    for (std::size_t c = 0; c < list.size(); ++c)
      if (concerns(list.vertices[c]))
        visit_vertices(
            Kind::name, list.vertices[c],
            Kind::template value<double>(corners(positions, list.vertices[c]), list.rest[c], list.law));
  });
  for_own_corrections(input, positions, vertex, visit);
}

}  // namespace

Correction worst_correction(const SimulationInput& input, const Positions& positions, int vertex) {
  Correction worst;
  if (vertex < 0) return worst;
  for_corrections(input, input.points_at(positions), vertex, true, [&](std::string_view kind, double length) {
    if (length > worst.length) worst = {std::string(kind), length};
  });
  return worst;
}

double largest_bending_correction(const SimulationInput& input, const Positions& positions) {
  double largest = 0;
  for_corrections(input, input.points_at(positions), -1, false,
                  [&](std::string_view, double length) { largest = std::max(largest, length); });
  return largest;
}

}  // namespace bendlab
