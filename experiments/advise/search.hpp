// Chooses the settings to run, by successive halving. First, kinds of settings that were the best of measured
// scenes are run. The better half of them goes on, with more or less work, as the demand needs it. This
// repeats until at most three kinds are left, and the right work of each kind is found. If none of these
// kinds meets the demand, the kinds that were left behind go on.
//
// The error of a kind falls, and its time grows, about in proportion to its work. If one run of a kind falls
// short of the demand and another run does more than needed, the work of the next run lies between them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/advise/trial.hpp"

namespace bendlab {

class Search {
 public:
  /// CPU seconds per frame that a setting is expected to take; 0 if that is not known.
  using ExpectedCpu = std::function<double(const Setting&)>;
  /// Runs settings, and returns the trials of settings that could be run. If no setting could be run, the
  /// search ends.
  using Run = std::function<std::vector<Trial>(const std::vector<Setting>&)>;

  /// No setting has more than `most_substeps`.
  Search(const Demand& demand, int most_substeps, ExpectedCpu expected_cpu_s, Run run);

  /// Adds new kinds, and runs the settings that are worth a run. False if no setting was run.
  bool run(const std::vector<SettingKind>& kinds);

  /// Drops the trial of this setting, because its result means nothing. The kind of the setting is not run
  /// any more.
  void reject(const Setting& setting);

  const std::vector<Trial>& trials() const { return trials_; }

 private:
  struct Candidate {
    Setting start;
    int most_iterations = 0;
    std::vector<Trial> trials{};
  };

  void add(const SettingKind& kind);
  std::vector<Setting> next();
  double promise(const Candidate& kind) const;
  std::optional<Setting> step(const Candidate& kind) const;
  bool is_worth_more(const Candidate& kind, const Trial& trial, double factor) const;

  Demand demand_;
  int most_substeps_;
  ExpectedCpu expected_cpu_s_;
  Run run_;
  std::vector<Setting> known_;    // a setting of each kind that was ever added
  std::vector<Candidate> kinds_;  // the most promising first
  std::size_t active_ = 0;        // number of kinds that go on
  std::vector<Trial> trials_;
};

}  // namespace bendlab
