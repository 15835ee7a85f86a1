#include "experiments/advise/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <thread>

#include "bendlab/solver/method.hpp"
#include "experiments/advise/ladder.hpp"
#include "experiments/advise/measured.hpp"
#include "experiments/advise/reasons.hpp"
#include "experiments/campaign/errors.hpp"
#include "experiments/config/counted.hpp"
#include "experiments/run/forecast.hpp"
#include "experiments/terminal/signals.hpp"

namespace bendlab {
namespace {

constexpr double share_of_search = 0.7;  // of the time limit; the rest is for running what predictions advise

class Advisor {
 public:
  Advisor(const Question& question, const AdviceOptions& options,
          const std::function<void(const std::string&)>& tell)
      : question_(question), options_(options), tell_(tell) {
    options_.campaign.out /= "advise";
    jobs_ = options_.campaign.jobs > 0
                ? options_.campaign.jobs
                : std::max(1, static_cast<int>(std::thread::hardware_concurrency() /
                                               question.scene().section("/solver").integer("threads")));
  }

  Advice advise() {
    Kinds kinds = kinds_to_begin_with(question_, options_.models, options_.methods);
    advice_.left_out = std::move(kinds.left_out), methods_ = std::move(kinds.methods),
    hinges_ = std::move(kinds.hinges);
    choose_reference();
    if (advice_.exit_code != 0) return advice_;
    const bool probe_asked = std::ranges::any_of(
        kinds.coarsest, [&](const Setting& kind) { return same_kind(kind, reference_setting(1)); });
    Search search(std::move(kinds.coarsest), options_.demand,
                  {.most_substeps = most_substeps(),
                   .least_error = 2 * advice_.reference_gap.value_or(0),
                   .forecast = [this](const Setting& setting) { return forecast_per_frame(setting); }});
    start_ = Clock::now();
    beside_runs_s_ = 0;
    // The probe is a setting like others, and often the first fit one.
    if (probe_ && probe_asked) take(probe_->first, probe_->second, search);
    while (reference_tells(advice_) && (measure_some(search) || widen(search) || confirm_rest(search))) {
    }
    while (confirm_choice(search)) {
    }
    conclude(search);
    return advice_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  Setting reference_setting(int substeps) const {
    return {.model = question_.reference_model(),
            .substeps = substeps,
            .variant = question_.recommended_variant()};
  }

  // CPU seconds per frame of what may take a thousand times as long as others: a factor in every iteration.
  std::optional<double> forecast_per_frame(const Setting& setting) const {
    if (find_method(setting.variant.method)->factorised != Factorised::blocks) return std::nullopt;
    const RunConfig config = question_.run_with(setting, Json::object());
    const std::optional<Forecast> expected = forecast(config);
    if (!expected) return std::nullopt;
    return expected->cpu_s / config.section("").number("duration") / frames_per_second;
  }

  // When the kinds so far are known, those that differ in one thing from the kind of the choice. False when
  // there are no new ones.
  bool widen(Search& search) {
    if (advice_.exit_code != 0 || advice_.out_of_time) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    if (!choice) return false;
    bool any = false;
    for (const Setting& kind : question_.neighbours(choice->setting, methods_)) any |= search.consider(kind);
    const bool of_hinges = std::ranges::find(hinges_, choice->setting.model) != hinges_.end();
    if (of_hinges && ladder_of(choice->setting).climbs_iterations)
      for (const std::string& model : hinges_)
        any |= search.consider({.model = model, .variant = choice->setting.variant});
    return any;
  }

  // The reference of a motion is exact to its own time step only.
  int most_substeps() const {
    constexpr int most = 256;
    return advice_.error_of == ErrorOf::motion ? std::min(most, question_.reference_substeps() / 4) : most;
  }

  void choose_reference() {
    advice_.error_of = options_.error_of.value_or(question_.natural_error());
    if (advice_.error_of == ErrorOf::rest && !choose_equilibrium()) {
      if (advice_.exit_code != 0) return;
      tell_("the scene has no equilibrium; its motion is compared instead");
      advice_.error_of = ErrorOf::motion;
    }
    if (advice_.error_of == ErrorOf::rest) return;
    advice_.accuracy = question_.accuracy(advice_.error_of);
    if (advice_.error_of == ErrorOf::motion)
      tell_(fmt::format(
          "the reference is the same motion with {} substeps; one with {} shows the reference's own error",
          question_.reference_substeps(), question_.reference_substeps() / 2));
    const std::vector<Measured> found = probe({advice_.accuracy});  // this computes the reference
    if (advice_.exit_code != 0) return;
    if (!found.front().error)
      throw std::runtime_error("there is nothing to measure errors against: " + why_no_error(found.front()));
    keep_probe(found.front());
  }

  // Is the equilibrium found from a run's end the one found from its start? If not, the scene has many.
  bool choose_equilibrium() {
    constexpr double same = 0.002;  // of the size
    const std::vector<Json> accuracies = {question_.accuracy(ErrorOf::rest, false),
                                          question_.accuracy(ErrorOf::rest, true)};
    tell_("the reference is the equilibrium of the stated cloth");
    const std::vector<Measured> found = probe(accuracies);
    if (advice_.exit_code != 0) return false;
    const auto &first = found[0].error, &beside = found[1].error;
    if (!first && !beside) {
      if (options_.error_of || found[0].diverged)
        throw std::runtime_error("there is no equilibrium to measure errors against: " +
                                 why_no_error(found[0]) + "; --what motion compares the motion instead");
      return false;
    }
    advice_.still_moving = question_.speed(found[0].kinetic_energy);
    advice_.many_equilibria = beside && (!first || std::abs(*first - *beside) > same);
    advice_.accuracy = accuracies[advice_.many_equilibria ? 1 : 0];
    keep_probe(found[advice_.many_equilibria ? 1 : 0]);
    return true;
  }

  // Finds how the reference itself is stretched: a membrane with a compliance stretches rightly.
  void keep_probe(const Measured& found) {
    const Setting setting = reference_setting(probe_substeps_);
    probe_ = {setting, found};
    const RunConfig config = question_.run_with(setting, advice_.accuracy);
    if (std::optional<RunConfig> reference = reference_of(config, Against::physical)) {
      if (config.section("/accuracy").boolean("start_from_end")) reference->starts_at_end_of = run_id(config);
      Experiment references;
      references.name = "references";
      const std::filesystem::path file =
          run_folder(options_.campaign.out / question_.name(), references, *reference) / "run.vtkhdf";
      if (!std::filesystem::exists(file)) return;
      const bool over_time = config.section("/accuracy").boolean("over_time");
      advice_.reference_strain = strain_in(file, over_time);
      advice_.reference_stretch = stretch_in(file, over_time);
    }
  }

  // Compared with the reference, unless that is torn apart itself.
  Strained strained(const Measured& found) const {
    if (!reference_tells(advice_)) return {found.strain.value_or(0), found.stretch, found.implausible};
    return {std::max(0.0, found.strain.value_or(0) - advice_.reference_strain),
            std::max(1.0, found.stretch / advice_.reference_stretch), found.implausible};
  }

  // Of the probe.
  std::string why_no_error(const Measured& found) const {
    return found.diverged ? fmt::format("{} diverges even with 256 substeps; a smaller /solver/dt may help",
                                        question_.reference_model())
                          : found.why;
  }

  // Runs the reference's model with each of these accuracies, as coarse as it stays in one piece: from a pose
  // that is torn apart, the search for an equilibrium takes long and finds none.
  std::vector<Measured> probe(const std::vector<Json>& accuracies) {
    std::vector<Measured> found;
    constexpr int finest = 256;
    for (const int substeps : {16, 64, finest}) {
      probe_substeps_ = substeps;
      if (accuracies.size() > 1 && substeps < finest) {
        found = execute({question_.run_with(reference_setting(substeps), Json::object())});
        if (advice_.exit_code != 0) break;
        if (found.front().diverged || found.front().strain.value_or(0) > largest_reference_strain) continue;
      }
      std::vector<RunConfig> runs;
      for (const Json& accuracy : accuracies)
        runs.push_back(question_.run_with(reference_setting(substeps), accuracy));
      found = execute(std::move(runs));
      if (advice_.exit_code != 0 || !found.front().diverged) break;
    }
    return found;
  }

  std::vector<Measured> execute(std::vector<RunConfig> configs) {
    Experiment experiment;
    experiment.name = question_.name();
    experiment.runs = std::move(configs);
    for (const RunConfig& config : experiment.runs)
      for (const auto& [pointer, value] : config.point)
        if (std::ranges::find(experiment.axes, pointer, &Axis::first) == experiment.axes.end())
          experiment.axes.push_back({pointer, {}});
    std::vector<CampaignRun> runs;
    for (const RunConfig& config : experiment.runs)
      runs.push_back({.experiment = &experiment, .config = &config});
    const Clock::time_point before = Clock::now();
    run_campaign(runs, options_.campaign, [](std::size_t) {});
    advice_.exit_code = stop_exit_code();
    for (const CampaignRun& run : runs)
      if (run.exit_code == exit_io || run.exit_code == exit_mesh) advice_.exit_code = run.exit_code;
    std::vector<Measured> measured;
    if (advice_.exit_code != 0) return measured;
    double longest_s = 0;
    for (const CampaignRun& run : runs) {
      measured.push_back(measured_by(run));
      if (run.outcome && !run.outcome->reused) ++advice_.computed;
      if (measured.back().gap) advice_.reference_gap = measured.back().gap;
      longest_s = std::max(longest_s, measured.back().wall_s);
    }
    const double all_s = std::chrono::duration<double>(Clock::now() - before).count();
    if (longest_s > 0) beside_runs_s_ = std::max(0.0, all_s - longest_s);
    return measured;
  }

  // Runs as many settings as go side by side. False when the search is over, or the time.
  bool measure_some(Search& search) {
    std::vector<Search::Next> next = search.next();
    if (next.empty()) return false;
    next.resize(std::min(next.size(), static_cast<std::size_t>(jobs_)));
    std::vector<Setting> settings;
    for (const Search::Next& each : next)
      if (in_time(each.cpu_s, question_.run_with(each.setting, advice_.accuracy), share_of_search))
        settings.push_back(each.setting);
    if (settings.empty()) return !(advice_.out_of_time = true);
    if (advice_.many_equilibria) settings = without_stretched(settings, search);
    if (advice_.exit_code != 0 || settings.empty()) return advice_.exit_code == 0;
    std::vector<RunConfig> configs;
    for (const Setting& setting : settings) configs.push_back(question_.run_with(setting, advice_.accuracy));
    const std::vector<Measured> found = execute(std::move(configs));
    for (std::size_t i = 0; i < found.size(); ++i) take(settings[i], found[i], search);
    return advice_.exit_code == 0;
  }

  // If every pose needs its own equilibrium, which takes a thousand times as long as a coarse run, poses that
  // are stretched as no cloth is get none: they are unfit, whatever their error.
  std::vector<Setting> without_stretched(const std::vector<Setting>& settings, Search& search) {
    std::vector<Setting> left, doubtful;
    for (const Setting& setting : settings)
      (search.may_be_stretched(setting) ? doubtful : left).push_back(setting);
    if (doubtful.empty()) return left;
    std::vector<RunConfig> configs;
    for (const Setting& setting : doubtful) configs.push_back(question_.run_with(setting, Json::object()));
    const std::vector<Measured> found = execute(std::move(configs));
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].failed || found[i].diverged || unfit(0, strained(found[i])) != Unfit::no)
        take(doubtful[i], found[i], search);
      else
        left.push_back(doubtful[i]);
    return left;
  }

  // Runs the setting that a prediction would advise, because a law may promise more than a run gives. False
  // when the choice is measured, or the time is over.
  bool confirm_choice(Search& search) {
    if (advice_.exit_code != 0) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    if (!choice || !choice->predicted) return false;
    RunConfig config = question_.run_with(choice->setting, advice_.accuracy);
    if (!in_time(choice->cpu_s, config, 1)) return false;
    const std::vector<Measured> found = execute({std::move(config)});
    if (advice_.exit_code != 0) return false;
    take(choice->setting, found.front(), search);
    return true;
  }

  // Iterations that have not converged lag behind the motion: a pose may be right by accident, on its way to
  // another. So the choice is run for longer, and its error has to stay. False when it does, or the time is
  // over.
  bool confirm_rest(Search& search) {
    if (advice_.exit_code != 0 || advice_.error_of != ErrorOf::rest) return false;
    choose(search);
    const std::optional<Rated> choice = advice_.best ? advice_.best : advice_.nearest;
    if (!choice || choice->predicted || !std::isfinite(choice->error) ||
        !ladder_of(choice->setting).climbs_iterations || stays_.contains(choice->setting))
      return false;
    constexpr double longer = 4, much_the_same = 1.1, small = 1e-3;  // sizes
    RunConfig config = question_.longer_run_with(choice->setting, advice_.accuracy, longer);
    const double duration = config.section("").number("duration");
    if (!in_time(choice->cpu_s, config, 1)) return false;
    const std::vector<Measured> found = execute({std::move(config)});
    if (advice_.exit_code != 0) return false;
    const std::optional<double> later = found.front().error;
    if (later && *later <= much_the_same * choice->error + small) {
      stays_.insert(choice->setting);
      return true;
    }
    search.reject(choice->setting);
    without_error_[choice->setting.model].push_back(
        fmt::format("{}: its pose does not stay, error {} after {:.3g} s and {} after {:.3g} s",
                    setting_text(choice->setting), percent_text(choice->error), duration / longer,
                    later ? percent_text(*later) : "unknown", duration));
    return true;
  }

  // Complete runs take no time.
  bool in_time(std::optional<double> cpu_per_frame, const RunConfig& config, double share) const {
    Experiment experiment;
    experiment.name = question_.name();
    if (std::filesystem::exists(run_folder(options_.campaign.out, experiment, config) / "run.vtkhdf"))
      return true;
    const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
    const double frames = frames_per_second * config.section("").number("duration");
    return passed + beside_runs_s_ + cpu_per_frame.value_or(0) * frames * wall_per_cpu_ <
           share * options_.time_limit_s;
  }

  void take(const Setting& setting, const Measured& found, Search& search) {
    if (found.failed) {
      leave_out(advice_.left_out, kind_text(setting), found.why);
      search.drop(setting);
      return;
    }
    const Strained stretched = strained(found);
    const bool compared = found.error || unfit(0, stretched) == Unfit::no;
    search.add(setting, found.error, found.cpu_s, stretched);
    if (found.strain) advice_.strain[setting] = *found.strain;
    if (!found.warnings.empty()) advice_.warnings[setting] = found.warnings;
    if (!found.error && compared)
      without_error_[setting.model].push_back(fmt::format("{}: {}", setting_text(setting), found.why));
    const double cpu_s = found.cpu_s * frames_per_second * question_.scene().section("").number("duration");
    constexpr double long_enough = 0.1;  // s
    if (found.wall_s > long_enough) wall_per_cpu_ = std::clamp(found.wall_s / cpu_s, 1.0, 10.0);
    tell_(fmt::format("{}: {}, {:.3g} ms per frame", setting_text(setting),
                      found.error ? "error " + percent_text(*found.error)
                      : compared  ? found.why
                                  : fmt::format("unfit ({})", name_of(unfit(0, stretched))),
                      1e3 * found.cpu_s));
  }

  void choose(const Search& search) {
    advice_.points = search.measured();
    if (advice_.out_of_time) std::ranges::copy(search.predicted(), std::back_inserter(advice_.points));
    advice_.front = front_of(advice_.points);
    // Errors smaller than the reference's own are not known.
    const bool knowable =
        reference_tells(advice_) &&
        (!options_.demand.error || advice_.reference_gap.value_or(0) < *options_.demand.error);
    advice_.best = knowable ? chosen(advice_.points, options_.demand) : std::nullopt;
    advice_.nearest = advice_.best ? std::nullopt : nearest(advice_.points, options_.demand);
  }

  void conclude(const Search& search) {
    choose(search);
    say_what_is_behind();
    if (advice_.out_of_time)
      advice_.left_out.push_back(
          {"settings that take longer",
           fmt::format("not run within --time-limit ({:.4g} s); predicted if three coarser settings of the "
                       "model follow a power law. The same command again continues",
                       options_.time_limit_s)});
  }

  // Lists the best setting of each model and of each method that has none on the front as it is shown.
  void say_what_is_behind() {
    std::map<std::string, std::vector<Rated>> of_model, of_method;
    for (const Rated& point : advice_.points)
      if (!point.predicted) {
        of_model[point.setting.model].push_back(point);
        of_method[point.setting.variant.method].push_back(point);
      }
    std::vector<Rated> shown = thinned(advice_.front);
    std::ranges::copy(unfit_front_of(advice_.points), std::back_inserter(shown));
    const auto say = [&](const auto& groups, auto group_of) {
      for (const auto& [name, points] : groups)
        if (!std::ranges::any_of(shown, [&](const Rated& p) { return group_of(p.setting) == name; }))
          advice_.left_out.push_back({name, best_text(points)});
    };
    for (const std::string& method : methods_)
      if (!of_method.contains(method)) leave_out(advice_.left_out, method, why_not_run(method));
    say(of_method, [](const Setting& setting) { return setting.variant.method; });
    say(of_model, [](const Setting& setting) { return setting.model; });
    for (const auto& [model, why] : without_error_)
      advice_.left_out.push_back({model, fmt::format("{} gave no error; the finest: {}",
                                                     counted(why.size(), "setting"), why.back())});
  }

  std::string why_not_run(const std::string& method) const {
    Setting setting{.model = question_.reference_model(), .variant = question_.recommended_variant(method)};
    const auto cpu_s = forecast_per_frame(setting);
    return cpu_s ? fmt::format("not run: its coarsest setting would take about {:.2g} ms", 1e3 * *cpu_s)
                 : "no setting of it was run";
  }

  std::string best_text(const std::vector<Rated>& points) const {
    const Rated best = *nearest(points, {.error = 0});
    const bool fit = unfit(best) == Unfit::no;
    return fmt::format("{} measured, {}: {} in {:.3g} ms ({})", counted(points.size(), "setting"),
                       fit ? "others are as good or better; its best"
                           : fmt::format("none is fit ({}); its nearest", name_of(unfit(best))),
                       std::isfinite(best.error) ? "error " + percent_text(best.error)
                                                 : "strain " + percent_text(advice_.strain.at(best.setting)),
                       1e3 * best.cpu_s, setting_text(best.setting));
  }

  const Question& question_;
  AdviceOptions options_;
  const std::function<void(const std::string&)>& tell_;
  int jobs_ = 1;
  Clock::time_point start_;
  double wall_per_cpu_ = 1;
  // Wall time of the last round beyond its longest run: equilibria, repeated steps.
  double beside_runs_s_ = 0;
  int probe_substeps_ = 16;
  std::optional<std::pair<Setting, Measured>> probe_;
  std::vector<std::string> methods_;                               // that may be chosen
  std::vector<std::string> hinges_;                                // models that stand in for each other
  std::set<Setting> stays_;                                        // whose pose is at rest
  std::map<std::string, std::vector<std::string>> without_error_;  // setting and why, by model
  Advice advice_;
};

}  // namespace

Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& tell) {
  return Advisor(question, options, tell).advise();
}

}  // namespace bendlab
