#include "experiments/advise/ladder.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace bendlab {
namespace {

constexpr std::array doubled = {1, 2, 4, 8, 16, 32, 64, 128, 256};
constexpr std::array thrice = {3, 6, 12, 24, 48, 96, 192};
constexpr std::array projections = {1, 2, 4, 10};
constexpr std::array pair_iterations = {1, 2, 3, 5, 10, 20};
constexpr std::array newton_iterations = {1, 2, 4, 20};
constexpr std::array few_substeps = {1, 2, 4};
constexpr std::array more_substeps = {1, 2, 4, 8, 16};

constexpr std::array<Ladder, advised_methods.size()> ladders = {
    Ladder{false, doubled, thrice, projections, true},
    Ladder{true, pair_iterations, {}, few_substeps, true},
    Ladder{true, newton_iterations, {}, more_substeps, false},
};

}  // namespace

int Ladder::rung(const Setting& setting) const {
  return climbs_iterations ? setting.iterations : setting.substeps;
}

int Ladder::other(const Setting& setting) const {
  return climbs_iterations ? setting.substeps : setting.iterations;
}

Setting Ladder::with_rung(Setting setting, int rung) const {
  (climbs_iterations ? setting.iterations : setting.substeps) = rung;
  return setting;
}

Setting Ladder::with_other(Setting setting, int other) const {
  (climbs_iterations ? setting.substeps : setting.iterations) = other;
  return setting;
}

int Ladder::height(const Setting& setting) const {
  return static_cast<int>(std::ranges::lower_bound(rungs, rung(setting)) - rungs.begin());
}

std::optional<Setting> Ladder::below(const Setting& setting, int rungs_below) const {
  const int at = height(setting) - rungs_below;
  if (at < 0) return std::nullopt;
  return with_rung(setting, rungs[static_cast<std::size_t>(at)]);
}

bool Ladder::is_between(const Setting& setting) const {
  return std::ranges::find(between, rung(setting)) != between.end();
}

bool Ladder::on_main_way(const Setting& setting) const {
  return other(setting) == alongside.front() && !is_precise(setting);
}

std::vector<Setting> Ladder::ways(const Setting& kind) const {
  std::vector<Setting> found;
  for (const int each : alongside)
    for (const bool double_precision : {false, true})
      if (in_single || double_precision) {
        found.push_back(with_other(kind, each));
        found.back().double_precision = double_precision;
      }
  return found;
}

std::vector<int> Ladder::all_rungs() const {
  std::vector<int> all;
  std::ranges::merge(rungs, between, std::back_inserter(all));
  return all;
}

const Ladder& ladder_of(const Setting& setting) {
  const auto found = std::ranges::find(advised_methods, std::string_view(setting.variant.method));
  if (found == advised_methods.end())
    throw std::logic_error("advise: no ladder for the method " + setting.variant.method);
  return ladders[static_cast<std::size_t>(found - advised_methods.begin())];
}

Setting coarsest(const Setting& setting) {
  return {
      .model = setting.model, .double_precision = !ladder_of(setting).in_single, .variant = setting.variant};
}

}  // namespace bendlab
