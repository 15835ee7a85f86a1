#include "experiments/advise/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "experiments/advise/ladder.hpp"

namespace bendlab {
namespace {

constexpr double double_cost = 1.8;  // of single, until it is measured
constexpr double infinity = std::numeric_limits<double>::infinity();

double work_of(const Setting& setting) {
  return static_cast<double>(setting.substeps) * setting.iterations;
}

}  // namespace

Search::Search(std::vector<Setting> kinds, const Demand& demand, Limits limits)
    : kinds_(std::move(kinds)), demand_(demand), limits_(std::move(limits)) {
  if (demand_.error) demand_.error = std::min(*demand_.error, largest_error);
}

bool Search::consider(const Setting& setting) {
  const auto known = [&](const Setting& kind) { return same_kind(kind, setting); };
  if (std::ranges::any_of(kinds_, known) || std::ranges::any_of(dropped_, known)) return false;
  Setting start = coarsest(setting);
  if (!ladder_of(setting).climbs_iterations) {
    constexpr int coarser = 4;
    start.substeps =
        static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(1, setting.substeps / coarser))));
  }
  kinds_.push_back(start);
  return true;
}

std::vector<Search::Next> Search::next() const {
  std::vector<Next> found;
  for (const Setting& kind : kinds_)
    for (const Setting& setting : all_settings(kind))
      if (!find(setting) && is_next(setting) && worth(setting)) found.push_back({setting, cost(setting)});
  std::ranges::stable_sort(found, {}, [](const Next& next) { return next.cpu_s.value_or(0); });
  if (front_.empty())
    std::ranges::stable_partition(
        found, [](const Next& next) { return ladder_of(next.setting).on_main_way(next.setting); });
  return found;
}

void Search::add(const Setting& setting, std::optional<double> error, double cpu_s,
                 const Strained& strained) {
  const bool rated = error || stretched({.strained = strained});
  results_[setting] = {error, cpu_s, strained, rated};
  if (rated) measured_.push_back({setting, error.value_or(infinity), cpu_s, false, strained});
  find_front();
}

void Search::reject(const Setting& setting) {
  results_[setting].error.reset();
  std::erase_if(measured_, [&](const Rated& point) { return point.setting == setting; });
  find_front();
}

void Search::find_front() {
  front_ = front_of(measured_);
  ahead_ = front_.empty() ? unfit_front_of(measured_) : front_;
}

bool Search::may_be_stretched(const Setting& setting) const {
  for (const auto& [other, result] : results_)
    if (result.timed && !stretched(result) && same_kind(other, setting) &&
        other.substeps <= setting.substeps && other.iterations <= setting.iterations)
      return false;
  return true;
}

void Search::drop(const Setting& setting) {
  std::erase_if(kinds_, [&](const Setting& kind) { return same_kind(kind, setting); });
  dropped_.push_back(setting);
}

std::vector<Rated> Search::predicted() const {
  constexpr int farthest = 4;
  constexpr double allowance = 0.25;  // errors tend to fall ever more slowly than a law says
  std::vector<Rated> points;
  for (const Setting& kind : kinds_) {
    const Ladder& ladder = ladder_of(kind);
    for (const Setting& way : ladder.ways(kind)) {
      std::vector<Worked> known;
      std::vector<Setting> measured;
      int last = 0;
      for (const int rung : ladder.all_rungs()) {
        const Setting setting = ladder.with_rung(way, rung);
        const Result* result = find(setting);
        if (result == nullptr) continue;
        last = rung;
        if (!result->error) continue;
        known.push_back({work_of(setting), *result->error});
        measured.push_back(setting);
      }
      constexpr std::size_t most = 4;  // coarser ones say little about finer ones
      const std::size_t first = known.size() > most ? known.size() - most : 0;
      const auto law = fit_power_law(std::span(known).subspan(first));
      if (!law) continue;
      for (const int rung : ladder.all_rungs()) {
        const Setting setting = ladder.with_rung(way, rung);
        if (rung <= last || rung > farthest * last || setting.substeps > limits_.most_substeps) continue;
        const double error =
            law->at(work_of(setting)) * std::pow(work_of(setting) / known.back().work, allowance);
        if (error >= limits_.least_error)
          points.push_back({setting, error, *cost(setting), true, predicted_strain(measured, setting)});
      }
    }
  }
  return points;
}

Strained Search::predicted_strain(const std::vector<Setting>& measured, const Setting& setting) const {
  const auto at = [&](auto value) {
    std::vector<Worked> known;
    for (const Setting& each : measured) known.push_back({work_of(each), value(find(each)->strained)});
    const auto law = fit_power_law(known);
    return law ? law->at(work_of(setting)) : known.back().error;
  };
  return {at([](const Strained& s) { return s.rms; }),
          1 + at([](const Strained& s) { return s.largest - 1; }),
          find(measured.back())->strained.implausible};
}

const Search::Result* Search::find(const Setting& setting) const {
  const auto found = results_.find(setting);
  return found == results_.end() ? nullptr : &found->second;
}

bool Search::stretched(const Result& result) {
  return unfit(0, result.strained) != Unfit::no;
}

std::optional<double> Search::error_of(const Setting& setting) const {
  const Result* result = find(setting);
  return result && !stretched(*result) ? result->error : std::nullopt;
}

// From the runs of its kind in its precision, or else in the other, or else forecast. Runs that diverged do
// not count.
std::optional<double> Search::cost(const Setting& setting) const {
  for (const bool same : {true, false}) {
    std::vector<Timed> timed;
    for (const auto& [other, result] : results_)
      if (result.timed && same_kind(other, setting) &&
          (other.double_precision == setting.double_precision) == same)
        timed.push_back({other.substeps, other.iterations, result.cpu_s});
    const double factor = same ? 1 : setting.double_precision ? double_cost : 1 / double_cost;
    if (const auto fit = fit_step_cost(timed)) return factor * fit->at(setting.substeps, setting.iterations);
  }
  return limits_.forecast ? limits_.forecast(setting) : std::nullopt;
}

// The least error that the kind's coarser runs leave possible; 0 if they had none. Beyond nowhere_near the
// size of an error means nothing.
double Search::optimistic(const Setting& setting) const {
  constexpr double nowhere_near = 0.25;
  double least = infinity;
  for (const auto& [other, result] : results_)
    if (same_kind(other, setting) && other.substeps <= setting.substeps &&
        other.iterations <= setting.iterations && result.error)
      least = std::min(
          least, std::min(*result.error, nowhere_near) * std::pow(work_of(other) / work_of(setting), 2));
  return std::isfinite(least) ? least : 0;
}

bool Search::on_front(const Setting& setting) const {
  return std::ranges::find(ahead_, setting, &Rated::setting) != ahead_.end();
}

bool Search::is_next(const Setting& setting) const {
  if (std::ranges::find(kinds_, setting) != kinds_.end()) return true;
  const Ladder& ladder = ladder_of(setting);
  if (ladder.is_between(setting)) return between(setting);
  if (ladder.is_precise(setting)) return rounding_suspected(setting);
  return ladder.on_main_way(setting) ? continues(setting) : more_of_the_other(setting);
}

std::optional<double> Search::error_below(const Setting& setting, int rungs) const {
  const auto below = ladder_of(setting).below(setting, rungs);
  return below ? error_of(*below) : std::nullopt;
}

// Whether to climb: unless the error stayed the same and other settings are better.
bool Search::continues(const Setting& setting) const {
  const Ladder& ladder = ladder_of(setting);
  const auto last = ladder.below(setting, 1);
  if (!last || find(*last) == nullptr) return false;
  constexpr double much_the_same = 0.9;
  constexpr int early = 3;  // coarse settings may all be as bad
  const auto error = error_below(setting, 1), before = error_below(setting, 3);
  const bool stays = ladder.height(*last) >= early && error && before && *error > much_the_same * *before;
  return !stays || on_front(*last);
}

// Whether to raise what the ladder does not climb: if the next fewer are on the front, until two in a row
// were not.
bool Search::more_of_the_other(const Setting& setting) const {
  const Ladder& ladder = ladder_of(setting);
  const int mine = ladder.other(setting);
  const auto fewer = std::prev(std::ranges::find(ladder.alongside, mine));
  if (!on_front(ladder.with_other(setting, *fewer))) return false;
  int in_vain = 0;
  for (const auto& [other, result] : results_)  // upwards
    if (same_kind(other, setting) && ladder.other(other) == mine && !ladder.is_precise(other))
      in_vain = on_front(other) ? 0 : in_vain + 1;
  return in_vain < 2;
}

// Whether to try double: if single diverged, hardly gained from its last rung, or was worse than double
// before.
bool Search::rounding_suspected(const Setting& setting) const {
  const Ladder& ladder = ladder_of(setting);
  Setting single = setting;
  single.double_precision = false;
  const auto mine = error_below(setting, 1), before = error_below(single, 1);
  if (mine && (!before || *mine < 0.95 * *before)) return true;
  for (const int rungs : {1, 2})
    if (const auto below = ladder.below(setting, rungs); below && find(*below)) return false;  // in vain
  constexpr int early = 3;
  const Result* tried = find(single);
  if (tried == nullptr || ladder.height(setting) < early) return false;
  if (stretched(*tried)) return before.has_value();
  return !tried->error || (before && *tried->error > 0.75 * *before);
}

// Whether to try 3 · 2^k substeps: if 2 · 2^k don't meet the demand and these may.
bool Search::between(const Setting& setting) const {
  const Ladder& ladder = ladder_of(setting);
  const int below = ladder.rung(setting) / 3 * 2;
  const Result *coarser = find(ladder.with_rung(setting, below)),
               *finer = find(ladder.with_rung(setting, 2 * below));
  if (coarser == nullptr) return false;
  if (stretched(*coarser))
    return finer != nullptr && finer->error && unfit(*finer->error, finer->strained) == Unfit::no;
  const auto error = coarser->error;
  if (!error) return false;
  if (demand_.error) return *error > *demand_.error && optimistic(setting) <= *demand_.error;
  const auto above = cost(ladder.with_rung(setting, 2 * below));
  return above && *above > *demand_.cpu_s;
}

// Time per frame beyond which nothing need be run. If nothing fit is as fast as demanded, it is that of the
// fastest fit setting, which then comes nearest.
double Search::longest() const {
  if (demand_.error) {
    const std::optional<Rated> best = chosen(measured_, demand_);
    return best ? best->cpu_s : infinity;
  }
  return front_.empty() ? infinity : std::max(*demand_.cpu_s, front_.front().cpu_s);
}

bool Search::worth(const Setting& setting) const {
  const std::optional<double> cpu_s = cost(setting);
  if (!cpu_s) return true;
  if (*cpu_s >= longest()) return false;
  double least = infinity;  // error for that time
  for (const Rated& point : front_)
    if (point.cpu_s <= *cpu_s) least = point.error;
  // On the way up a setting may be behind and the next one ahead. Iterations that converge have no law.
  const Ladder& ladder = ladder_of(setting);
  if (ladder.climbs_iterations && ladder.on_main_way(setting)) return true;
  const bool on_the_way = ladder.on_main_way(setting) && !ladder.is_between(setting);
  return optimistic(setting) < (on_the_way ? 2 : 1) * least;
}

std::vector<Setting> Search::all_settings(const Setting& kind) const {
  const Ladder& ladder = ladder_of(kind);
  std::vector<Setting> settings;
  for (const Setting& way : ladder.ways(kind))
    for (const int rung : ladder.all_rungs())
      if (const Setting setting = ladder.with_rung(way, rung); setting.substeps <= limits_.most_substeps)
        settings.push_back(setting);
  return settings;
}

}  // namespace bendlab
