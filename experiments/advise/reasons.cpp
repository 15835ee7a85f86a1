#include "experiments/advise/reasons.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bendlab/scene/counted.hpp"

namespace bendlab {
namespace {

template <class Value>
double least(const std::vector<Rated>& points, Value value) {
  return value(*std::ranges::min_element(points, {}, value));
}

// Why these points, all unfit, are unfit: how many for which reason, and how far the best of them is off.
std::string unfit_text(const std::vector<Rated>& points, const Advice& advice) {
  std::map<Unfit, std::vector<Rated>> because;
  for (const Rated& point : points) because[unfit(point)].push_back(point);
  std::vector<std::string> parts;
  const std::string beyond =
      advice.reference.strain > 0.01 * largest_strain
          ? fmt::format(" beyond the {} of the reference", percent_text(advice.reference.strain))
          : "";
  for (const auto& [why, those] : because) {
    const std::string count = std::to_string(those.size());
    if (why == Unfit::implausible) parts.push_back(count + " gave an implausible run");
    if (why == Unfit::strain)
      parts.push_back(fmt::format("{} stretched the cloth by more than {}{} (rms; the least: {})", count,
                                  percent_text(largest_strain), beyond,
                                  percent_text(least(those, [](const Rated& p) { return p.strained.rms; }))));
    if (why == Unfit::stretch)
      parts.push_back(
          fmt::format("{} stretched a triangle to more than {} times its length (the least: {:.3g})", count,
                      largest_stretch, least(those, [](const Rated& p) { return p.strained.largest; })));
    if (why == Unfit::error)
      parts.push_back(fmt::format("{} had more than {} of error (the least: {})", count,
                                  percent_text(largest_error),
                                  percent_text(least(those, [](const Rated& p) { return p.error; }))));
  }
  return fmt::format("{}.", fmt::join(parts, "; "));
}

// If settings agree with each other, something else is wrong.
bool all_alike(const std::vector<Rated>& points) {
  constexpr std::size_t enough = 4;
  constexpr double alike = 1.1;
  if (points.size() < enough) return false;
  const auto [least, most] = std::ranges::minmax_element(points, {}, &Rated::error);
  return std::isfinite(most->error) && most->error <= alike * least->error;
}

std::string reference_text(const Advice& advice) {
  if (!(advice.reference.strain <= largest_reference_strain))
    return fmt::format(
        "The reference itself is stretched by {} (rms), as no cloth is, so that errors against it mean "
        "nothing: it flew apart, or lengths are not in metres, the density not in kg/m² or the membrane's "
        "compliance not in m/N.",
        percent_text(advice.reference.strain));
  return fmt::format(
      "The reference itself is known to {} only, so that errors against it mean nothing: cloth that falls "
      "and folds moves chaotically. A shorter /duration is known better.",
      percent_text(*advice.reference.gap));
}

std::string budget_text(const std::vector<Rated>& measured, double budget, const Advice& advice) {
  std::vector<Rated> within;
  std::ranges::copy_if(measured, std::back_inserter(within),
                       [&](const Rated& point) { return point.cpu_s <= budget; });
  if (within.empty())
    return fmt::format("Nothing is that fast: the fastest setting takes {:.3g} ms.",
                       1e3 * least(measured, [](const Rated& p) { return p.cpu_s; }));
  return fmt::format("Nothing fit was found within that time. Of {} that fast, {}",
                     counted(within.size(), "setting"), unfit_text(within, advice));
}

}  // namespace

bool anything_fit(const Advice& advice) {
  return reference_tells(advice.reference) && !advice.front.empty();
}

std::vector<std::string> why_none(const Advice& advice, const Demand& demand, double time_limit_s) {
  if (advice.best) return {};
  if (!reference_tells(advice.reference)) return {reference_text(advice)};
  std::vector<std::string> sentences;
  const std::vector<Rated>& measured = advice.points;
  if (demand.error && advice.reference.gap.value_or(0) >= *demand.error)
    sentences.push_back(
        fmt::format("The reference itself is known to {} only: cloth that falls and folds moves chaotically.",
                    percent_text(*advice.reference.gap)));
  if (measured.empty())
    sentences.emplace_back("No setting gave an error.");
  else if (advice.front.empty())
    sentences.push_back(
        fmt::format("Of {} run, {}", counted(measured.size(), "setting"), unfit_text(measured, advice)));
  else if (demand.cpu_s)
    sentences.push_back(budget_text(measured, *demand.cpu_s, advice));
  if (advice.front.empty() && all_alike(measured))
    sentences.emplace_back(
        "They all agree with each other, but not with the reference: the cloth has not come to rest by the "
        "end of /duration, or it rests in another pose than the reference.");
  if (!advice.not_tried.empty())
    sentences.push_back(
        fmt::format("{} not tried within the time limit ({:.4g} s): the same command goes on with them, and "
                    "gets further with a longer --time-limit.",
                    advice.not_tried.size() == 1 ? "A setting was"
                                                 : fmt::format("{} settings were", advice.not_tried.size()),
                    time_limit_s));
  return sentences;
}

}  // namespace bendlab
