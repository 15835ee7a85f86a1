// Which settings to measure, cheapest first, so that the front becomes known up to what is demanded and
// little else is run.
//
//   substeps   1 2 3 4 6 8 … 256    every model doubles them; 3, 6, 12 … only if they may meet the demand
//   iterations 1 2 4 10             if the next fewer is on the front
//   precision  single, double       double if rounding seems to hold single back
//
// A setting is worth a run if it could be on the front: an error falls at best with the square of the work
// (substeps × iterations), and what is known to cost more than a setting that already meets the demand need
// not be run. Since the cheapest come first, a tighter demand measures what a looser one did, and more. Unfit
// settings (fitness.hpp) are on no front and rule no other out; until one is fit, more substeps go before
// more iterations.
#pragma once

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
  };
  struct Next {
    Setting setting;
    std::optional<double> cpu_s = std::nullopt;  ///< expected per frame; nothing before the model's first run
  };

  Search(std::vector<std::string> models, const Demand& demand, const Limits& limits);

  /// What is worth a run now, the cheapest first; empty when the search is over.
  std::vector<Next> next() const;

  /// Adds what a run gave. It has no error if it diverged, had no reference, or was not compared because its
  /// strain is unfit.
  void add(const Setting& setting, std::optional<double> error, double cpu_s, const Strained& strained = {});

  /// No further run of the model.
  void drop(const std::string& model);

  const std::vector<Rated>& measured() const { return measured_; }

  /// Whether a run with it may be stretched beyond what is fit: no coarser run of its model was less
  /// stretched.
  bool may_be_stretched(const Setting& setting) const;

  /// Finer settings of models with at least three measured ones that follow a law, up to 4 times as much
  /// work. Their strain is that of the finest measured one, or less where it follows a law, too.
  std::vector<Rated> predicted() const;

 private:
  struct Result {
    std::optional<double> error{};
    double cpu_s = 0;
    Strained strained{};
    bool timed = false;  ///< it ran to its end
  };

  const Result* find(const Setting& setting) const;
  static bool stretched(const Result& result);
  /// Nothing for a stretched run: its error means nothing.
  std::optional<double> error_of(const Setting& setting) const;
  std::optional<double> cost(const Setting& setting) const;
  double optimistic(const Setting& setting) const;
  bool on_front(const Setting& setting) const;
  bool is_next(const Setting& setting) const;
  bool continues(const Setting& setting) const;
  bool more_iterations(const Setting& setting) const;
  bool rounding_suspected(const Setting& setting) const;
  bool between(const Setting& setting) const;
  double longest() const;
  bool worth(const Setting& setting) const;
  std::vector<Setting> all_settings(const std::string& model) const;
  Strained predicted_strain(const std::vector<Setting>& measured, const Setting& setting) const;

  std::vector<std::string> models_;
  Demand demand_;
  Limits limits_;
  std::map<Setting, Result> results_;
  std::vector<Rated> measured_;
  std::vector<Rated> front_;  ///< of the fit ones
  std::vector<Rated> ahead_;  ///< the front; if nothing is fit, the points least beyond the limits
};

}  // namespace bendlab
