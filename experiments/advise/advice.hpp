// Runs the settings that a search chooses, and gives the advice.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/advise/reference.hpp"

namespace bendlab {

struct AdviceOptions {
  Demand demand;
  std::optional<ErrorOf> error_of = std::nullopt;  ///< nothing: Question::natural_error()
  std::vector<std::string> models;                 ///< empty: every registered model
  std::vector<std::string> methods;                ///< empty: all methods of the measured fronts
  double time_limit_s = 120;                       ///< wall time of all runs, including the reference
  /// The time in s that the limit is compared with. Called by several threads.
  std::function<double()> now_s = wall_clock_s;
  CampaignOptions campaign;  ///< runs lie below <out>/advise/<name>
};

struct LeftOut {
  std::string what, why;
};

struct Advice {
  KnownReference reference;
  std::vector<Trial> trials;
  std::vector<Trial> front;     ///< the fit trials that are more accurate than every faster fit trial
  std::optional<Trial> choice;  ///< the trial that meets the demand, or the nearest one, which may be unfit
  bool is_met = false;          ///< the choice meets the demand, and the reference is accurate enough
  std::vector<LeftOut> left_out;
  std::vector<Setting> not_tried;  ///< because the time limit was reached
  int computed = 0;                ///< number of runs that were not complete before
  /// 0, or the exit code for a signal or for an error that every run would have (files, mesh). If the exit
  /// code is not 0, the advice is incomplete.
  int exit_code = 0;

  /// Whether a setting could be advised if a larger error or more time were allowed.
  bool anything_fit() const { return reference.tells() && !front.empty(); }
};

/// Calls `report` with a line about the progress from time to time. Throws like Question::experiment_with()
/// if no model can represent this cloth, and std::runtime_error if there is no reference, or no reference
/// within the time limit.
Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& report);

/// The reasons why the demand is not met, as sentences, the most serious first; empty if the demand is met.
std::vector<std::string> why_none(const Advice& advice, const AdviceOptions& options);

}  // namespace bendlab
