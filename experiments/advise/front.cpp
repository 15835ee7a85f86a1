#include "experiments/advise/front.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace bendlab {
namespace {

bool faster(const Rated& a, const Rated& b) {
  return std::tie(a.cpu_s, a.error) < std::tie(b.cpu_s, b.error);
}

bool more_accurate(const Rated& a, const Rated& b) {
  return std::tie(a.error, a.cpu_s) < std::tie(b.error, b.cpu_s);
}

bool less_beyond(const Rated& a, const Rated& b) {
  return std::tuple(beyond_limits(a.error, a.strained), a.cpu_s) <
         std::tuple(beyond_limits(b.error, b.strained), b.cpu_s);
}

std::optional<Rated> first_by(std::span<const Rated> points, bool (*before)(const Rated&, const Rated&)) {
  const auto first = std::ranges::min_element(points, before);
  return first == points.end() ? std::nullopt : std::optional(*first);
}

std::vector<Rated> fit_ones(std::span<const Rated> points) {
  std::vector<Rated> kept;
  std::ranges::copy_if(points, std::back_inserter(kept),
                       [](const Rated& point) { return unfit(point) == Unfit::no; });
  return kept;
}

}  // namespace

Unfit unfit(const Rated& point) {
  return unfit(point.error, point.strained);
}

double score(const Rated& point, const Demand& demand) {
  const double error = judged_error(point.error, point.strained);
  return demand.error ? point.cpu_s * std::max(1.0, error / *demand.error)
                      : error * std::max(1.0, point.cpu_s / *demand.cpu_s);
}

std::vector<Rated> front_of(std::span<const Rated> points) {
  std::vector<Rated> sorted = fit_ones(points), front;
  std::ranges::stable_sort(sorted, faster);
  for (Rated& point : sorted)
    if (front.empty() || point.error < front.back().error) front.push_back(std::move(point));
  return front;
}

std::vector<Rated> thinned(std::span<const Rated> front) {
  constexpr double much_better = 0.9;
  std::vector<Rated> kept;
  for (const Rated& point : front)
    if (kept.empty() || point.error <= much_better * kept.back().error || &point == &front.back())
      kept.push_back(point);
  return kept;
}

std::optional<Rated> chosen(std::span<const Rated> points, const Demand& demand) {
  std::vector<Rated> fitting = fit_ones(points);
  std::erase_if(fitting, [&](const Rated& point) {
    return demand.error ? point.error > *demand.error : point.cpu_s > *demand.cpu_s;
  });
  return first_by(fitting, demand.error ? faster : more_accurate);
}

std::optional<Rated> nearest(std::span<const Rated> points, const Demand& demand) {
  const std::vector<Rated> fit = fit_ones(points);
  if (!fit.empty()) return first_by(fit, demand.error ? more_accurate : faster);
  std::vector<Rated> in_time(points.begin(), points.end());
  if (demand.cpu_s) std::erase_if(in_time, [&](const Rated& point) { return point.cpu_s > *demand.cpu_s; });
  return in_time.empty() ? first_by(points, less_beyond) : first_by(in_time, less_beyond);
}

}  // namespace bendlab
