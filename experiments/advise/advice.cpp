#include "experiments/advise/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/advise/reasons.hpp"
#include "experiments/advise/runs.hpp"
#include "experiments/advise/search.hpp"

namespace bendlab {
namespace {

// Without model and method, which are named beside it.
std::string reason(const ConfigError& error, const std::string& model) {
  const ConfigProblem& problem = error.problems().front();
  std::string why = fmt::format("{} {}", problem.pointer, problem.message);
  if (const std::size_t at = why.find(" (because /solver/method is"); at != std::string::npos) why.erase(at);
  if (const std::size_t at = why.find(" of " + model); at != std::string::npos)
    why.erase(at, 4 + model.size());
  return why;
}

bool asked_for(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

class Advisor {
 public:
  Advisor(const Question& question, const AdviceOptions& options,
          const std::function<void(const std::string&)>& tell)
      : question_(question),
        options_(options),
        tell_(tell),
        runs_(question, options.campaign, options.time_limit_s) {}

  Advice advise() {
    const std::vector<Setting> starts = possible(settings_to_begin_with());
    if (starts.empty() && refused_) throw *refused_;
    advice_.reference = choose_reference(question_, runs_, options_.error_of, tell_);
    if ((advice_.exit_code = runs_.exit_code()) != 0) return advice_;
    Search search(options_.demand, most_substeps(),
                  [this](const Setting& setting) { return runs_.forecast_per_frame(setting); });
    if (const Setting& probe = advice_.reference.probe;
        asked_for(options_.models, probe.model) && asked_for(options_.methods, probe.method))
      search.consider({probe}), take(probe, advice_.reference.probed, search);
    search.consider(starts);
    while (reference_tells(advice_.reference) &&
           (run_round(search) || widen(search) || confirm_rest(search))) {
    }
    choose(search);
    say_what_is_behind();
    advice_.exit_code = runs_.exit_code(), advice_.computed = runs_.computed();
    return advice_;
  }

 private:
  // ---- what is tried

  // The config's own; what was the best of measured scenes, on the config's mesh and on half as many cells.
  // Models that are asked for are tried with every solver.
  std::vector<Setting> settings_to_begin_with() const {
    std::vector<Setting> settings = {question_.own_setting()};
    const int cells = question_.cells_that_may_vary();
    for (const Setting& front : measured_fronts())
      for (const std::string& model : options_.models.empty() ? std::vector{front.model} : options_.models) {
        settings.push_back(front), settings.back().model = model;
        if (cells >= 2 * fewest_cells) settings.push_back(settings.back()), settings.back().cells = cells / 2;
      }
    return settings;
  }

  // From the best so far: other models with its solver, and other meshes.
  std::vector<Setting> neighbours(const Setting& setting) const {
    std::vector<Setting> found;
    for (const BendingKind* model : bending_models())
      found.push_back(setting), found.back().model = model->name;
    const int all = question_.cells_that_may_vary(), now = setting.cells > 0 ? setting.cells : all;
    for (const double factor : {0.5, 0.75, 4.0 / 3, 2.0})
      if (const int cells = static_cast<int>(std::lround(now * factor));
          cells >= fewest_cells && cells <= all)
        found.push_back(setting), found.back().cells = cells == all ? 0 : cells;
    return found;
  }

  // Those that are asked for and that the scene allows; says why it does not.
  std::vector<Setting> possible(const std::vector<Setting>& settings) {
    std::vector<Setting> allowed;
    for (const Setting& setting : settings) {
      if (!asked_for(options_.models, setting.model) || !asked_for(options_.methods, setting.method))
        continue;
      try {
        question_.run_with(setting, Json::object());
        allowed.push_back(setting);
      } catch (const ConfigError& error) {
        if (!refused_) refused_ = error;
        leave_out(advice_.left_out, fmt::format("{} with {}", setting.model, setting.method),
                  reason(error, setting.model));
      }
    }
    return allowed;
  }

  // False when there is nothing new.
  bool widen(Search& search) {
    if (runs_.over()) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    return choice && search.consider(possible(neighbours(choice->setting)));
  }

  // The reference of a motion is exact to its own time step only.
  int most_substeps() const {
    constexpr int most = 512;
    return advice_.reference.of == ErrorOf::motion ? std::min(most, advice_.reference.substeps / 4) : most;
  }

  // Compared with the reference, unless that is torn apart itself.
  Strained strained(const Measured& found) const {
    if (!reference_tells(advice_.reference))
      return {found.strain.value_or(0), found.stretch, found.implausible};
    return {std::max(0.0, found.strain.value_or(0) - advice_.reference.strain),
            std::max(1.0, found.stretch / advice_.reference.stretch), found.implausible};
  }

  // ---- runs

  // Runs the settings of a round, as many as go side by side at a time, the cheapest first, until the time is
  // over. False when there is none.
  bool run_round(Search& search) {
    if (runs_.over()) return false;
    std::vector<Setting> settings = search.next();
    std::ranges::stable_sort(settings, {},
                             [this](const Setting& s) { return runs_.forecast_per_frame(s).value_or(0); });
    for (std::size_t begin = 0; begin < settings.size();
         begin += static_cast<std::size_t>(runs_.side_by_side())) {
      const std::size_t end =
          std::min(settings.size(), begin + static_cast<std::size_t>(runs_.side_by_side()));
      run_some({settings.begin() + static_cast<std::ptrdiff_t>(begin),
                settings.begin() + static_cast<std::ptrdiff_t>(end)},
               search);
      if (runs_.exit_code() != 0) return false;
    }
    return !settings.empty();
  }

  void run_some(const std::vector<Setting>& settings, Search& search) {
    std::vector<Setting> begun;
    std::vector<RunConfig> configs;
    for (const Setting& setting : settings) {
      RunConfig config = question_.run_with(setting, advice_.reference.accuracy);
      if (runs_.over() || !runs_.in_time(config)) {
        advice_.not_tried.push_back(setting);
        search.drop(setting);
        continue;
      }
      begun.push_back(setting), configs.push_back(std::move(config));
    }
    if (begun.empty()) return;
    const std::vector<Measured> found = runs_.execute(std::move(configs));
    for (std::size_t i = 0; i < found.size(); ++i) take(begun[i], found[i], search);
  }

  void take(const Setting& setting, const Measured& found, Search& search) {
    if (found.unfinished) {
      advice_.not_tried.push_back(setting);
      return search.drop(setting);
    }
    if (found.failed) {
      leave_out(advice_.left_out, setting_text(setting), found.why);
      return search.drop(setting);
    }
    const Strained stretched = strained(found);
    const bool fits = unfit(0, stretched) == Unfit::no;
    search.add(
        {setting, found.error.value_or(std::numeric_limits<double>::infinity()), found.cpu_s, stretched});
    if (found.strain) advice_.strain[setting] = *found.strain;
    if (!found.warnings.empty()) advice_.warnings[setting] = found.warnings;
    if (!found.error && fits) leave_out(advice_.left_out, setting_text(setting), "no error: " + found.why);
    tell_(fmt::format("{}: {}, {:.3g} ms per frame", setting_text(setting),
                      found.error ? "error " + percent_text(*found.error)
                      : fits      ? found.why
                                  : fmt::format("unfit ({})", name_of(unfit(0, stretched))),
                      1e3 * found.cpu_s));
  }

  // Iterations that have not converged lag behind the motion: a pose may be right by accident, on its way to
  // another. So the choice is run for longer, and its error has to stay. False when it does, or the time is
  // over.
  bool confirm_rest(Search& search) {
    if (runs_.over() || advice_.reference.of != ErrorOf::rest) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    if (!choice || unfit(*choice) != Unfit::no || find_method(choice->setting.method)->projects ||
        !stays_.insert(choice->setting).second)
      return false;
    constexpr double longer = 4, much_the_same = 1.1, small = 1e-3;  // sizes
    RunConfig config = question_.run_with(choice->setting, advice_.reference.accuracy, longer);
    if (!runs_.in_time(config)) return false;
    const std::optional<double> later = runs_.execute_one(std::move(config)).error;
    if (runs_.over()) return false;
    if (later && *later <= much_the_same * choice->error + small) return true;
    search.reject(choice->setting);
    ++creeping_;
    creeps_ = fmt::format("{}: error {}, and {} after {:.0f} times as long", setting_text(choice->setting),
                          percent_text(choice->error), later ? percent_text(*later) : "unknown", longer);
    return true;
  }

  // ---- the answer

  void choose(const Search& search) {
    advice_.reference.gap = runs_.reference_gap();
    advice_.points = search.measured();
    advice_.front = front_of(advice_.points);
    // Errors smaller than the reference's own are not known.
    const bool knowable =
        reference_tells(advice_.reference) &&
        (!options_.demand.error || advice_.reference.gap.value_or(0) < *options_.demand.error);
    advice_.best = knowable ? chosen(advice_.points, options_.demand) : std::nullopt;
    advice_.nearest = advice_.best ? std::nullopt : bendlab::nearest(advice_.points, options_.demand);
  }

  // Lists the best setting of each model and of each method that has none on the front as it is shown.
  void say_what_is_behind() {
    const std::vector<Rated> shown = thinned(advice_.front);
    const auto say = [&](std::string Setting::*group) {
      std::map<std::string, std::vector<Rated>> points_of;
      for (const Rated& point : advice_.points) points_of[point.setting.*group].push_back(point);
      for (const auto& points : points_of)
        if (std::ranges::none_of(shown, [&](const Rated& p) { return p.setting.*group == points.first; }))
          advice_.left_out.push_back({points.first, best_text(points.second)});
    };
    say(&Setting::method);
    say(&Setting::model);
    if (creeping_ > 0)
      advice_.left_out.push_back(
          {counted(creeping_, "setting") + ", whose pose does not stay", "the last is " + creeps_});
  }

  std::string best_text(const std::vector<Rated>& points) const {
    const Rated best =
        *std::ranges::min_element(points, {}, [&](const Rated& p) { return score(p, options_.demand); });
    const Unfit why = unfit(best);
    return fmt::format("best of {} measured: {} in {:.3g} ms{} ({})", points.size(),
                       std::isfinite(best.error) ? "error " + percent_text(best.error) : "no error",
                       1e3 * best.cpu_s, why == Unfit::no ? "" : fmt::format(", unfit: {}", name_of(why)),
                       setting_text(best.setting));
  }

  const Question& question_;
  const AdviceOptions& options_;
  const std::function<void(const std::string&)>& tell_;
  Runs runs_;
  std::optional<ConfigError> refused_;  // the first reason why a setting cannot be
  std::set<Setting> stays_;             // whose pose was looked at later
  std::size_t creeping_ = 0;            // settings whose pose did not stay
  std::string creeps_;                  // the last of them
  Advice advice_;
};

}  // namespace

void leave_out(std::vector<LeftOut>& left_out, const std::string& what, const std::string& why) {
  const auto same = std::ranges::find(left_out, why, &LeftOut::why);
  if (same == left_out.end())
    left_out.push_back({what, why});
  else if (same->what.find(what) == std::string::npos)
    same->what += ", " + what;
}

Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& tell) {
  return Advisor(question, options, tell).advise();
}

}  // namespace bendlab
