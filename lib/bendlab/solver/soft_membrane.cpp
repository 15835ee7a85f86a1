#include "bendlab/solver/soft_membrane.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "bendlab/solver/push_tension.hpp"

namespace bendlab {
namespace {

// Under a load F, a sheet at rest with a membrane of stiffness Y moves by 3.5 F / Y sizes if the sheet hangs
// by patches at two corners, and by a tenth of this if the sheet hangs by a side.
constexpr double moved_per_load = 5;
// The distance from pins within which the membrane is stiffer, in units of error times size. If a sheet
// fills one quadrant of a plane, and the force F pulls at its corner, the strain at the distance r from the
// corner is 4 F / (π Y r). With this
// distance the strain is at most 0.025 everywhere.
constexpr double graded_per_error = 10;

struct Neighbour {
  int vertex;
  double length;
};

// The distance of every vertex from the nearest pinned vertex along edges, m (Dijkstra).
std::vector<double> distances_from_pins(const SimulationInput& input) {
  const Positions& rest = input.rest.rows() > 0 ? input.rest : input.positions;
  std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(rest.rows()));
  for (const std::array<int, 3>& corner : input.strain.vertices)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = corner[i], b = corner[(i + 1) % 3];
      const double length = (rest.row(a) - rest.row(b)).norm();
      neighbours[static_cast<std::size_t>(a)].push_back({b, length});
      neighbours[static_cast<std::size_t>(b)].push_back({a, length});
    }
  std::vector<double> distance(neighbours.size(), std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (input.is_pinned[v]) distance[v] = 0, queue.emplace(0.0, static_cast<int>(v));
  while (!queue.empty()) {
    const auto [way, vertex] = queue.top();
    queue.pop();
    if (way > distance[static_cast<std::size_t>(vertex)]) continue;
    for (const Neighbour& next : neighbours[static_cast<std::size_t>(vertex)])
      if (double& known = distance[static_cast<std::size_t>(next.vertex)]; way + next.length < known)
        known = way + next.length, queue.emplace(known, next.vertex);
  }
  return distance;
}

}  // namespace

SoftMembrane::SoftMembrane(const SimulationInput& input)
    : size_(input.size),
      push_tension_(input.push_tension),
      compliance_(input.strain.size(), input.strain_stiffness.compliance *
                                           input.strain_stiffness.largest_softness() /
                                           input.strain_schedule.least()) {
  for (std::size_t t = 0; t < input.strain.softness.size(); ++t) compliance_[t] *= input.strain.softness[t];
  const std::vector<double> distance = distances_from_pins(input);
  for (const std::array<int, 3>& corner : input.strain.vertices) {
    double sum = 0;
    for (const int v : corner) sum += distance[static_cast<std::size_t>(v)];
    distance_.push_back(sum / 3);
  }
}

std::vector<double> SoftMembrane::softness(double error, double force) const {
  const double needed =
      std::max(moved_per_load * force / (size_ * error), membrane_for_push(push_tension_, error));  // N/m
  std::vector<double> softness;
  softness.reserve(distance_.size());
  for (std::size_t t = 0; t < distance_.size(); ++t) {
    const double most = needed > 0 && compliance_[t] > 0 ? 1 / (compliance_[t] * needed) : 1;
    softness.push_back(
        std::max(1.0, most * std::min(1.0, distance_[t] / (graded_per_error * error * size_))));
  }
  return softness;
}

}  // namespace bendlab
