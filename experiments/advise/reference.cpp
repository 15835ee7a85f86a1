#include "experiments/advise/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/config/references.hpp"

namespace bendlab {
namespace {

constexpr double share_of_reference = 0.25;  // of the time that is left, for a finer reference of a motion
constexpr int coarsest_motion = 64, finest_motion = 1024;  // substeps
constexpr double share_of_a_try = 0.4;  // of the time that is left, until a coarser reference is tried

class ReferenceChooser {
 public:
  ReferenceChooser(const Question& question, Runs& runs, std::optional<ErrorOf> error_of)
      : question_(question), runs_(runs), error_of_(error_of), limit_s_(runs.left_s()) {}

  // Without an equilibrium, a reference of the motion is chosen.
  KnownReference choose() {
    const ErrorOf of = error_of_.value_or(question_.natural_error());
    if (!find_reference(of) && runs_.exit_code() == 0) find_reference(ErrorOf::motion);
    return known_;
  }

 private:
  // Finds a reference in the time that is left: on the config's mesh or, if that takes too long, on half the
  // cells, which hardly changes the errors. With still fewer cells, the reference would say little about a
  // fine mesh. False if the scene has no reference of this kind, or if `runs_` has an exit code.
  bool find_reference(ErrorOf of) {
    const int half = of == ErrorOf::own ? 0 : question_.cells_that_may_vary() / 2;
    const std::vector<int> meshes = half >= fewest_cells ? std::vector{0, half} : std::vector{0};
    for (const int cells : meshes) {
      const bool motion = of == ErrorOf::motion;
      static_cast<Reference&>(known_) = {.of = of, .cells = cells, .substeps = motion ? coarsest_motion : 0};
      const std::optional<bool> exists =
          of == ErrorOf::rest ? try_equilibrium(cells != meshes.back()) : try_motion();
      if (motion && exists == true) refine_motion();
      if (exists || runs_.exit_code() != 0) return exists.value_or(false);
    }
    throw std::runtime_error(
        fmt::format("no advice is possible within --time-limit ({:.3g} s): even the coarsest reference takes "
                    "too long. Give --time-limit {:.0f}s; the command then continues from the runs that are "
                    "done",
                    limit_s_, std::ceil(4 * limit_s_)));
  }

  // Replaces the reference of a motion by the finest one that should take at most a share of the time that is
  // left. The time of the coarsest reference says how long the others take: n times the substeps take at most
  // n times as long, and a reference with half the substeps is computed for the reference's own error.
  void refine_motion() {
    const KnownReference coarsest = known_;
    const auto time_of = [&](int substeps) { return 1.5 * coarsest.cpu_s * substeps / coarsest_motion; };
    int substeps = finest_motion;
    while (substeps > coarsest_motion && time_of(substeps) > share_of_reference * runs_.left_s())
      substeps /= 2;
    if (substeps == coarsest_motion) return;
    known_.substeps = substeps;
    if (!try_motion()) known_ = coarsest;
  }

  // Searches an equilibrium from the end of a run, and an equilibrium from the start of the run. If the two
  // differ, the scene has many equilibria, and each run needs its own reference, which has to be quick. The
  // search from the start is stopped if it takes much longer than the search from the end; the two then count
  // as different. Nothing if the search takes too long, false if there is no equilibrium.
  std::optional<bool> try_equilibrium(bool may_be_coarser) {
    constexpr double same = 0.002;        // of the size
    constexpr double longest_try = 0.15;  // of the time that is left
    constexpr double longer = 1.5, noise_s = 2;
    known_.start_from_end = true;
    const double left_s = runs_.left_s();
    const Trial near = probe();
    const double took_s = left_s - runs_.left_s();
    if (near.unfinished && (may_be_coarser || runs_.exit_code() != 0)) return std::nullopt;
    known_.start_from_end = false;
    const Trial first =
        runs_.execute({near.setting}, question_.accuracy(known_), noise_s + longer * took_s).front();
    if (runs_.exit_code() != 0) return std::nullopt;
    const bool has_near = std::isfinite(near.error), has_first = std::isfinite(first.error);
    if (!has_near && !has_first) {
      if (!error_of_ && !near.diverged) return false;
      throw std::runtime_error("there is no equilibrium to measure errors against: " +
                               (near.unfinished ? "the search did not end in time" : near.why) +
                               "; --what motion compares the motion instead");
    }
    known_.start_from_end = has_near && !(std::abs(first.error - near.error) <= same);
    if (known_.start_from_end && took_s > longest_try * runs_.left_s() && may_be_coarser) return std::nullopt;
    keep(known_.start_from_end ? near : first);
    return true;
  }

  // Computes the reference of a motion, or the config's own reference. Nothing if this takes too long.
  std::optional<bool> try_motion() {
    const Trial trial = probe();
    if (trial.unfinished) return std::nullopt;
    if (!std::isfinite(trial.error))
      throw std::runtime_error("there is no reference to measure errors against: " + trial.why);
    keep(trial);
    return true;
  }

  // The first run that is compared with the reference. This run has the config's own setting. If its cloth
  // flies apart, a search for an equilibrium from its pose would take long and fail. Then the run has the
  // reference's model, with more and more substeps.
  Trial probe() {
    const double end_s = (1 - share_of_a_try) * runs_.left_s();
    std::vector<Setting> settings = {question_.own_setting()};
    for (const int substeps : {16, 64, 256})
      settings.push_back({.model = question_.reference_model(),
                          .method = std::string(method_that_projects().name()),
                          .substeps = substeps});
    const auto is_unusable = [](const Trial& run) {
      return run.failed || run.diverged || run.strain > largest_reference_strain;
    };
    Trial trial;
    for (Setting& setting : settings) {
      setting.cells = known_.cells, trial = {};
      if (known_.of == ErrorOf::rest && setting != settings.back())
        trial = runs_.execute({setting}, Json::object(), runs_.left_s() - end_s).front();
      if (!is_unusable(trial))
        trial = runs_.execute({setting}, question_.accuracy(known_), runs_.left_s() - end_s).front();
      if (!is_unusable(trial)) break;
    }
    return trial;
  }

  // Stores the reference with its own strain and stretch, because a membrane with a compliance may stretch.
  void keep(const Trial& probe) {
    known_.accuracy = question_.accuracy(known_), known_.probe = probe.setting;
    known_.gap = runs_.reference_gap();
    known_.still_moving = known_.of == ErrorOf::rest ? probe.speed : 0;
    const Trial reference = runs_.reference_of(probe.setting, known_.accuracy);
    known_.strain = reference.strain, known_.stretch = reference.stretch;
    known_.cpu_s = reference.cpu_s;
  }

  const Question& question_;
  Runs& runs_;
  std::optional<ErrorOf> error_of_;
  double limit_s_;
  KnownReference known_;
};

}  // namespace

KnownReference choose_reference(const Question& question, Runs& runs, std::optional<ErrorOf> error_of) {
  return ReferenceChooser(question, runs, error_of).choose();
}

}  // namespace bendlab
