// Which settings to measure, cheapest first, so that the front becomes known up to what is demanded and
// little else is run.
//
// Each method has its ladder (ladder.hpp): its rungs are climbed one after another; those between are tried
// only if they may meet the demand, more of what it does not climb if the next fewer is on the front, and
// double precision if rounding seems to hold single back.
//
// A kind is a model with a variant (variant.hpp). The search starts with every model in one variant; others
// are considered when asked for.
//
// A setting is worth a run if it could be on the front: an error falls at best with the square of the work
// (substeps × iterations), but for iterations that converge, and what is known to cost more than a setting
// that already meets the demand need not be run. Since the cheapest come first, a tighter demand measures
// what a looser one did, and more. Unfit settings (fitness.hpp) are on no front and rule no other out; until
// one is fit, climbing goes before the rest.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/advise/fit.hpp"
#include "experiments/advise/front.hpp"

namespace bendlab {

class Search {
 public:
  struct Limits {
    int most_substeps = 256;
    double least_error = 0;  ///< no smaller error is predicted: the reference is known to that only
    /// CPU seconds per frame of a kind without a run yet; it may know none.
    std::function<std::optional<double>(const Setting&)> forecast = nullptr;
  };
  struct Next {
    Setting setting;
    /// Expected per frame; nothing before the kind's first run, unless that is forecast.
    std::optional<double> cpu_s = std::nullopt;
  };

  /// The coarsest setting of each kind to begin with.
  Search(std::vector<Setting> kinds, const Demand& demand, Limits limits);

  /// One more kind, that of this setting: from a quarter of its substeps on if its method climbs those, else
  /// from the lowest rung. False if it is among the kinds already, or was dropped.
  bool consider(const Setting& setting);

  /// What is worth a run now, the cheapest first; empty when the search is over.
  std::vector<Next> next() const;

  /// Adds what a run gave. It has no error if it diverged, had no reference, or was not compared because its
  /// strain is unfit.
  void add(const Setting& setting, std::optional<double> error, double cpu_s, const Strained& strained = {});

  /// Its error means nothing after all.
  void reject(const Setting& setting);

  /// No further run of this setting's kind.
  void drop(const Setting& setting);

  const std::vector<Rated>& measured() const { return measured_; }

  /// Whether a run with it may be stretched beyond what is fit: no coarser run of its kind was less
  /// stretched.
  bool may_be_stretched(const Setting& setting) const;

  /// Finer settings of kinds with at least three measured ones that follow a law, up to 4 times as much
  /// work. Their strain is that of the finest measured one, or less where it follows a law, too.
  std::vector<Rated> predicted() const;

 private:
  struct Result {
    std::optional<double> error{};
    double cpu_s = 0;
    Strained strained{};
    bool timed = false;  ///< it ran to its end
  };

  void find_front();
  const Result* find(const Setting& setting) const;
  static bool stretched(const Result& result);
  /// Nothing for a stretched run: its error means nothing.
  std::optional<double> error_of(const Setting& setting) const;
  std::optional<double> cost(const Setting& setting) const;
  double optimistic(const Setting& setting) const;
  bool on_front(const Setting& setting) const;
  bool is_next(const Setting& setting) const;
  bool continues(const Setting& setting) const;
  bool more_of_the_other(const Setting& setting) const;
  std::optional<double> error_below(const Setting& setting, int rungs) const;
  bool rounding_suspected(const Setting& setting) const;
  bool between(const Setting& setting) const;
  double longest() const;
  bool worth(const Setting& setting) const;
  std::vector<Setting> all_settings(const Setting& kind) const;
  Strained predicted_strain(const std::vector<Setting>& measured, const Setting& setting) const;

  std::vector<Setting> kinds_;  ///< of each its coarsest setting
  std::vector<Setting> dropped_;
  Demand demand_;
  Limits limits_;
  std::map<Setting, Result> results_;
  std::vector<Rated> measured_;
  std::vector<Rated> front_;  ///< of the fit ones
  std::vector<Rated> ahead_;  ///< the front; if nothing is fit, the points least beyond the limits
};

}  // namespace bendlab
