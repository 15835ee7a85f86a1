// Which settings to run, by successive halving: kinds of settings that were the best of measured scenes are
// run, the better half of them goes on with more work or less, by what the demand asks for, and so on, until
// at most three are left and the work of each is found. If none of them meets the demand, those that were
// left behind go on.
//
// The error of a kind falls, and its time grows, about with its work: from two runs of it, of which one falls
// short of the demand and one does more, the next is between them.
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
  /// Runs settings, and gives what came of those that could be run. If none could, the search ends.
  using Run = std::function<std::vector<Trial>(const std::vector<Setting>&)>;

  /// No setting has more than `most_substeps`.
  Search(const Demand& demand, int most_substeps, ExpectedCpu expected_cpu_s, Run run);

  /// Adds the kinds that are new, and runs what is worth a run. False if nothing was.
  bool run(const std::vector<SettingKind>& kinds);

  /// What this setting gave means nothing, and its kind is not run any more.
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
  std::vector<Setting> known_;    // one of each kind that was ever added
  std::vector<Candidate> kinds_;  // the most promising first
  std::size_t active_ = 0;        // how many of them go on
  std::vector<Trial> trials_;
};

}  // namespace bendlab
