// Chooses the settings to run, by successive halving. Settings of one kind differ only in their work
// (substeps and iterations). First, each kind that was the best of a measured scene is run once. Then the
// better half of the kinds is run again, with more or less work, as the demand needs it. This step repeats
// until at most three kinds are left and further work helps none of them. If no setting meets the demand
// then, kinds that were dropped before are run again.
//
// Twice the work of a setting takes about twice the time, and gives about half the error. If one run of a
// kind had too little work for the demand and another run too much, the next run has a work between the two.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/advise/trial.hpp"

namespace bendlab {

class Search {
 public:
  /// Runs settings, and returns the trials of settings that could be run. If no setting could be run, the
  /// search ends.
  using Run = std::function<std::vector<Trial>(const std::vector<Setting>&)>;

  /// No setting has more than `most_substeps`.
  Search(const Demand& demand, int most_substeps, Run run);

  /// Adds new kinds, and runs settings until no further run would help. False if no setting was run.
  bool run(const std::vector<SettingKind>& kinds);

  /// Drops the trial of `setting`, whose result means nothing. Its kind is not run any more.
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
  Run run_;
  std::vector<Setting> known_;    // a setting of each kind that was ever added
  std::vector<Candidate> kinds_;  // the most promising first
  std::size_t active_ = 0;        // number of kinds that go on
  std::vector<Trial> trials_;
};

}  // namespace bendlab
