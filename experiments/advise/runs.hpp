// The runs that advice needs, within a time limit.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/advise/question.hpp"
#include "experiments/campaign/campaign.hpp"
#include "experiments/campaign/run_times.hpp"

namespace bendlab {

/// The time of a steady clock, s.
double wall_clock_s();

class Runs {
 public:
  /// The time limit starts now, by the clock `now_s`. Runs lie below <out>/advise/<name>.
  Runs(const Question& question, CampaignOptions campaign, double time_limit_s,
       std::function<double()> now_s);

  double left_s() const { return end_s_ - now_s_(); }
  bool over() const { return exit_code_ != 0 || left_s() <= 0; }
  /// 0, or the exit code of a signal or of an error that every run would have (files, mesh).
  int exit_code() const { return exit_code_; }
  int computed() const { return computed_; }  ///< number of runs that were not complete before
  /// The reference's own error, in sizes of the mesh, if a run's summary has it.
  std::optional<double> reference_gap() const { return gap_; }

  /// Runs the scene with each setting, several runs at a time; /duration is multiplied by `times`. Runs with
  /// little work (crude_work()) come first. Stops runs that take longer than `seconds`, or than the time
  /// limit. Strain and stretch of a trial are those of its run; the caller compares them with the reference.
  /// If exit_code() is not 0, all trials are unfinished.
  std::vector<Trial> execute(const std::vector<Setting>& settings, const Json& accuracy, double seconds,
                             double times = 1);

  /// Whether a run may end in time: true if its file exists, if finished runs give no estimate, or if the
  /// estimated time is less than left_s().
  bool in_time(const Setting& setting, const Json& accuracy, double times = 1) const;

  /// Strain, stretch and total CPU time of the reference that a run is compared with. If the reference has no
  /// file: strain 0, stretch 1, time 0.
  Trial reference_of(const Setting& setting, const Json& accuracy) const;

 private:
  const Question& question_;
  CampaignOptions campaign_;
  std::function<double()> now_s_;
  double end_s_;
  int exit_code_ = 0, computed_ = 0;
  std::optional<double> gap_;
  RunTimes times_;  // of the runs that are finished
};

}  // namespace bendlab
