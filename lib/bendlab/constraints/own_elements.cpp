#include "bendlab/constraints/own_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {
namespace {

std::vector<int> all_of(const OwnElements& list) {
  std::vector<int> all(list.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<double> corners_of(const OwnElements& list, const Positions& positions) {
  std::vector<double> corners;
  corners.reserve(3 * list.vertices.size());
  for (const int v : list.vertices)
    for (int axis = 0; axis < 3; ++axis) corners.push_back(positions(v, axis));
  return corners;
}

// The longest distance between two corners that are no directors, m.
double size_of(std::span<const double> corners, std::size_t directors) {
  corners = corners.first(corners.size() - 3 * directors);
  double square = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    for (std::size_t j = i + 3; j < corners.size(); j += 3)
      square = std::max(
          square,
          (Eigen::Map<const Vector3>(&corners[i]) - Eigen::Map<const Vector3>(&corners[j])).squaredNorm());
  return std::sqrt(square);
}

// The values and gradients of a group of elements at the present positions.
struct Evaluated {
  std::vector<double> corners, values, gradients;

  template <class Real>
  Evaluated(const Places<Real>& places, const OwnBatch<Real>& batch, const std::vector<int>& group,
            bool constraints = true)
      : corners(3 * group.size() * batch.list.arity), values(group.size()), gradients(corners.size()) {
    double* next = corners.data();
    for (const int c : group)
      for (const int v : batch.list.corners(static_cast<std::size_t>(c))) {
        const auto at = static_cast<std::size_t>(v);
        Vector3 p = places.moved[at].vector().template cast<double>();
        if (places.base != nullptr) p += places.base[at].vector().template cast<double>();
        next = std::copy_n(p.data(), 3, next);
      }
    batch.list.function->evaluate(group, corners, values, gradients);
    if (constraints && batch.list.function->is_energy()) as_constraints();
  }

  std::size_t width() const { return gradients.size() / std::max<std::size_t>(1, values.size()); }
  std::span<const double> corners_at(std::size_t i) const {
    return std::span(corners).subspan(i * width(), width());
  }
  Vector3 gradient(std::size_t i, std::size_t corner) const {
    return Eigen::Map<const Vector3>(&gradients[i * width() + 3 * corner]);
  }

 private:
  // Replaces an energy U by C = √(2 U), so that U = ½ C². At the minimum of U the gradient has no direction.
  void as_constraints() {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = values[i] > 0 ? std::sqrt(2 * values[i]) : std::nan("");
      for (std::size_t j = 0; j < width(); ++j) gradients[i * width() + j] /= values[i];
    }
  }
};

// Σ w|∇C|², or 0 if the gradient is not finite or only a rounding error (see least_lever).
double weighted_square(const Evaluated& group, std::size_t i, std::span<const double> inverse_mass) {
  double sum = 0, whole = 0, most = 0;
  for (std::size_t corner = 0; corner < inverse_mass.size(); ++corner) {
    const double square = group.gradient(i, corner).squaredNorm();
    sum += inverse_mass[corner] * square, whole += square;
    most = std::max(most, inverse_mass[corner]);
  }
  return std::isfinite(group.values[i]) && std::isfinite(whole) && sum > least_lever<double> * most * whole
             ? sum
             : 0;
}

}  // namespace

OwnValues evaluate(const OwnElements& list, const Positions& positions) {
  OwnValues all{std::vector<double>(list.size()), std::vector<double>(3 * list.vertices.size())};
  if (list.size() > 0)
    list.function->evaluate(all_of(list), corners_of(list, positions), all.values, all.gradients);
  return all;
}

std::vector<Eigen::MatrixXd> second_derivatives(const OwnElements& list, const Positions& positions,
                                                std::size_t first) {
  constexpr double relative_step = 1e-6;  // of an element's size; the step's square is as small as rounding
  const std::vector<int> all = all_of(list);
  const std::vector<double> corners = corners_of(list, positions);
  const std::size_t width = 3 * list.arity;
  std::vector<double> step(list.size()), moved = corners, values(list.size());
  for (std::size_t c = 0; c < list.size(); ++c)
    step[c] = relative_step * size_of(std::span(corners).subspan(c * width, width), list.directors);
  std::array<std::vector<double>, 2> gradients{std::vector<double>(corners.size()),
                                               std::vector<double>(corners.size())};
  std::vector<Eigen::MatrixXd> second(
      list.size(), Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(width), static_cast<Eigen::Index>(width)));
  for (std::size_t i = first; i < width; ++i) {
    for (const int side : {0, 1}) {
      for (std::size_t c = 0; c < list.size(); ++c)
        moved[c * width + i] = corners[c * width + i] + (side == 0 ? -step[c] : step[c]);
      list.function->evaluate(all, moved, values, gradients[static_cast<std::size_t>(side)]);
    }
    for (std::size_t c = 0; c < list.size(); ++c) {
      moved[c * width + i] = corners[c * width + i];
      for (std::size_t j = first; j < width; ++j)
        second[c](static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) =
            (gradients[1][c * width + j] - gradients[0][c * width + j]) / (2 * step[c]);
    }
  }
  for (Eigen::MatrixXd& matrix : second) matrix = (0.5 * (matrix + matrix.transpose())).eval();
  return second;
}

double elastic_energy(const OwnElements& list, const Positions& positions) {
  const OwnValues all = evaluate(list, positions);
  double sum = 0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    const double value = all.values[c];
    if (std::isfinite(value))
      sum += (list.function->is_energy() ? value : 0.5 * value * value) / list.softness[c];
  }
  return sum;
}

template <class Real>
OwnBatch<Real> make_own_batch(OwnElements list, BatchOrder order) {
  OwnBatch<Real> batch;
  batch.count = list.size();
  // If no elements of a colour share a vertex, evaluate() takes the whole colour at once, otherwise one
  // element.
  const auto add = [&](std::size_t first_stack, std::size_t last_stack) {
    std::vector<int> group;
    for (std::size_t stack = first_stack; stack < last_stack; ++stack)
      for (std::size_t lane = order.stacks[stack]; lane < order.stacks[stack + 1]; ++lane)
        if (const int c = order.constraint(stack, lane); c >= 0) {
          group.push_back(c);
          if (!order.conflict_free) batch.groups.push_back(std::exchange(group, {}));
        }
    if (!group.empty()) batch.groups.push_back(std::move(group));
  };
  for (std::size_t colour = 0; colour + 1 < order.colours.size(); ++colour)
    add(order.colours[colour], order.colours[colour + 1]);
  batch.list = std::move(list), batch.order = std::move(order);
  return batch;
}

template <class Real>
void project(const Places<Real>& places, OwnBatch<Real>& batch, Real substep, bool backwards) {
  const bool compliant = batch.kind == StiffnessKind::compliance;
  const double h = substep;
  std::vector<double> inverse_mass(batch.list.arity);
  for (std::size_t step = 0; step < batch.groups.size(); ++step) {
    const std::vector<int>& group = batch.groups[backwards ? batch.groups.size() - 1 - step : step];
    const Evaluated now(places, batch, group);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto c = static_cast<std::size_t>(group[i]);
      const std::span<const int> vertices = batch.list.corners(c);
      for (std::size_t corner = 0; corner < vertices.size(); ++corner) {
        const auto v = static_cast<std::size_t>(vertices[corner]);
        inverse_mass[corner] = places.base != nullptr ? places.base[v].w : places.moved[v].w;
      }
      const double w = weighted_square(now, i, inverse_mass);
      if (!(w > 0)) continue;
      const double alpha = compliant ? batch.compliance * batch.list.softness[c] / (h * h) : 0;
      double change = compliant ? (-now.values[i] - alpha * batch.multiplier[c]) / (w + alpha)
                                : -batch.k * now.values[i] / w;
      double farthest = 0;
      for (std::size_t corner = 0; corner < vertices.size(); ++corner)
        farthest =
            std::max(farthest, std::abs(change) * inverse_mass[corner] * now.gradient(i, corner).norm());
      if (const double reach = largest_move * size_of(now.corners_at(i), batch.list.directors);
          farthest > reach)
        change *= reach / farthest;
      for (std::size_t corner = 0; corner < vertices.size(); ++corner) {
        Point<Real>& moved = places.moved[static_cast<std::size_t>(vertices[corner])];
        const Vector3 way = inverse_mass[corner] * change * now.gradient(i, corner);
        moved.set((moved.vector().template cast<double>() + way).template cast<Real>());
      }
      if (compliant) batch.multiplier[c] += change;
    }
  }
}

template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const OwnBatch<Real>& batch) {
  if (batch.count == 0) return;
  const std::vector<int> all = all_of(batch.list);
  const Evaluated now(Places<Real>(const_cast<Point<Real>*>(points)), batch, all, false);
  const bool is_energy = batch.list.function->is_energy();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const double slope = (is_energy ? 1 : now.values[c]) / (batch.compliance * batch.list.softness[c]);
    if (!std::isfinite(now.values[c])) continue;
    for (std::size_t corner = 0; corner < batch.list.arity; ++corner) {
      Point<Real>& force = forces[static_cast<std::size_t>(batch.list.corners(c)[corner])];
      force.set(force.vector() - (slope * now.gradient(c, corner)).template cast<Real>());
    }
  }
}

template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const OwnBatch<Real>& batch, Real k) {
  std::vector<double> inverse_mass(batch.list.arity);
  for (const std::vector<int>& group : batch.groups) {
    const Evaluated now(Places<Real>(const_cast<Point<Real>*>(points)), batch, group);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::span<const int> vertices = batch.list.corners(static_cast<std::size_t>(group[i]));
      double rate = 0;
      for (std::size_t corner = 0; corner < vertices.size(); ++corner) {
        const auto v = static_cast<std::size_t>(vertices[corner]);
        inverse_mass[corner] = points[v].w;
        rate += now.gradient(i, corner).dot(velocities[v].vector().template cast<double>());
      }
      const double w = weighted_square(now, i, inverse_mass);
      if (!(w > 0)) continue;
      for (std::size_t corner = 0; corner < vertices.size(); ++corner) {
        Point<Real>& velocity = velocities[static_cast<std::size_t>(vertices[corner])];
        const Vector3 change = -double{k} * rate / w * inverse_mass[corner] * now.gradient(i, corner);
        velocity.set((velocity.vector().template cast<double>() + change).template cast<Real>());
      }
    }
  }
}

#define BENDLAB_OWN_BATCH(Real)                                                      \
  template void add_forces(const Point<Real>*, Point<Real>*, const OwnBatch<Real>&); \
  template OwnBatch<Real> make_own_batch<Real>(OwnElements, BatchOrder);             \
  template void project(const Places<Real>&, OwnBatch<Real>&, Real, bool);           \
  template void damp_by_oracle(const Point<Real>*, Point<Real>*, const OwnBatch<Real>&, Real);
BENDLAB_OWN_BATCH(float)
BENDLAB_OWN_BATCH(double)
#undef BENDLAB_OWN_BATCH

}  // namespace bendlab
