// Why no setting is advised.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "bendlab/scene/counted.hpp"
#include "experiments/advise/advice.hpp"

namespace bendlab {
namespace {

double least(const std::vector<Trial>& trials, double Trial::*value) {
  return (*std::ranges::min_element(trials, {}, value)).*value;
}

// The reasons why all trials are unfit, each with the number of trials and the value of the best trial.
std::string unfit_text(const std::vector<Trial>& trials, double reference_strain) {
  std::map<std::string_view, std::vector<Trial>> by_reason;
  for (const Trial& trial : trials) by_reason[unfit(trial)].push_back(trial);
  std::vector<std::string> parts;
  if (const auto& rejected = by_reason["implausible"]; !rejected.empty())
    parts.push_back(fmt::format("{} gave an implausible run", rejected.size()));
  if (const auto& rejected = by_reason["strain"]; !rejected.empty())
    parts.push_back(
        fmt::format("{} stretched the cloth by more than {}{} (rms; the smallest: {})", rejected.size(),
                    percent_text(largest_strain),
                    reference_strain > 0.01 * largest_strain
                        ? fmt::format(" beyond the {} of the reference", percent_text(reference_strain))
                        : "",
                    percent_text(least(rejected, &Trial::more_strain))));
  if (const auto& rejected = by_reason["stretch"]; !rejected.empty())
    parts.push_back(
        fmt::format("{} stretched a triangle to more than {} times the largest stretch of the reference (the "
                    "smallest: {:.3g} times)",
                    rejected.size(), largest_stretch, least(rejected, &Trial::stretch)));
  if (const auto& rejected = by_reason["error"]; !rejected.empty())
    parts.push_back(fmt::format("{} had an error above {} (the smallest: {})", rejected.size(),
                                percent_text(largest_error), percent_text(least(rejected, &Trial::error))));
  return fmt::format("{}.", fmt::join(parts, "; "));
}

// Whether all settings have about the same error: then the settings are not the cause of the error.
bool all_alike(const std::vector<Trial>& trials) {
  constexpr std::size_t enough = 4;
  constexpr double alike = 1.1;
  if (trials.size() < enough) return false;
  const auto [least, most] = std::ranges::minmax_element(trials, {}, &Trial::error);
  return std::isfinite(most->error) && most->error <= alike * least->error;
}

std::string reference_text(const KnownReference& reference) {
  if (!(reference.strain <= largest_reference_strain))
    return fmt::format(
        "The reference itself is stretched by {} (rms), more than any cloth, so errors against the reference "
        "mean nothing. Either the reference flew apart, or a unit is wrong: lengths are in metres, the "
        "density in kg/m², the membrane's compliance in m/N.",
        percent_text(reference.strain));
  return fmt::format(
      "The reference itself has an error of {}, so errors against the reference mean nothing: cloth that "
      "falls and folds moves chaotically. With a shorter /duration the reference is more accurate.",
      percent_text(*reference.gap));
}

std::string budget_text(const Advice& advice, double budget) {
  std::vector<Trial> within;
  std::ranges::copy_if(advice.trials, std::back_inserter(within),
                       [&](const Trial& trial) { return trial.cpu_s <= budget; });
  if (within.empty())
    return fmt::format("No setting is that fast: the fastest setting takes {:.3g} ms.",
                       1e3 * least(advice.trials, &Trial::cpu_s));
  return fmt::format("No setting that is fast enough gives a usable result. Of {} that fast, {}",
                     counted(within.size(), "setting"), unfit_text(within, advice.reference.strain));
}

}  // namespace

std::vector<std::string> why_none(const Advice& advice, const AdviceOptions& options) {
  if (advice.is_met) return {};
  if (!advice.reference.tells()) return {reference_text(advice.reference)};
  std::vector<std::string> sentences;
  const Demand& demand = options.demand;
  if (demand.error && advice.reference.gap.value_or(0) >= *demand.error)
    sentences.push_back(
        fmt::format("The reference itself has an error of {}: cloth that falls and folds moves chaotically.",
                    percent_text(*advice.reference.gap)));
  if (advice.trials.empty())
    sentences.emplace_back("No setting gave an error.");
  else if (advice.front.empty())
    sentences.push_back(fmt::format("Of {} tried, {}", counted(advice.trials.size(), "setting"),
                                    unfit_text(advice.trials, advice.reference.strain)));
  else if (demand.cpu_s)
    sentences.push_back(budget_text(advice, *demand.cpu_s));
  if (advice.front.empty() && all_alike(advice.trials))
    sentences.emplace_back(
        "All settings agree with each other, but not with the reference: the cloth has not come to rest by "
        "the end of /duration, or the cloth rests in another pose than the reference.");
  if (const std::size_t count = advice.not_tried.size(); count > 0)
    sentences.push_back(fmt::format(
        "{} not tried within the time limit ({:.4g} s): run the same command again to continue, or give a "
        "longer --time-limit.",
        count == 1 ? "A setting was" : fmt::format("{} settings were", count), options.time_limit_s));
  return sentences;
}

}  // namespace bendlab
