// Which settings to run, by successive halving: kinds of settings that were the best of measured scenes are
// run, the better half of them goes on with more work or less, by what the demand asks for, and so on, until
// at most three are left and the work of each is found. If none of them meets the demand, those that were
// left behind go on.
//
// A kind is what differs in more than substeps and iterations. Its error falls, and its time grows, about
// with its work: from two runs of it, of which one falls short of the demand and one does more, the next is
// between them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "experiments/advise/front.hpp"

namespace bendlab {

class Search {
 public:
  /// CPU seconds per frame that a setting is expected to take; it may know none.
  using Forecast = std::function<std::optional<double>(const Setting&)>;

  /// No setting has more than `most_substeps`.
  Search(const Demand& demand, int most_substeps, Forecast forecast);

  /// Adds a kind for each setting that is of none yet. Of several settings of a kind it starts with the one
  /// that is expected to come nearest to the demand. False if there was no new kind.
  bool consider(const std::vector<Setting>& settings);

  /// The settings of the next round; empty when the search is over.
  std::vector<Setting> next();

  /// Adds what a run gave.
  void add(const Rated& point);

  /// No further run of this setting's kind.
  void drop(const Setting& setting);

  /// Its error means nothing after all.
  void reject(const Setting& setting);

  const std::vector<Rated>& measured() const { return measured_; }

 private:
  struct Kind {
    Setting start;
    int most_iterations;
    std::vector<Rated> tried{};
    bool over = false;
  };

  Setting start_of(const std::vector<Setting>& settings) const;
  double best_score(const Kind& kind) const;
  bool falls_short(const Rated& point) const;
  std::optional<Setting> step(const Kind& kind) const;
  std::optional<double> factor_above(const Kind& kind, const Rated& short_of) const;
  std::vector<Setting> steps();
  void halve();

  Demand demand_;
  int most_substeps_;
  Forecast forecast_;
  std::vector<Kind> kinds_;
  std::vector<Kind> resting_;   // halving left them behind
  std::vector<Setting> ended_;  // of each kind that goes on no more
  std::vector<Rated> measured_;
};

}  // namespace bendlab
