// Runs the settings that a search asks for, and says what came of it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/advise/front.hpp"
#include "experiments/advise/reference.hpp"
#include "experiments/run/warning.hpp"

namespace bendlab {

struct AdviceOptions {
  Demand demand;
  std::optional<ErrorOf> error_of = std::nullopt;  ///< nothing: Question::natural_error()
  std::vector<std::string> models;                 ///< empty: every registered one
  std::vector<std::string> methods;                ///< of advised_methods(); empty: all
  double time_limit_s = 120;                       ///< wall time of it all, the reference's too
  CampaignOptions campaign;                        ///< runs lie below <out>/advise/<name>
};

struct LeftOut {
  std::string what, why;
};

/// Adds it, together with what has the same reason.
void leave_out(std::vector<LeftOut>& left_out, const std::string& what, const std::string& why);

struct Advice {
  KnownReference reference;
  /// Of measured points: rms of the Green strain, of which the stated cloth has none.
  std::map<Setting, double> strain;
  std::map<Setting, std::vector<Warning>> warnings;  ///< of measured points: those of their runs
  /// What the demand asked for, if it is fit and the reference is known that well.
  std::optional<Rated> best = std::nullopt;
  std::optional<Rated> nearest = std::nullopt;  ///< if there is no best; it may be unfit
  std::vector<Rated> points;                    ///< measured
  std::vector<Rated> front;                     ///< of the fit points
  std::vector<LeftOut> left_out;
  std::vector<Setting> not_tried;  ///< because the time was over
  int computed = 0;                ///< number of runs that were not complete before
  /// Of a signal, or of an error that every run would have (files, mesh); the rest is then incomplete.
  int exit_code = 0;
};

/// `tell` gets a line of news from time to time. Throws like Question::run_with if no model can be this
/// cloth, and std::runtime_error if there is no reference, or none within the time limit.
Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& tell);

}  // namespace bendlab
