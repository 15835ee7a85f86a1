#include "bendlab/bending/push_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bendlab {
namespace {

// Stiffness of a membrane that is projected once per substep, in units of m / h² (m: mass of a vertex, h:
// substep). The value 1 predicts that a sheet grows by T h² / m (push_bound.hpp). The measured growth is
// 0.8 to 0.9 of this prediction on irregular sheets, 1.0 to 1.1 on the equilateral lattice, 1.1 to 1.2 on
// alternating diagonals, and 0.6 with both diagonals (sheets of 16 cells, B = 10⁻⁵ to 1.5·10⁻³ N m, 16 to
// 256 substeps, an excess of 0.1 and 1). One substep of 10 iterations resists up to 1.4 times the push of
// 10 substeps of one iteration.
constexpr double membrane_of_one_projection = 1;

constexpr double at_rest = 1e-6;  // relative to a spring's length, as in calibration.cpp

double bounded(double excess, double growth) {
  return 1 / (1 / excess + 1 / growth);
}

}  // namespace

double push_tension(const DistanceConstraints& springs, const RestMesh& rest, double compliance) {
  double virial = 0;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [a, b] = springs.vertices[s];
    const double length = (rest.position(a) - rest.position(b)).norm(), push = springs.rest(s) - length,
                 softness = springs.softness.empty() ? 1 : springs.softness[s];
    if (push > at_rest * length) virial += push / (compliance * softness) * length;
  }
  const double area = std::accumulate(rest.areas().begin(), rest.areas().end(), 0.0);
  return virial > 0 && area > 0 ? virial / (2 * area) : 0;
}

std::optional<std::string> push_on_membrane_warning(double tension, double compliance) {
  if (!(tension * compliance > tolerated_growth)) return std::nullopt;
  return fmt::format(
      "the springs push with {:.3g} N/m, and the stated membrane (stiffness {:.3g} N/m) gives way: the sheet "
      "grows by up to {:.0f} %, but not by more than the springs' excess. A membrane compliance of {:.2g} "
      "m/N limits the growth to {:.0f} %. Longer springs (/bending/prestressed/radius) help too, because the "
      "push falls as the square of their length",
      tension, 1 / compliance, 100 * tension * compliance, 0.9 * tolerated_growth / tension,
      100 * tolerated_growth);
}

std::optional<PushBound> bound_push(DistanceConstraints& springs, const RestMesh& rest,
                                    std::span<const double> mass, double substep, int projections) {
  PushBound bound;
  std::vector<double> length(springs.size());
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [a, b] = springs.vertices[s];
    length[s] = (rest.position(a) - rest.position(b)).norm();
    const double push = springs.rest(s) - length[s];
    if (!(push > at_rest * length[s])) continue;
    bound.stated = std::max(bound.stated, push / length[s]);
    bound.length = std::max(bound.length, length[s]);
  }
  const double total_mass = std::accumulate(mass.begin(), mass.end(), 0.0);
  bound.tension = push_tension(springs, rest, 1);
  if (!(bound.tension > 0 && total_mass > 0)) return std::nullopt;
  bound.growth = bound.tension * substep * substep /
                 (membrane_of_one_projection * projections * total_mass / static_cast<double>(mass.size()));
  bound.taken = bound.stated, bound.expected = bounded(bound.stated, bound.growth);
  if (bound.expected <= tolerated_growth) return bound;
  // `expected` is smaller than the excess and the growth, so these are larger than tolerated_growth here.
  bound.taken = 1 / (1 / tolerated_growth - 1 / bound.growth);
  const double smaller = bound.taken / bound.stated;
  springs.store_rest_lengths();
  for (std::size_t s = 0; s < springs.size(); ++s)
    if (const double push = springs.rest(s) - length[s]; push > at_rest * length[s])
      springs.rest_length[s] = length[s] + smaller * push, springs.softness[s] *= smaller;
  const double largest = 1 / (1 / tolerated_growth - 1 / bound.stated);  // G that allows the stated excess
  constexpr double most = std::numeric_limits<int>::max();
  bound.substeps_factor = static_cast<int>(std::min(most, std::ceil(std::sqrt(bound.growth / largest))));
  return bound;
}

std::vector<BendingFact> facts_of(const PushBound& bound) {
  return {{"push_tension", bound.tension, "tension with which the springs stretch the flat sheet", "N/m"},
          {"push_growth", bound.expected,
           "estimated relative growth of the sheet with the stated excess, because the solver does not "
           "balance the push"},
          {"excess_taken", bound.taken,
           "excess that the springs have; lower than the stated excess if the sheet would grow too much with "
           "the stated excess"}};
}

std::optional<std::string> push_warning(const PushBound& bound) {
  if (bound.taken == bound.stated) return std::nullopt;
  return fmt::format(
      "the springs push with {:.3g} N/m, which the stated substeps and iterations cannot balance: with the "
      "stated excess of {:.3g} the sheet would grow by about {:.0f} %. The excess is lowered to {:.3g}: the "
      "sheet then grows by about {:.0f} %, and the moment is linear up to a curvature of {:.3g}/m instead of "
      "{:.3g}/m. With {} times as many substeps the solver can use the stated excess",
      bound.tension, bound.stated, 100 * bound.expected, bound.taken, 100 * tolerated_growth,
      std::sqrt(48 * bound.taken) / bound.length, std::sqrt(48 * bound.stated) / bound.length,
      bound.substeps_factor);
}

}  // namespace bendlab
