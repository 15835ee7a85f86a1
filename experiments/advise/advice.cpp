#include "experiments/advise/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "bendlab/bending/model.hpp"
#include "bendlab/scene/counted.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/advise/search.hpp"

namespace bendlab {
namespace {

// The reason of a config error. The text omits model and method, which the list of settings names already.
std::string reason(const ConfigError& error, const std::string& model) {
  const ConfigProblem& problem = error.problems().front();
  std::string why = fmt::format("{} {}", problem.pointer, problem.message);
  if (const std::size_t at = why.find(" (because /solver/method is"); at != std::string::npos) why.erase(at);
  if (const std::size_t at = why.find(" of " + model); at != std::string::npos)
    why.erase(at, 4 + model.size());
  return why;
}

// Adds `what` to the list. Entries with the same reason are joined.
void leave_out(std::vector<LeftOut>& left_out, const std::string& what, const std::string& why) {
  const auto same = std::ranges::find(left_out, why, &LeftOut::why);
  if (same == left_out.end())
    left_out.push_back({what, why});
  else if (same->what.find(what) == std::string::npos)
    same->what += ", " + what;
}

bool asked_for(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

class Advisor {
 public:
  Advisor(const Question& question, const AdviceOptions& options,
          const std::function<void(const std::string&)>& report)
      : question_(question),
        options_(options),
        report_(report),
        runs_(question, options.campaign, options.time_limit_s, options.now_s) {}

  Advice advise() {
    std::vector<SettingKind> kinds = possible(kinds_to_begin_with());
    if (kinds.empty() && refused_) throw *refused_;
    KnownReference& reference = advice_.reference;
    reference = choose_reference(question_, runs_, options_.error_of);
    if ((advice_.exit_code = runs_.exit_code()) != 0) return advice_;
    const std::vector<SettingKind> probe = possible({kind_of(reference.probe)});
    kinds.insert(kinds.begin(), probe.begin(), probe.end());
    if (!reference.tells()) choose(run({reference.probe}));
    // The reference of a motion has an error, too. So no setting has more than a quarter of the reference's
    // substeps.
    constexpr int most = 512;
    Search search(options_.demand,
                  reference.of == ErrorOf::motion ? std::min(most, reference.substeps / 4) : most,
                  [this](const std::vector<Setting>& settings) { return run(settings); });
    bool goes_on = reference.tells() && search.run(kinds);
    while (goes_on && choose(search.trials()))
      goes_on = !runs_.over() &&
                (search.run(possible(neighbours(advice_.choice->setting))) || reject_creeping(search));
    list_behind_front();
    advice_.exit_code = runs_.exit_code(), advice_.computed = runs_.computed();
    return advice_;
  }

 private:
  // ---- settings to try

  static SettingKind kind_of(const Setting& setting) {
    return {setting, {{setting.substeps, setting.iterations}}};
  }

  // The best settings of measured scenes, on the config's mesh and on half as many cells, and the config's
  // own setting. Models that the user asks for are tried with every solver.
  std::vector<SettingKind> kinds_to_begin_with() const {
    std::vector<SettingKind> kinds;
    const int cells = question_.cells_that_may_vary();
    for (SettingKind kind : measured_fronts())
      for (const std::string& model :
           options_.models.empty() ? std::vector{kind.setting.model} : options_.models) {
        kind.setting.model = model;
        kinds.push_back(kind);
        if (cells >= 2 * fewest_cells) kinds.push_back(kind), kinds.back().setting.cells = cells / 2;
      }
    kinds.push_back(kind_of(question_.own_setting()));
    return kinds;
  }

  // Settings like the best setting so far, but with another model or with another mesh.
  std::vector<SettingKind> neighbours(const Setting& setting) const {
    std::vector<SettingKind> kinds;
    for (const BendingKind* model : bending_models())
      kinds.push_back(kind_of(setting)), kinds.back().setting.model = model->name;
    const int all = question_.cells_that_may_vary(), current = setting.cells > 0 ? setting.cells : all;
    for (const double factor : {0.5, 0.75, 4.0 / 3, 2.0})
      if (const int cells = static_cast<int>(std::lround(current * factor));
          cells >= fewest_cells && cells <= all)
        kinds.push_back(kind_of(setting)), kinds.back().setting.cells = cells == all ? 0 : cells;
    return kinds;
  }

  // The kinds of settings that the user asks for and the scene allows. Adds kinds that the scene refuses to
  // `left_out`, with the reason.
  std::vector<SettingKind> possible(const std::vector<SettingKind>& kinds) {
    std::vector<SettingKind> allowed;
    for (const SettingKind& kind : kinds) {
      if (!asked_for(options_.models, kind.setting.model) ||
          !asked_for(options_.methods, kind.setting.method))
        continue;
      try {
        question_.experiment_with(kind.setting, Json::object());
        allowed.push_back(kind);
      } catch (const ConfigError& error) {
        if (!refused_) refused_ = error;
        leave_out(advice_.left_out, fmt::format("{} with {}", kind.setting.model, kind.setting.method),
                  reason(error, kind.setting.model));
      }
    }
    return allowed;
  }

  // ---- runs

  // Runs the settings that may end within the time limit. Returns the trials that ended.
  std::vector<Trial> run(const std::vector<Setting>& settings) {
    std::vector<Trial> trials;
    if (runs_.over()) return trials;
    std::vector<Setting> begun;
    for (const Setting& setting : settings)
      (runs_.in_time(setting, advice_.reference.accuracy) ? begun : advice_.not_tried).push_back(setting);
    for (Trial& trial : runs_.execute(begun, advice_.reference.accuracy, runs_.left_s()))
      if (is_measured(trial)) trials.push_back(std::move(trial));
    return trials;
  }

  // Compares a trial's strain and stretch with the strain and stretch of the reference. False if the run was
  // stopped or failed.
  bool is_measured(Trial& trial) {
    const std::string text = setting_text(trial.setting);
    if (trial.unfinished) advice_.not_tried.push_back(trial.setting);
    if (trial.failed) leave_out(advice_.left_out, text, trial.why);
    if (trial.unfinished || trial.failed) return false;
    if (const KnownReference& reference = advice_.reference; reference.tells()) {
      trial.more_strain = std::max(0.0, trial.strain - reference.strain);
      trial.stretch = std::max(1.0, trial.stretch / reference.stretch);
    }
    std::string result = "error " + percent_text(trial.error);
    if (!std::isfinite(trial.error)) {
      result = fmt::format("unfit ({})", unfit(trial));
      if (unfit(trial) == "error") leave_out(advice_.left_out, text, result = "no error: " + trial.why);
    }
    report_(fmt::format("{}: {}, {:.3g} ms per frame", text, result, 1e3 * trial.cpu_s));
    return true;
  }

  // If iterations have not converged, the cloth creeps, and a pose on its way may be right by accident. So
  // the chosen setting is run for a longer time, and is rejected if its error grows. True if it is rejected.
  bool reject_creeping(Search& search) {
    const Trial& choice = *advice_.choice;
    const Json& accuracy = advice_.reference.accuracy;
    constexpr double longer = 4, much_the_same = 1.1, small = 1e-3;  // small: in sizes of the mesh
    if (advice_.reference.of != ErrorOf::rest || !unfit(choice).empty() ||
        find_method(choice.setting.method)->projects || !runs_.in_time(choice.setting, accuracy, longer))
      return false;
    const Trial later = runs_.execute({choice.setting}, accuracy, runs_.left_s(), longer).front();
    if (runs_.over() || later.error <= much_the_same * choice.error + small) return false;
    ++creeping_;
    creeps_ = fmt::format("{}: error {}, but {} after a run {:.0f} times as long",
                          setting_text(choice.setting), percent_text(choice.error),
                          std::isfinite(later.error) ? percent_text(later.error) : "unknown", longer);
    search.reject(choice.setting);
    return true;
  }

  // ---- the answer

  // Chooses the best trial so far. False if there is no trial.
  bool choose(const std::vector<Trial>& trials) {
    KnownReference& reference = advice_.reference;
    const Demand& demand = options_.demand;
    reference.gap = runs_.reference_gap();
    advice_.trials = trials;
    advice_.front = front_of(trials);
    advice_.choice = choice_of(trials, demand);
    // Errors smaller than the error of the reference itself are unknown.
    advice_.is_met = advice_.choice && meets(*advice_.choice, demand) && reference.tells() &&
                     !(demand.error && reference.gap.value_or(0) >= *demand.error);
    return advice_.choice.has_value();
  }

  // Adds the best setting of each model and each method that the printed table lacks to `left_out`.
  void list_behind_front() {
    for (const auto group : {&Setting::method, &Setting::model}) {
      std::map<std::string, std::vector<Trial>> behind;
      for (const Trial& trial : advice_.trials) behind[trial.setting.*group].push_back(trial);
      for (const Trial& row : thinned(advice_.front)) behind.erase(row.setting.*group);
      for (const auto& [name, trials] : behind) advice_.left_out.push_back({name, best_text(trials)});
    }
    if (creeping_ > 0)
      advice_.left_out.push_back(
          {counted(creeping_, "setting") + ", whose pose still changes", "the last is " + creeps_});
  }

  std::string best_text(const std::vector<Trial>& trials) const {
    const auto order = [&](const Trial& trial) { return score(trial, options_.demand); };
    const Trial best = *std::ranges::min_element(trials, {}, order);
    return fmt::format("best of {} measured settings: {} in {:.3g} ms{}{} ({})", trials.size(),
                       std::isfinite(best.error) ? "error " + percent_text(best.error) : "no error",
                       1e3 * best.cpu_s, unfit(best).empty() ? "" : ", unfit: ", unfit(best),
                       setting_text(best.setting));
  }

  const Question& question_;
  const AdviceOptions& options_;
  const std::function<void(const std::string&)>& report_;
  Runs runs_;
  std::optional<ConfigError> refused_;  // the first reason why a setting is impossible
  std::size_t creeping_ = 0;            // settings whose pose changed in a longer run
  std::string creeps_;                  // the last such setting
  Advice advice_;
};

}  // namespace

Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& report) {
  return Advisor(question, options, report).advise();
}

}  // namespace bendlab
