#include "experiments/advise/front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "experiments/config/counted.hpp"

namespace bendlab {
namespace {

bool faster(const Rated& a, const Rated& b) {
  return std::tie(a.cpu_s, a.error) < std::tie(b.cpu_s, b.error);
}

bool more_accurate(const Rated& a, const Rated& b) {
  return std::tie(a.error, a.cpu_s) < std::tie(b.error, b.cpu_s);
}

double beyond(const Rated& point) {
  return beyond_limits(point.error, point.strained);
}

bool less_beyond(const Rated& a, const Rated& b) {
  return std::tuple(beyond(a), a.cpu_s) < std::tuple(beyond(b), b.cpu_s);
}

std::optional<Rated> first_by(std::span<const Rated> points, bool (*before)(const Rated&, const Rated&)) {
  const auto first = std::ranges::min_element(points, before);
  return first == points.end() ? std::nullopt : std::optional(*first);
}

}  // namespace

Unfit unfit(const Rated& point) {
  return unfit(point.error, point.strained);
}

std::vector<Rated> fit_ones(std::span<const Rated> points) {
  std::vector<Rated> kept;
  std::ranges::copy_if(points, std::back_inserter(kept),
                       [](const Rated& point) { return unfit(point) == Unfit::no; });
  return kept;
}

std::vector<Rated> front_of(std::span<const Rated> points) {
  std::vector<Rated> sorted = fit_ones(points), front;
  std::ranges::stable_sort(sorted, faster);
  for (Rated& point : sorted)
    if (front.empty() || point.error < front.back().error) front.push_back(std::move(point));
  return front;
}

std::vector<Rated> unfit_front_of(std::span<const Rated> points) {
  std::vector<Rated> sorted(points.begin(), points.end()), front;
  std::ranges::stable_sort(sorted, faster);
  for (Rated& point : sorted) {
    if (unfit(point) == Unfit::no) break;
    if (front.empty() || beyond(point) < beyond(front.back())) front.push_back(std::move(point));
  }
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

std::string setting_text(const Setting& setting) {
  return fmt::format("{}, {}, {}, {}, {}, {}", setting.model, setting.variant.method,
                     counted(setting.substeps, "substep"), counted(setting.iterations, "iteration"),
                     setting.double_precision ? "double" : "single", variant_text(setting.variant));
}

std::string kind_text(const Setting& setting) {
  return fmt::format("{} ({}, {})", setting.model, setting.variant.method, variant_text(setting.variant));
}

}  // namespace bendlab
