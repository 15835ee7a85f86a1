#include "experiments/advise/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

#include "bendlab/bending/model.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/advise/measured.hpp"
#include "experiments/advise/reasons.hpp"
#include "experiments/advise/search.hpp"
#include "experiments/advise/time_limit.hpp"
#include "experiments/campaign/errors.hpp"
#include "experiments/run/forecast.hpp"

namespace bendlab {
namespace {

constexpr double share_of_reference = 0.5;  // of the time limit, as forecast

// Without the method, which is named beside it.
std::string reason(const ConfigError& error) {
  const ConfigProblem& problem = error.problems().front();
  return fmt::format("{} {}", problem.pointer, problem.message.substr(0, problem.message.find(" (because /solver/method is")));
}

bool asked_for(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

class Advisor {
 public:
  Advisor(const Question& question, const AdviceOptions& options,
          const std::function<void(const std::string&)>& tell)
      : question_(question), options_(options), tell_(tell), limit_(options.time_limit_s) {
    options_.campaign.out /= "advise";
    options_.campaign.stop = &limit_.over();
    jobs_ = options_.campaign.jobs > 0
                ? options_.campaign.jobs
                : std::max(1, static_cast<int>(std::thread::hardware_concurrency() /
                                               question.scene().section("/solver").integer("threads")));
  }

  Advice advise() {
    const std::vector<Setting> starts = possible(settings_to_begin_with());
    if (starts.empty() && refused_) throw *refused_;
    choose_reference();
    if (advice_.exit_code != 0) return advice_;
    Search search(options_.demand, most_substeps(),
                  [this](const Setting& setting) { return forecast_per_frame(setting); });
    for (const auto& [setting, found] : probes_)
      if (asked_for(options_.models, setting.model) && asked_for(options_.methods, setting.method))
        search.consider({setting}), take(setting, found, search);
    search.consider(starts);
    while (reference_tells(advice_) && (run_round(search) || widen(search) || confirm_rest(search))) {
    }
    choose(search);
    say_what_is_behind();
    return advice_;
  }

 private:
  // ---- what is tried

  // What was the best of measured scenes, on the config's mesh and on half as many cells, and the config's own.
  std::vector<Setting> settings_to_begin_with() const {
    std::vector<Setting> settings = {question_.own_setting()};
    const int cells = question_.cells_that_may_vary();
    for (const Setting& setting : measured_fronts()) {
      settings.push_back(setting);
      if (cells >= 2 * fewest_cells) settings.push_back(setting), settings.back().cells = cells / 2;
    }
    return settings;
  }

  // From the best so far: other models with its solver, and other meshes.
  std::vector<Setting> neighbours(const Setting& setting) const {
    std::vector<Setting> found;
    for (const BendingModel* model : bending_models())
      found.push_back(setting), found.back().model = model->name;
    const int all = question_.cells_that_may_vary(), now = setting.cells > 0 ? setting.cells : all;
    for (const double factor : {0.5, 0.75, 4.0 / 3, 2.0})
      if (const int cells = static_cast<int>(std::lround(now * factor)); cells >= fewest_cells && cells <= all)
        found.push_back(setting), found.back().cells = cells == all ? 0 : cells;
    return found;
  }

  // Those that are asked for and that the scene allows; says why it does not.
  std::vector<Setting> possible(const std::vector<Setting>& settings) {
    std::vector<Setting> allowed;
    for (const Setting& setting : settings) {
      if (!asked_for(options_.models, setting.model) || !asked_for(options_.methods, setting.method)) continue;
      try {
        question_.run_with(setting, Json::object());
        allowed.push_back(setting);
      } catch (const ConfigError& error) {
        if (!refused_) refused_ = error;
        leave_out(advice_.left_out, fmt::format("{} with {}", setting.model, setting.method), reason(error));
      }
    }
    return allowed;
  }

  // False when there is nothing new.
  bool widen(Search& search) {
    if (stopped()) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    return choice && search.consider(possible(neighbours(choice->setting)));
  }

  // The reference of a motion is exact to its own time step only.
  int most_substeps() const {
    constexpr int most = 512;
    return advice_.reference.of == ErrorOf::motion ? std::min(most, advice_.reference.substeps / 4) : most;
  }

  // ---- the reference

  void choose_reference() {
    advice_.reference.of = options_.error_of.value_or(question_.natural_error());
    if (advice_.reference.of == ErrorOf::rest && !choose_equilibrium()) {
      if (advice_.exit_code != 0) return;
      tell_("the scene has no equilibrium; its motion is compared instead");
      advice_.reference.of = ErrorOf::motion;
    }
    if (advice_.reference.of == ErrorOf::rest) return;
    make_it_fit();
    const std::vector<Measured> all = probe({advice_.reference});
    if (advice_.exit_code != 0) return;
    const Measured& found = all.front();
    if (!found.error)
      throw std::runtime_error("there is nothing to measure errors against: " + found.why);
    keep_probe(found);
  }

  // Is the equilibrium found from a run's end the one found from its start? If not, the scene has many.
  bool choose_equilibrium() {
    constexpr double same = 0.002;  // of the size
    make_it_fit();
    std::vector<Reference> references(2, advice_.reference);
    references[1].start_from_end = true;
    tell_("the reference is the equilibrium of the stated cloth");
    const std::vector<Measured> found = probe(references);
    if (advice_.exit_code != 0) return false;
    const auto &first = found[0].error, &beside = found[1].error;
    if (!first && !beside) {
      if (options_.error_of || found[0].diverged)
        throw std::runtime_error("there is no equilibrium to measure errors against: " + found[0].why +
                                 "; --what motion compares the motion instead");
      return false;
    }
    advice_.still_moving = question_.speed(found[0].kinetic_energy);
    advice_.reference = references[beside && (!first || std::abs(*first - *beside) > same) ? 1 : 0];
    keep_probe(found[advice_.reference.start_from_end ? 1 : 0]);
    return true;
  }

  // Makes the reference coarser until it is expected to fit into its share of the time: a motion with fewer
  // substeps, then either on fewer cells.
  void make_it_fit() {
    Reference& reference = advice_.reference;
    if (reference.of == ErrorOf::own) return;
    constexpr int most = 1024, fewest = 64;
    const int all_cells = question_.cells_that_may_vary();
    double least_s = 0;
    for (int cells = all_cells; cells == all_cells || cells >= fewest_cells; cells /= 2) {
      reference.cells = cells == all_cells ? 0 : cells;
      for (int substeps = most; substeps >= fewest; substeps /= 2) {
        reference.substeps = reference.of == ErrorOf::motion ? substeps : 0;
        least_s = reference_s();
        if (least_s <= share_of_reference * limit_.left_s()) return tell_reference();
        if (reference.of == ErrorOf::rest) break;
      }
      if (cells == 0) break;
    }
    throw std::runtime_error(fmt::format(
        "nothing can be advised within --time-limit ({:.3g} s): the reference alone is expected to take {} even "
        "{}. Give --time-limit {:.0f}s",
        options_.time_limit_s, duration_text(least_s),
        reference.cells > 0 ? fmt::format("on {} cells", reference.cells) : "at its coarsest",
        std::ceil(1.5 * least_s / share_of_reference)));
  }

  void tell_reference() const {
    const Reference& reference = advice_.reference;
    if (reference.of == ErrorOf::motion)
      tell_(fmt::format("the reference is the same motion with {} substeps; one with {} shows its own error",
                        reference.substeps, reference.substeps / 2));
    if (reference.cells > 0)
      tell_(fmt::format("the reference has {} cells, because more would not fit into --time-limit",
                        reference.cells));
  }

  // Expected, s; with the coarser one that shows its error.
  double reference_s() const {
    const Json accuracy = question_.accuracy(advice_.reference);
    const RunConfig config = question_.run_with(question_.own_setting(), accuracy);
    double seconds = 0;
    for (const bool coarser : {false, true})
      if (const auto reference = reference_of(config, Against::physical, coarser))
        if (const auto needs = forecast(*reference)) seconds += needs->cpu_s;
    return seconds;
  }

  // The run that is compared with the reference first: the config's own; if that flies apart, because from
  // its pose the search for an equilibrium would take long and find none, the reference's model with ever
  // more substeps.
  std::vector<Measured> probe(const std::vector<Reference>& references) {
    std::vector<Setting> settings = {question_.own_setting()};
    for (const int substeps : {16, 64, 256})
      settings.push_back({.model = question_.reference_model(), .method = "pbd", .substeps = substeps});
    std::vector<Measured> found;
    for (const Setting& setting : settings) {
      probe_ = setting;
      const bool last = setting == settings.back();
      if (references.size() > 1 && !last) {
        found = execute({question_.run_with(setting, Json::object())});
        if (advice_.exit_code != 0) break;
        if (unusable(found.front())) continue;
      }
      std::vector<RunConfig> runs;
      for (const Reference& reference : references)
        runs.push_back(question_.run_with(setting, question_.accuracy(reference)));
      found = execute(std::move(runs));
      if (advice_.exit_code != 0 || !unusable(found.front())) break;
    }
    if (advice_.exit_code == 0 && std::ranges::any_of(found, &Measured::unfinished))
      throw std::runtime_error(fmt::format(
          "the reference was not complete when --time-limit ({:.3g} s) was over: the same command goes on with "
          "it",
          options_.time_limit_s));
    return found;
  }

  static bool unusable(const Measured& found) {
    return found.failed || found.diverged ||
           (!found.unfinished && found.strain.value_or(0) > largest_reference_strain);
  }

  // Finds how the reference itself is stretched: a membrane with a compliance stretches rightly.
  void keep_probe(const Measured& found) {
    advice_.accuracy = question_.accuracy(advice_.reference);
    probes_.emplace_back(probe_, found);
    const RunConfig config = question_.run_with(probe_, advice_.accuracy);
    std::optional<RunConfig> reference = reference_of(config, Against::physical);
    if (!reference) return;
    if (advice_.reference.start_from_end) reference->starts_at_end_of = run_id(config);
    Experiment references;
    references.name = "references";
    const std::filesystem::path file =
        run_folder(options_.campaign.out / question_.name(), references, *reference) / "run.vtkhdf";
    if (!std::filesystem::exists(file)) return;
    const bool over_time = config.section("/accuracy").boolean("over_time");
    advice_.reference_strain = strain_in(file, over_time);
    advice_.reference_stretch = stretch_in(file, over_time);
  }

  // Compared with the reference, unless that is torn apart itself.
  Strained strained(const Measured& found) const {
    if (!reference_tells(advice_)) return {found.strain.value_or(0), found.stretch, found.implausible};
    return {std::max(0.0, found.strain.value_or(0) - advice_.reference_strain),
            std::max(1.0, found.stretch / advice_.reference_stretch), found.implausible};
  }

  // ---- runs

  bool stopped() const { return advice_.exit_code != 0 || limit_.over(); }

  std::vector<Measured> execute(std::vector<RunConfig> configs) {
    Experiment experiment;
    experiment.name = question_.name();
    experiment.allow = {"implausible"};  // the answer says which settings are
    experiment.runs = std::move(configs);
    for (const RunConfig& config : experiment.runs)
      for (const auto& [pointer, value] : config.point)
        if (std::ranges::find(experiment.axes, pointer, &Axis::first) == experiment.axes.end())
          experiment.axes.push_back({pointer, {}});
    std::vector<CampaignRun> runs;
    for (const RunConfig& config : experiment.runs)
      runs.push_back({.experiment = &experiment, .config = &config});
    run_campaign(runs, options_.campaign, [](std::size_t) {});
    advice_.exit_code = stop_exit_code();
    for (const CampaignRun& run : runs)
      if (run.exit_code == exit_io || run.exit_code == exit_mesh) advice_.exit_code = run.exit_code;
    std::vector<Measured> measured;
    if (advice_.exit_code != 0) return measured;
    for (const CampaignRun& run : runs) {
      measured.push_back(measured_by(run));
      if (run.outcome && !run.outcome->reused && !measured.back().unfinished) ++advice_.computed;
      if (measured.back().gap) advice_.reference_gap = measured.back().gap;
    }
    return measured;
  }

  // CPU seconds per frame, as forecast.
  std::optional<double> forecast_per_frame(const Setting& setting) const {
    const RunConfig config = question_.run_with(setting, Json::object());
    const std::optional<Forecast> expected = forecast(config);
    if (!expected) return std::nullopt;
    return (expected->cpu_s - expected->set_up_s) / config.section("").number("duration") / frames_per_second;
  }

  // Whether the run is there, or expected to end in time.
  bool in_time(const RunConfig& config) const {
    Experiment experiment;
    experiment.name = question_.name();
    return expected_cpu_s(config) < limit_.left_s() ||
           std::filesystem::exists(run_folder(options_.campaign.out / question_.name(), experiment, config) /
                                   "run.vtkhdf");
  }

  // Runs the settings of a round, as many as go side by side at a time, the cheapest first, until the time is
  // over. False when there is none.
  bool run_round(Search& search) {
    if (stopped()) return false;
    std::vector<Setting> settings = search.next();
    std::ranges::stable_sort(settings, {}, [this](const Setting& s) { return forecast_per_frame(s).value_or(0); });
    for (std::size_t begin = 0; begin < settings.size(); begin += static_cast<std::size_t>(jobs_)) {
      const std::size_t end = std::min(settings.size(), begin + static_cast<std::size_t>(jobs_));
      run_some({settings.begin() + static_cast<std::ptrdiff_t>(begin),
                settings.begin() + static_cast<std::ptrdiff_t>(end)},
               search);
      if (advice_.exit_code != 0) return false;
    }
    return !settings.empty();
  }

  void run_some(const std::vector<Setting>& settings, Search& search) {
    std::vector<Setting> begun;
    std::vector<RunConfig> configs;
    for (const Setting& setting : settings) {
      RunConfig config = question_.run_with(setting, advice_.accuracy);
      if (limit_.over() || !in_time(config)) {
        advice_.not_tried.push_back(setting);
        search.drop(setting);
        continue;
      }
      begun.push_back(setting), configs.push_back(std::move(config));
    }
    if (begun.empty()) return;
    const std::vector<Measured> found = execute(std::move(configs));
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
    search.add({setting, found.error.value_or(std::numeric_limits<double>::infinity()), found.cpu_s, stretched});
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
    if (stopped() || advice_.reference.of != ErrorOf::rest) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    if (!choice || !std::isfinite(choice->error) || find_method(choice->setting.method)->projects ||
        !stays_.insert(choice->setting).second)
      return false;
    constexpr double longer = 4, much_the_same = 1.1, small = 1e-3;  // sizes
    RunConfig config = question_.run_with(choice->setting, advice_.accuracy, longer);
    if (!in_time(config)) return false;
    const std::vector<Measured> found = execute({std::move(config)});
    if (stopped()) return false;
    const std::optional<double> later = found.front().error;
    if (later && *later <= much_the_same * choice->error + small) return true;
    search.reject(choice->setting);
    leave_out(advice_.left_out, setting_text(choice->setting),
              fmt::format("its pose does not stay: error {}, and {} after {:.0f} times as long",
                          percent_text(choice->error), later ? percent_text(*later) : "unknown", longer));
    return true;
  }

  // ---- the answer

  void choose(const Search& search) {
    advice_.points = search.measured();
    advice_.front = front_of(advice_.points);
    // Errors smaller than the reference's own are not known.
    const bool knowable =
        reference_tells(advice_) &&
        (!options_.demand.error || advice_.reference_gap.value_or(0) < *options_.demand.error);
    advice_.best = knowable ? chosen(advice_.points, options_.demand) : std::nullopt;
    advice_.nearest = advice_.best ? std::nullopt : bendlab::nearest(advice_.points, options_.demand);
  }

  // Lists the best setting of each model and of each method that has none on the front as it is shown.
  void say_what_is_behind() {
    const std::vector<Rated> shown = thinned(advice_.front);
    const auto say = [&](std::string Setting::*group) {
      std::map<std::string, std::vector<Rated>> points_of;
      for (const Rated& point : advice_.points) points_of[point.setting.*group].push_back(point);
      for (const auto& [name, points] : points_of)
        if (std::ranges::none_of(shown, [&](const Rated& p) { return p.setting.*group == name; }))
          advice_.left_out.push_back({name, best_text(points)});
    };
    say(&Setting::method);
    say(&Setting::model);
  }

  std::string best_text(const std::vector<Rated>& points) const {
    const Rated best = *std::ranges::min_element(points, {}, [&](const Rated& p) { return score(p, options_.demand); });
    const Unfit why = unfit(best);
    return fmt::format("best of {} measured: {} in {:.3g} ms{} ({})", points.size(),
                       std::isfinite(best.error) ? "error " + percent_text(best.error) : "no error",
                       1e3 * best.cpu_s, why == Unfit::no ? "" : fmt::format(", unfit: {}", name_of(why)),
                       setting_text(best.setting));
  }

  static constexpr int fewest_cells = 4;

  const Question& question_;
  AdviceOptions options_;
  const std::function<void(const std::string&)>& tell_;
  TimeLimit limit_;
  int jobs_ = 1;
  Setting probe_;
  std::vector<std::pair<Setting, Measured>> probes_;  // what was compared with the reference first
  std::optional<ConfigError> refused_;                // the first reason why a setting cannot be
  std::set<Setting> stays_;                           // whose pose was looked at later
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
