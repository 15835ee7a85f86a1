#include "bendlab/solver/elastic_metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "bendlab/constraints/corners.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

class Assembly {
 public:
  Assembly(const std::vector<int>& free_index, std::size_t free_count) : index_(free_index) {
    for (std::size_t i = 0; i < free_count; ++i)
      entries_.emplace_back(static_cast<int>(i), static_cast<int>(i), 0);
  }

  // Adds value(i, j) to the matrix entry of vertices[i] and vertices[j], if both vertices are free.
  template <class ValueAt>
  void add(std::span<const int> vertices, const ValueAt& value) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = 0; j < vertices.size(); ++j) {
        const int row = index_[static_cast<std::size_t>(vertices[i])],
                  column = index_[static_cast<std::size_t>(vertices[j])];
        if (column >= 0 && row >= column) entries_.emplace_back(row, column, value(i, j));
      }
  }

  Eigen::SparseMatrix<double> matrix(std::size_t free_count) const {
    const auto n = static_cast<Eigen::Index>(free_count);
    Eigen::SparseMatrix<double> lower(n, n);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    return lower;
  }

 private:
  const std::vector<int>& index_;
  std::vector<Eigen::Triplet<double>> entries_;
};

// κ of the constraint C (see the header); 0 if C has no gradient at rest. At a corner of the sheet C may
// depend on directors alone.
template <class Kind>
std::array<double, Kind::arity> weights_of(const ConstraintValue<double, Kind::arity>& c) {
  constexpr std::size_t vertices = Kind::arity - directors_of<Kind>;
  std::array<double, Kind::arity> weights{};
  if (!c.defined) return weights;
  Vector3 largest = Vector3::Zero();
  for (std::size_t i = 0; i < vertices; ++i)
    if (c.gradient[i].squaredNorm() > largest.squaredNorm()) largest = c.gradient[i];
  if (largest.squaredNorm() > 0)
    for (std::size_t i = 0; i < vertices; ++i) weights[i] = c.gradient[i].dot(largest.normalized());
  for (std::size_t i = vertices; i < Kind::arity; ++i) weights[i] = c.gradient[i].x();
  return weights;
}

// Calls add(κ) for every part of an element's energy.
template <class Kind, class Add>
void for_weights(const std::array<Vector3, Kind::arity>& corners, const ElementList<Kind>& list,
                 std::size_t element, const Add& add) {
  const auto& rest = list.rest[element];
  if constexpr (requires { typename Kind::IsSumOfVertices; }) {  // |Kx| has no gradient where a sheet is flat
    std::array<double, Kind::arity> weights;
    std::copy_n(rest.begin(), weights.size(), weights.begin());
    add(weights);
  } else if constexpr (HasComponents<Kind>) {
    for (std::size_t k = 0; k < Kind::components; ++k)
      add(weights_of<Kind>(Kind::template component<double>(corners, rest, list.law, k)));
  } else {
    add(weights_of<Kind>(Kind::template value<double>(corners, rest, list.law)));
  }
}

// For each pair of vertices, adds the trace of the pair's block of the Hessian at rest. The trace is the
// stiffness along the normal, because bending of a flat sheet at rest resists only along the normal.
// Directors and vertices are not coupled, because a coordinate of a director belongs to no axis.
void add_own(const OwnElements& own, const Positions& rest, double compliance, Assembly& bending) {
  if (own.size() == 0) return;
  const bool is_energy = own.function->is_energy();
  const OwnValues at_rest = evaluate(own, rest);
  const std::vector<Eigen::MatrixXd> second =
      is_energy ? second_derivatives(own, rest) : std::vector<Eigen::MatrixXd>{};
  for (std::size_t c = 0; c < own.size(); ++c) {
    if (!std::isfinite(at_rest.values[c])) continue;
    const double stiffness = 1 / (compliance * own.softness[c]);
    const auto gradient = [&](std::size_t i) {
      return Eigen::Map<const Vector3>(&at_rest.gradients[3 * (c * own.arity + i)]);
    };
    bending.add(own.corners(c), [&](std::size_t i, std::size_t j) {
      const auto row = static_cast<Eigen::Index>(3 * i), column = static_cast<Eigen::Index>(3 * j);
      const std::size_t first_director = own.arity - own.directors;
      if ((i < first_director) != (j < first_director)) return 0.0;
      return stiffness *
             (is_energy ? second[c].block<3, 3>(row, column).trace() : gradient(i).dot(gradient(j)));
    });
  }
}

}  // namespace

ElasticMetric::ElasticMetric(const SimulationInput& input)
    : free_index_(input.point_count(), -1),
      strain_(input.strain),
      compliance_(input.strain_stiffness.compliance) {
  const std::array<double, 3>& softness = input.strain_stiffness.softness;
  for (const std::size_t axis : {0U, 1U}) axis_softness_[axis] = std::min(softness[axis], softness[2]);
  for (std::size_t v = 0; v < free_index_.size(); ++v)
    if (input.is_free(v)) {
      free_index_[v] = static_cast<int>(vertices_.size());
      vertices_.push_back(static_cast<int>(v));
    }
  const Positions rest = input.rest.rows() > 0 ? input.rest_points() : input.points();
  find_stiffness_of_springs(input, rest);
  Assembly bending(free_index_, vertices_.size());
  const double compliance = input.bending_stiffness.compliance;
  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    if (OneSided<Kind> && list.size() > 0)
      throw std::invalid_argument(
          fmt::format("{}: the force of {} jumps where the element is straight, so no constant matrix "
                      "approximates this force. Choose the method newton, or another bending model",
                      input.method.name(), Kind::name));
    for (std::size_t e = 0; e < list.size(); ++e) {
      const double stiffness = 1 / (compliance * list.softness[e]);
      // Directors and vertices are not coupled, because a coordinate of a director belongs to no axis.
      constexpr std::size_t first_director = Kind::arity - directors_of<Kind>;
      for_weights<Kind>(corners(rest, list.vertices[e]), list, e, [&](const auto& weight) {
        bending.add(list.vertices[e], [&](std::size_t i, std::size_t j) {
          return (i < first_director) == (j < first_director) ? stiffness * weight[i] * weight[j] : 0.0;
        });
      });
    }
  });
  add_own(input.own, rest, compliance, bending);
  bending_ = bending.matrix(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i)  // a director that no element reads
    if (static_cast<std::size_t>(vertices_[i]) >= input.mass.size()) {
      const auto row = static_cast<Eigen::Index>(i);
      if (bending_.coeff(row, row) == 0) bending_.coeffRef(row, row) = 1;
    }
}

// The stiffness at a vertex is ½ Σ L²/α over the springs at the vertex, divided by the vertex's area. At
// equal strain, a membrane of this stiffness stores as much energy as the springs (of length L).
void ElasticMetric::find_stiffness_of_springs(const SimulationInput& input, const Positions& rest) {
  stiffness_of_springs_.assign(input.distance.size() > 0 ? strain_.size() : 0, 0);
  if (stiffness_of_springs_.empty()) return;
  std::vector<double> energy(free_index_.size(), 0), area(free_index_.size(), 0);
  for (std::size_t c = 0; c < input.distance.size(); ++c) {
    const auto [a, b] = input.distance.vertices[c];
    const double softness = input.distance.softness.empty() ? 1 : input.distance.softness[c],
                 half = 0.5 * (rest.row(a) - rest.row(b)).squaredNorm() /
                        (input.bending_stiffness.compliance * softness);
    energy[static_cast<std::size_t>(a)] += half, energy[static_cast<std::size_t>(b)] += half;
  }
  for (std::size_t t = 0; t < strain_.size(); ++t)
    for (const int v : strain_.vertices[t]) area[static_cast<std::size_t>(v)] += rest_area(t) / 3;
  for (std::size_t t = 0; t < strain_.size(); ++t)
    for (const int v : strain_.vertices[t])
      stiffness_of_springs_[t] +=
          energy[static_cast<std::size_t>(v)] / (3 * area[static_cast<std::size_t>(v)]);
}

double ElasticMetric::rest_area(std::size_t t) const {
  const std::array<double, 4>& q = strain_.inverse_rest[t];
  return 0.5 / std::abs(q[0] * q[3] - q[1] * q[2]);
}

Eigen::SparseMatrix<double> ElasticMetric::matrix(std::span<const double> softness, double bending) const {
  constexpr double most = 0.01;
  Eigen::SparseMatrix<double> sum = membrane(softness);
  if (!(bending * bending_.diagonal().array() <= most * sum.diagonal().array()).all())
    sum += bending * bending_;
  return sum;
}

Eigen::SparseMatrix<double> ElasticMetric::membrane(std::span<const double> softness) const {
  Assembly membrane(free_index_, vertices_.size());
  for (std::size_t t = 0; t < strain_.size(); ++t) {
    const std::array<double, 4>& q = strain_.inverse_rest[t];
    for (const std::size_t column : {0U, 1U}) {
      const double stated = strain_.softness.empty() ? 1 : strain_.softness[t];
      const double stiffness = 1 / (softness[t] * compliance_ * stated * axis_softness_[column]) +
                               (stiffness_of_springs_.empty() ? 0 : stiffness_of_springs_[t]);  // N/m
      const double scale = stiffness * rest_area(t);
      const std::array<double, 3> weight = {-q[column] - q[2 + column], q[column], q[2 + column]};
      membrane.add(strain_.vertices[t],
                   [&](std::size_t i, std::size_t j) { return scale * weight[i] * weight[j]; });
    }
  }
  return membrane.matrix(vertices_.size());
}

std::size_t ElasticMetric::memory_bytes() const {
  return bytes_of(vertices_) + bytes_of(free_index_) + bytes_of(bending_) + bytes_of(strain_.vertices) +
         bytes_of(strain_.inverse_rest) + bytes_of(stiffness_of_springs_);
}

}  // namespace bendlab
