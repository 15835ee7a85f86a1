#include "experiments/advise/search.hpp"

#include <algorithm>
#include <cmath>

#include "bendlab/solver/method.hpp"

namespace bendlab {
namespace {

constexpr std::size_t fewest_kinds = 3;

bool same_kind(const Setting& a, const Setting& b) {
  return a.model == b.model && a.method == b.method && a.solver == b.solver && a.cells == b.cells;
}

double work_of(const Setting& setting) {
  return static_cast<double>(setting.substeps) * setting.iterations;
}

}  // namespace

Search::Search(const Demand& demand, int most_substeps, Run run)
    : demand_(demand), most_substeps_(most_substeps), run_(std::move(run)) {
  if (demand_.error) demand_.error = std::min(*demand_.error, largest_error);
}

bool Search::run(const std::vector<SettingKind>& kinds) {
  for (const SettingKind& kind : kinds) add(kind);
  for (bool any = false;; any = true) {
    const std::vector<Setting> settings = next();
    const std::vector<Trial> trials = settings.empty() ? std::vector<Trial>() : run_(settings);
    for (const Setting& setting : settings)
      if (std::ranges::find(trials, setting, &Trial::setting) == trials.end()) reject(setting);
    if (trials.empty()) return any;
    for (const Trial& trial : trials) {
      trials_.push_back(trial);
      for (Candidate& kind : kinds_)
        if (same_kind(kind.start, trial.setting)) kind.trials.push_back(trial);
    }
  }
}

// Adds a kind. Its first run has the median of the amounts of work in `kind`.
void Search::add(const SettingKind& kind) {
  if (std::ranges::any_of(known_, [&](const Setting& known) { return same_kind(known, kind.setting); }))
    return;
  known_.push_back(kind.setting);
  std::vector<Setting> by_work;
  int most_iterations = 0;
  for (const auto& [substeps, iterations] : kind.works) {
    by_work.push_back(kind.setting);
    by_work.back().substeps = substeps, by_work.back().iterations = iterations;
    constexpr int further = 2;  // times the iterations that were the best of a measured scene
    most_iterations = std::max(most_iterations, further * iterations);
  }
  std::ranges::stable_sort(by_work, {}, work_of);
  kinds_.push_back({by_work[by_work.size() / 2], most_iterations});
}

// The settings of the next round: one for each kind of the better half, and one for each kind that was not
// run yet. If this gives no setting, and no trial met the demand, the round has the best of the kinds that
// were dropped before.
std::vector<Setting> Search::next() {
  std::ranges::stable_sort(kinds_, {}, [this](const Candidate& kind) { return promise(kind); });
  const auto untried = static_cast<std::size_t>(
      std::ranges::count_if(kinds_, [](const Candidate& kind) { return kind.trials.empty(); }));
  active_ = std::min(kinds_.size(), untried + std::max(fewest_kinds, (active_ + 1) / 2));
  std::vector<Setting> settings;
  const auto go_on = [&](const Candidate& kind) {
    if (const std::optional<Setting> setting = step(kind)) settings.push_back(*setting);
  };
  std::for_each_n(kinds_.begin(), active_, go_on);
  if (!settings.empty() || std::ranges::any_of(trials_, [&](const Trial& t) { return meets(t, demand_); }))
    return settings;
  for (std::size_t k = active_; k < kinds_.size() && settings.size() < fewest_kinds; ++k) go_on(kinds_[k]);
  return settings;
}

// How well the best run of a kind suits the demand: less is better; 0 if the kind was not run. For a
// demanded time this is error times time, because time that is left can be used for more work.
double Search::promise(const Candidate& kind) const {
  if (kind.trials.empty()) return 0;
  const Trial& best = *std::ranges::min_element(kind.trials, {},
                                                [this](const Trial& trial) { return score(trial, demand_); });
  return demand_.error ? score(best, demand_) : judged_error(best) * best.cpu_s;
}

// The next setting of a kind, or nothing if a further run would not help. More work means more substeps for
// a method that projects constraints, and more iterations for other methods.
std::optional<Setting> Search::step(const Candidate& kind) const {
  if (kind.trials.empty()) return kind.start;
  const Trial *below = nullptr, *above = nullptr;  // nearest to the demand, with less work and with more work
  for (const Trial& trial : kind.trials) {
    const bool falls_short =
        demand_.error ? judged_error(trial) > *demand_.error : trial.cpu_s <= *demand_.cpu_s;
    const Trial*& side = falls_short ? below : above;
    if (!side || (work_of(trial.setting) > work_of(side->setting)) == falls_short) side = &trial;
  }
  const Trial& from = below ? *below : *above;
  const double wanted = demand_.error ? judged_error(from) / *demand_.error : *demand_.cpu_s / from.cpu_s;
  constexpr double largest_step = 4, much_the_same = 1.07;
  const double factor = below && above ? std::sqrt(work_of(above->setting) / work_of(below->setting))
                        : below        ? std::clamp(wanted, demand_.error ? 1.25 : 1.0, largest_step)
                                       : std::clamp(wanted, 1 / largest_step, 0.9);
  if (below && (factor < much_the_same || (!above && !is_worth_more(kind, *below, factor))))
    return std::nullopt;
  Setting setting = from.setting;
  const MethodKind& method = *find_method(setting.method);
  const bool by_substeps = method.projects || method.default_iterations == 0;
  int& count = by_substeps ? setting.substeps : setting.iterations;
  count = static_cast<int>(factor < 1 ? std::floor(count * factor) : std::round(count * factor));
  count = std::clamp(count, 1, by_substeps ? most_substeps_ : kind.most_iterations);
  const auto is_same = [&](const Trial& trial) { return trial.setting == setting; };
  return std::ranges::any_of(kind.trials, is_same) ? std::nullopt : std::optional(setting);
}

// False if more work hardly reduced the error before, or if a faster setting already meets the demand.
bool Search::is_worth_more(const Candidate& kind, const Trial& trial, double factor) const {
  if (!demand_.error) return true;
  constexpr double hardly_better = 0.9;
  const std::optional<Trial> best = choice_of(trials_, demand_);
  return !(meets(*best, demand_) && trial.cpu_s * factor >= best->cpu_s) &&
         std::ranges::none_of(kind.trials, [&](const Trial& less) {
           return work_of(less.setting) < work_of(trial.setting) &&
                  judged_error(trial) > hardly_better * judged_error(less);
         });
}

void Search::reject(const Setting& setting) {
  std::erase_if(trials_, [&](const Trial& trial) { return trial.setting == setting; });
  const auto is_of_kind = [&](const Candidate& kind) { return same_kind(kind.start, setting); };
  active_ -= std::min(active_, std::erase_if(kinds_, is_of_kind));
}

}  // namespace bendlab
