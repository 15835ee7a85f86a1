#include "experiments/advise/search.hpp"

#include <algorithm>
#include <cmath>

#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

constexpr double largest_step = 4;  // of the work, from one run to the next
constexpr std::size_t fewest_kinds = 3;

}  // namespace

Search::Search(const Demand& demand, int most_substeps, Forecast forecast)
    : demand_(demand), most_substeps_(most_substeps), forecast_(std::move(forecast)) {
  if (demand_.error) demand_.error = std::min(*demand_.error, largest_error);
}

bool Search::consider(const std::vector<Setting>& settings) {
  bool any = false;
  for (const Setting& setting : settings) {
    const auto known = [&](const Setting& other) { return same_kind(other, setting); };
    if (std::ranges::any_of(kinds_, known, &Kind::start) ||
        std::ranges::any_of(resting_, known, &Kind::start) || std::ranges::any_of(ended_, known))
      continue;
    std::vector<Setting> alike;
    std::ranges::copy_if(settings, std::back_inserter(alike), known);
    constexpr int further = 2;  // than what was the best of measured scenes
    const int iterations = std::ranges::max(alike, {}, &Setting::iterations).iterations;
    kinds_.push_back({start_of(alike), further * iterations});
    any = true;
  }
  return any;
}

// For a time, the most work that is expected to be within it. For an error, which no one can expect, the
// middle of what was the best somewhere.
Setting Search::start_of(const std::vector<Setting>& settings) const {
  std::vector<Setting> by_work = settings;
  std::ranges::stable_sort(by_work, {}, work_of);
  if (demand_.error) return by_work[by_work.size() / 2];
  Setting start = by_work.front();
  for (const Setting& setting : by_work)
    if (forecast_(setting).value_or(0) <= *demand_.cpu_s) start = setting;
  return start;
}

std::vector<Setting> Search::next() {
  halve();
  std::vector<Setting> found = steps();
  while (found.empty() && !resting_.empty() && !chosen(measured_, demand_)) {
    const std::size_t back = std::min(fewest_kinds, resting_.size());
    std::ranges::stable_sort(resting_, std::ranges::greater(),
                             [this](const Kind& kind) { return best_score(kind); });
    for (std::size_t i = 0; i < back; ++i, resting_.pop_back()) kinds_.push_back(resting_.back());
    found = steps();
  }
  return found;
}

std::vector<Setting> Search::steps() {
  std::vector<Setting> found;
  for (Kind& kind : kinds_) {
    if (kind.over) continue;
    if (const std::optional<Setting> setting = step(kind))
      found.push_back(*setting);
    else
      kind.over = true;
  }
  return found;
}

// Kinds that were not run yet stay.
void Search::halve() {
  std::ranges::stable_sort(kinds_, {}, [this](const Kind& kind) { return best_score(kind); });
  const auto untried = static_cast<std::size_t>(
      std::ranges::count_if(kinds_, [](const Kind& kind) { return kind.tried.empty(); }));
  const std::size_t kept = untried + std::max(fewest_kinds, (kinds_.size() - untried + 1) / 2);
  for (; kinds_.size() > kept; kinds_.pop_back()) {
    if (kinds_.back().over)
      ended_.push_back(kinds_.back().start);
    else
      resting_.push_back(kinds_.back());
  }
}

// What its best run promises, less is better; 0 if it has none. A time that is not used up can buy more work.
double Search::best_score(const Kind& kind) const {
  if (kind.tried.empty()) return 0;
  const Rated& best =
      *std::ranges::min_element(kind.tried, {}, [this](const Rated& point) { return score(point, demand_); });
  return demand_.error ? score(best, demand_) : judged_error(best.error, best.strained) * best.cpu_s;
}

// Whether more work is wanted: its error is above the demanded one, or its time is within.
bool Search::falls_short(const Rated& point) const {
  return demand_.error ? judged_error(point.error, point.strained) > *demand_.error
                       : point.cpu_s <= *demand_.cpu_s;
}

std::optional<Setting> Search::step(const Kind& kind) const {
  if (kind.tried.empty()) return kind.start;
  const Rated *below = nullptr, *above = nullptr;  // those nearest to the demand, of less work and of more
  for (const Rated& point : kind.tried) {
    const Rated*& side = falls_short(point) ? below : above;
    const bool nearer =
        side == nullptr || (work_of(point.setting) > work_of(side->setting)) == (side == below);
    if (nearer) side = &point;
  }
  const Rated& from = below ? *below : *above;
  std::optional<double> factor;
  if (below && above)
    factor = std::sqrt(work_of(above->setting) / work_of(below->setting));
  else if (below)
    factor = factor_above(kind, *below);
  else
    factor = std::clamp(demand_.error ? above->error / *demand_.error : *demand_.cpu_s / above->cpu_s,
                        1 / largest_step, 0.9);
  constexpr double much_the_same = 1.07;
  if (!factor || (below && *factor < much_the_same)) return std::nullopt;
  const Setting setting = with_work(from.setting, *factor);
  const bool known = std::ranges::find(kind.tried, setting, &Rated::setting) != kind.tried.end();
  if (known || setting.substeps > most_substeps_ || setting.iterations > kind.most_iterations)
    return std::nullopt;
  return setting;
}

// How much more work is worth a try; nothing if it helped no more, or another kind is faster already.
std::optional<double> Search::factor_above(const Kind& kind, const Rated& short_of) const {
  if (!demand_.error) return std::min(largest_step, *demand_.cpu_s / short_of.cpu_s);
  constexpr double hardly_better = 0.9;
  const double error = judged_error(short_of.error, short_of.strained);
  for (const Rated& point : kind.tried)
    if (work_of(point.setting) < work_of(short_of.setting) &&
        error > hardly_better * judged_error(point.error, point.strained))
      return std::nullopt;
  const double factor = std::clamp(error / *demand_.error, 1.25, largest_step);
  const std::optional<Rated> best = chosen(measured_, demand_);
  if (best && short_of.cpu_s * factor >= best->cpu_s) return std::nullopt;
  return factor;
}

void Search::add(const Rated& point) {
  measured_.push_back(point);
  for (Kind& kind : kinds_)
    if (same_kind(kind.start, point.setting)) kind.tried.push_back(point);
}

void Search::drop(const Setting& setting) {
  std::erase_if(kinds_, [&](const Kind& kind) { return same_kind(kind.start, setting); });
  ended_.push_back(setting);
}

void Search::reject(const Setting& setting) {
  std::erase_if(measured_, [&](const Rated& point) { return point.setting == setting; });
  drop(setting);
}

}  // namespace bendlab
