#include "experiments/advise/fit.hpp"

#include <algorithm>
#include <cmath>

namespace bendlab {

double PowerLaw::at(double work) const {
  return factor * std::pow(work, -exponent);
}

std::optional<PowerLaw> fit_power_law(std::span<const Worked> measured) {
  constexpr double most_scatter = 0.25;
  const auto count = static_cast<double>(measured.size());
  if (measured.size() < 3) return std::nullopt;
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const Worked& point : measured) {
    if (!(point.error > 0)) return std::nullopt;
    const double u = std::log(point.work), v = std::log(point.error);
    x += u, y += v, xx += u * u, xy += u * v, yy += v * v;
  }
  const double spread = xx - x * x / count, slope = (xy - x * y / count) / spread;
  const double left_over = std::max(0.0, (yy - y * y / count) - slope * slope * spread);
  if (!(spread > 0) || std::sqrt(left_over / count) > most_scatter) return std::nullopt;
  const Worked &last = measured.back(), &before = measured[measured.size() - 2];
  const double last_slope = std::log(last.error / before.error) / std::log(last.work / before.work);
  const double exponent = std::min(-slope, -last_slope);
  if (!(exponent > 0)) return std::nullopt;
  return PowerLaw{last.error * std::pow(last.work, exponent), exponent};
}

std::optional<StepCost> fit_step_cost(std::span<const Timed> measured) {
  if (measured.empty()) return std::nullopt;
  // cpu = a s + b s n
  double ss = 0, sn = 0, nn = 0, sc = 0, nc = 0;
  for (const Timed& point : measured) {
    const double s = point.substeps, n = s * point.iterations;
    ss += s * s, sn += s * n, nn += n * n, sc += s * point.cpu_s, nc += n * point.cpu_s;
  }
  const double determinant = ss * nn - sn * sn;
  constexpr double rounding = 1e-9;
  if (determinant > rounding * ss * nn) {
    const StepCost cost{(nn * sc - sn * nc) / determinant, (ss * nc - sn * sc) / determinant};
    if (cost.per_substep >= 0 && cost.per_iteration >= 0) return cost;
    if (cost.per_iteration < 0) return StepCost{sc / ss, 0};
  }
  return StepCost{0, nc / nn};
}

}  // namespace bendlab
