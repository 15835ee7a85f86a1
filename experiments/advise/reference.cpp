#include "experiments/advise/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/advise/fitness.hpp"
#include "experiments/config/references.hpp"
#include "experiments/run/forecast.hpp"

namespace bendlab {
namespace {

constexpr double share_of_reference = 0.25;  // of the time that is left, as forecast
constexpr double share_of_a_try = 0.4;       // the same, until a coarser one is tried

class ReferenceChooser {
 public:
  ReferenceChooser(const Question& question, Runs& runs, std::optional<ErrorOf> error_of,
                   const std::function<void(const std::string&)>& tell)
      : question_(question), runs_(runs), error_of_(error_of), tell_(tell), limit_s_(runs.left_s()) {}

  KnownReference choose() {
    Reference& reference = known_;
    reference.of = error_of_.value_or(question_.natural_error());
    if (reference.of == ErrorOf::rest && !choose_equilibrium()) {
      if (runs_.exit_code() != 0) return known_;
      tell_("no equilibrium of the scene was found; its motion is compared instead");
      reference = Reference{.of = ErrorOf::motion};
    }
    if (reference.of == ErrorOf::rest) return known_;
    make_it_fit();
    Measured found = runs_.within(share_of_a_try * runs_.left_s(), [&] { return probe(reference); });
    if (found.unfinished && runs_.exit_code() == 0 && may_be_coarser()) {
      make_coarser(), make_it_fit();
      found = runs_.within(share_of_a_try * runs_.left_s(), [&] { return probe(reference); });
    }
    if (runs_.exit_code() != 0) return known_;
    if (found.unfinished) throw_too_slow();
    if (!found.error) throw std::runtime_error("there is nothing to measure errors against: " + found.why);
    keep_probe(found);
    return known_;
  }

 private:
  // Is the equilibrium found from a run's end the one found from its start? If not, the scene has many, and
  // each run needs one of its own: that has to be quick. The search from the start may take much longer, and
  // then finds another one. False if there is none, or none in time.
  bool choose_equilibrium() {
    constexpr double same = 0.002;          // of the size
    constexpr double longest_trial = 0.15;  // of the time that is left
    Reference& reference = known_;
    tell_("the reference is the equilibrium of the stated cloth");
    bool many = false;
    while (true) {
      make_it_fit();
      Reference beside = reference;
      beside.start_from_end = true;
      const double left_s = runs_.left_s();
      const Measured near = runs_.within(share_of_a_try * left_s, [&] { return probe(beside); });
      const double took_s = left_s - runs_.left_s();
      if (runs_.exit_code() != 0) return false;
      if (near.unfinished && may_be_coarser()) {
        make_coarser();
        continue;
      }
      const Measured first = many ? near : from_start(took_s);
      if (runs_.exit_code() != 0) return false;
      if (!first.error && !near.error) {
        if (error_of_ || near.diverged) throw_no_equilibrium(near);
        return false;
      }
      many = many || (near.error && (!first.error || std::abs(*first.error - *near.error) > same));
      if (many && took_s > longest_trial * runs_.left_s() && may_be_coarser()) {
        make_coarser();
        continue;
      }
      if (many) reference = beside;
      known_.still_moving = question_.speed(near.kinetic_energy);
      keep_probe(many ? near : first);
      return true;
    }
  }

  // Compared with the equilibrium that is found from the start; stopped if it takes much longer than the one
  // found from the end did.
  Measured from_start(double took_s) {
    constexpr double longer = 1.5, noise_s = 2;
    const RunConfig config = question_.run_with(known_.probe, question_.accuracy(known_));
    return runs_.within(noise_s + longer * took_s, [&] { return runs_.execute_one(config); });
  }

  // On half as many cells errors are nearly the same; a reference on fewer says little about a fine mesh.
  bool may_be_coarser() const {
    return known_.cells == 0 && question_.cells_that_may_vary() / 2 >= fewest_cells;
  }
  void make_coarser() { known_.cells = question_.cells_that_may_vary() / 2; }

  [[noreturn]] static void throw_no_equilibrium(const Measured& near) {
    throw std::runtime_error("there is no equilibrium to measure errors against: " +
                             (near.unfinished ? "none was found in time" : near.why) +
                             "; --what motion compares the motion instead");
  }

  [[noreturn]] void throw_too_slow() const {
    throw std::runtime_error(
        fmt::format("no reference was complete within --time-limit ({:.3g} s): the same command goes on with "
                    "it, and --time-limit {:.0f}s gives it more time",
                    limit_s_, std::ceil(4 * limit_s_)));
  }

  // Makes the reference coarser until it is expected to fit into its share of the time: a motion with fewer
  // substeps, then either on fewer cells.
  void make_it_fit() {
    Reference& reference = known_;
    if (reference.of == ErrorOf::own) return;
    constexpr int most = 1024, fewest = 64;
    double expected_s = 0;
    while (true) {
      for (int substeps = most; substeps >= fewest; substeps /= 2) {
        reference.substeps = reference.of == ErrorOf::motion ? substeps : 0;
        expected_s = reference_s();
        if (expected_s <= share_of_reference * runs_.left_s()) return tell_reference();
        if (reference.of == ErrorOf::rest) break;
      }
      if (!may_be_coarser()) break;
      make_coarser();
    }
    if (expected_s <= share_of_reference * limit_s_) throw_too_slow();
    throw std::runtime_error(
        fmt::format("nothing can be advised within --time-limit ({:.3g} s): the reference alone is expected "
                    "to take {}, even "
                    "{}. Give --time-limit {:.0f}s",
                    limit_s_, duration_text(expected_s),
                    reference.cells > 0 ? fmt::format("on {} cells", reference.cells) : "at its coarsest",
                    std::ceil(1.5 * expected_s / share_of_reference)));
  }

  void tell_reference() const {
    const Reference& reference = known_;
    if (reference.of == ErrorOf::motion)
      tell_(fmt::format("the reference is the same motion with {} substeps; one with {} shows its own error",
                        reference.substeps, reference.substeps / 2));
    if (reference.cells > 0)
      tell_(fmt::format("the reference has {} cells, because more would not fit into --time-limit",
                        reference.cells));
  }

  // Expected, s; with the coarser one that shows its error.
  double reference_s() const {
    const RunConfig config = question_.run_with(question_.own_setting(), question_.accuracy(known_));
    double seconds = 0;
    for (const bool coarser : {false, true})
      if (const auto reference = reference_of(config, Against::physical, coarser))
        if (const auto needs = forecast(*reference)) seconds += needs->cpu_s;
    return seconds;
  }

  // The run that is compared with the reference first: the config's own; if that flies apart, because from
  // its pose the search for an equilibrium would take long and find none, the reference's model with ever
  // more substeps.
  Measured probe(const Reference& reference) {
    std::vector<Setting> settings = {question_.own_setting()};
    for (const int substeps : {16, 64, 256})
      settings.push_back({.model = question_.reference_model(),
                          .method = Question::method_that_projects(),
                          .substeps = substeps});
    for (Setting& setting : settings) setting.cells = reference.cells;
    Measured found;
    for (const Setting& setting : settings) {
      known_.probe = setting;
      if (reference.of == ErrorOf::rest && setting != settings.back()) {
        found = runs_.execute_one(question_.run_with(setting, Json::object()));
        if (unusable(found)) continue;
      }
      found = runs_.execute_one(question_.run_with(setting, question_.accuracy(reference)));
      if (runs_.exit_code() != 0 || !unusable(found)) break;
    }
    return found;
  }

  static bool unusable(const Measured& found) {
    return found.failed || found.diverged ||
           (!found.unfinished && found.strain.value_or(0) > largest_reference_strain);
  }

  // Finds how the reference itself is stretched: a membrane with a compliance stretches rightly.
  void keep_probe(const Measured& found) {
    known_.accuracy = question_.accuracy(known_), known_.probed = found;
    const RunConfig config = question_.run_with(known_.probe, known_.accuracy);
    const std::filesystem::path file = runs_.reference_file(config);
    if (!std::filesystem::exists(file)) return;
    const bool over_time = config.settings().accuracy.over_time;
    known_.strain = strain_in(file, over_time), known_.stretch = stretch_in(file, over_time);
  }

  const Question& question_;
  Runs& runs_;
  std::optional<ErrorOf> error_of_;
  const std::function<void(const std::string&)>& tell_;
  double limit_s_;
  KnownReference known_;
};

}  // namespace

KnownReference choose_reference(const Question& question, Runs& runs, std::optional<ErrorOf> error_of,
                                const std::function<void(const std::string&)>& tell) {
  return ReferenceChooser(question, runs, error_of, tell).choose();
}

bool reference_tells(const KnownReference& reference) {
  return reference.strain <= largest_reference_strain && reference.gap.value_or(0) <= largest_error;
}

}  // namespace bendlab
