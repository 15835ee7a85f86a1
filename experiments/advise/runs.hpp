// The runs that advice needs, within a time limit.
#pragma once

#include <optional>
#include <vector>

#include "experiments/advise/measured.hpp"
#include "experiments/advise/question.hpp"
#include "experiments/advise/time_limit.hpp"

namespace bendlab {

class Runs {
 public:
  /// The time begins now. Runs lie below <out>/advise/<name>.
  Runs(const Question& question, CampaignOptions campaign, double time_limit_s);

  double left_s() const { return limit_.left_s(); }
  bool over() const { return exit_code_ != 0 || limit_.over(); }
  /// Of a signal, or of an error that every run would have (files, mesh).
  int exit_code() const { return exit_code_; }
  int side_by_side() const { return jobs_; }
  int computed() const { return computed_; }  ///< number of runs that were not complete before
  /// The reference's own error, in sizes of the mesh, if a run told it.
  std::optional<double> reference_gap() const { return gap_; }

  /// Those that the time limit stopped are unfinished. Nothing if there is an exit code.
  std::vector<Measured> execute(std::vector<RunConfig> configs);
  Measured execute_one(RunConfig config);

  /// What `run` gives, its runs being stopped after so many seconds.
  template <class Run>
  Measured within(double seconds, const Run& run) {
    const TimeLimit limit(std::min(seconds, limit_.left_s()));
    campaign_.stop = &limit.over();
    Measured found = run();
    campaign_.stop = &limit_.over();
    return found;
  }

  /// CPU seconds per frame, as forecast.
  std::optional<double> forecast_per_frame(const Setting& setting) const;

  /// Whether the run is there, or expected to end in time.
  bool in_time(const RunConfig& config) const;

  /// The file of the reference that a run was compared with; it may not exist.
  std::filesystem::path reference_file(const RunConfig& config) const;

 private:
  const Question& question_;
  CampaignOptions campaign_;
  TimeLimit limit_;
  int jobs_ = 1, exit_code_ = 0, computed_ = 0;
  std::optional<double> gap_;
};

}  // namespace bendlab
