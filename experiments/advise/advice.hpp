// Runs the settings that a search asks for, and says what came of it.
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
  std::vector<std::string> models;                 ///< empty: every registered one
  std::vector<std::string> methods;                ///< of the measured fronts; empty: all
  double time_limit_s = 120;                       ///< wall time of it all, the reference's too
  CampaignOptions campaign;                        ///< runs lie below <out>/advise/<name>
};

struct LeftOut {
  std::string what, why;
};

struct Advice {
  KnownReference reference;
  std::vector<Trial> trials;
  std::vector<Trial> front;     ///< of the fit trials
  std::optional<Trial> choice;  ///< what suits the demand, or comes nearest; then it may be unfit
  bool is_met = false;          ///< the choice meets the demand, and the reference is known that well
  std::vector<LeftOut> left_out;
  std::vector<Setting> not_tried;  ///< because the time was over
  int computed = 0;                ///< number of runs that were not complete before
  /// Of a signal, or of an error that every run would have (files, mesh); the rest is then incomplete.
  int exit_code = 0;

  /// Whether a setting that was run may be advised for a larger error, or for more time.
  bool anything_fit() const { return reference.tells() && !front.empty(); }
};

/// `tell` gets a line of news from time to time. Throws like Question::experiment_with if no model can be
/// this cloth, and std::runtime_error if there is no reference, or none within the time limit.
Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& tell);

/// Why the demand is not met, in sentences, the gravest first; empty if it is.
std::vector<std::string> why_none(const Advice& advice, const AdviceOptions& options);

}  // namespace bendlab
