// Runs what a search asks for, and what came of it.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/advise/question.hpp"
#include "experiments/advise/search.hpp"
#include "experiments/campaign/campaign.hpp"

namespace bendlab {

struct AdviceOptions {
  Demand demand;
  std::optional<ErrorOf> error_of = std::nullopt;  ///< nothing: as the scene is
  std::vector<std::string> models;                 ///< empty: every registered one
  double time_limit_s = 120;  ///< wall time for runs that are not there yet, without making the reference
  CampaignOptions campaign;   ///< runs lie below <out>/advise/<name>
};

struct LeftOut {
  std::string what, why;
};

struct Advice {
  ErrorOf error_of = ErrorOf::rest;
  bool many_equilibria = false;
  Json accuracy;  ///< the section that the errors come from
  std::optional<double> reference_gap =
      std::nullopt;              ///< what the reference itself is not known to, in sizes
  double reference_strain = 0;   ///< rms of its Green strain: the stated membrane may give way
  double reference_stretch = 1;  ///< of a triangle, the largest
  double still_moving = 0;       ///< of the pose at rest: the cloth's rms speed at the end, sizes per second
  std::map<Setting, double>
      strain;  ///< of measured points: rms of the Green strain, of which the stated cloth has none
  std::optional<Rated> best =
      std::nullopt;  ///< what the demand asked for, if it is fit and the reference is known that well
  std::optional<Rated> nearest = std::nullopt;  ///< where there is none; it may be unfit
  std::vector<Rated> points;                    ///< measured, and predicted where the time ended
  std::vector<Rated> front;                     ///< of the fit ones
  std::vector<LeftOut> left_out;
  int computed = 0;          ///< runs, besides those that were there
  bool out_of_time = false;  ///< some settings were not measured
  int exit_code =
      0;  ///< of a signal, or of what no run could do without (files, mesh); the rest is then not complete
};

/// `tell` gets a line of news from time to time. Throws as Question::run_with does where no model can be this
/// cloth, and std::runtime_error where there is no reference.
Advice advise(const Question& question, const AdviceOptions& options,
              const std::function<void(const std::string&)>& tell);

}  // namespace bendlab
