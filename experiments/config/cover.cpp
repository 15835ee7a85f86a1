#include "experiments/config/cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "bendlab/scene/counted.hpp"
#include "bendlab/settings/random_numbers.hpp"

namespace bendlab {
namespace {

constexpr std::size_t open = static_cast<std::size_t>(-1);  // marks an axis that has no value yet
constexpr std::size_t most_tuples = 20'000'000;             // one byte each
constexpr int candidates = 10;  // rows of which the best is kept; 50 rows made the arrays only 1 % smaller
// A combination of values counts as impossible after 60 refused rows. The first 5 rows are greedy. In the 55
// later rows about every second value is random. Suppose a combination is allowed only with one of the two
// values of another axis: all 55 rows miss that value with a probability of 0.75^55 = 10⁻⁷.
constexpr int greedy_attempts = 5, most_attempts = 60;

// Random numbers that are the same on every machine, unlike those of the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}

  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(split_mix(seed_, drawn_++) % count);
  }

  void shuffle(std::vector<std::size_t>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

// Records which combinations of values of any `strength` axes are in a row already.
class Coverage {
 public:
  Coverage(std::span<const std::size_t> sizes, std::size_t strength) : sizes_(sizes) {
    groups_of_axis_.resize(sizes.size());
    std::vector<std::size_t> axes(strength);
    std::iota(axes.begin(), axes.end(), std::size_t{0});
    do add_group(axes);
    while (next_group(axes));
  }

  std::size_t tuples() const { return tuples_; }
  std::size_t missing() const { return missing_; }

  /// The number of uncovered combinations that `row` would cover with `value` at `axis`. Counts only
  /// combinations of axes that have a value.
  std::size_t gain(CoverRow& row, std::size_t axis, std::size_t value) const {
    row[axis] = value;
    std::size_t gain = 0;
    for (const std::size_t g : groups_of_axis_[axis])
      if (const std::size_t place = index_in(groups_[g], row);
          place != open && groups_[g].state[place] == missing_here)
        ++gain;
    row[axis] = open;
    return gain;
  }

  std::size_t gain(const CoverRow& row) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        groups_, [&](const Group& group) { return group.state[index_in(group, row)] == missing_here; }));
  }

  void add(const CoverRow& row) {
    for (Group& group : groups_) settle(group, index_in(group, row), covered);
  }

  /// An uncovered combination of the axes with the most uncovered combinations; empty if all are covered.
  CoverTuple first_missing() const {
    const auto worst = std::ranges::max_element(groups_, {}, &Group::missing);
    if (worst == groups_.end() || worst->missing == 0) return {};
    const auto found = std::ranges::find(worst->state, missing_here);
    std::size_t place = static_cast<std::size_t>(found - worst->state.begin());
    CoverTuple tuple;
    for (std::size_t i = worst->axes.size(); i-- > 0;) {
      const std::size_t size = sizes_[worst->axes[i]];
      tuple.insert(tuple.begin(), {worst->axes[i], place % size});
      place /= size;
    }
    return tuple;
  }

  /// Marks the uncovered combinations that contain `tuple` as impossible. Returns their number.
  std::size_t give_up(const CoverTuple& tuple) {
    std::size_t given_up = 0;
    for (Group& group : groups_) {
      const bool holds_its_axes = std::ranges::all_of(
          tuple, [&](const auto& part) { return std::ranges::binary_search(group.axes, part.first); });
      if (holds_its_axes) given_up += give_up(group, tuple);
    }
    return given_up;
  }

 private:
  enum State : unsigned char { missing_here, covered, impossible };

  struct Group {
    std::vector<std::size_t> axes;  // ascending
    std::vector<State> state;       // of each combination of values, the last axis fastest
    std::size_t missing;
  };

  void add_group(const std::vector<std::size_t>& axes) {
    std::size_t count = 1;
    for (const std::size_t axis : axes) count = std::min(count * sizes_[axis], most_tuples + 1);
    tuples_ += count;
    if (tuples_ > most_tuples)
      throw std::invalid_argument(
          fmt::format("the cover has more than {} combinations of {}; choose a smaller strength", most_tuples,
                      counted(axes.size(), "value")));
    missing_ = tuples_;
    for (const std::size_t axis : axes) groups_of_axis_[axis].push_back(groups_.size());
    groups_.push_back({axes, std::vector<State>(count, missing_here), count});
  }

  // Replaces `axes` by the next combination of as many axes, in lexicographic order. False after the last.
  bool next_group(std::vector<std::size_t>& axes) const {
    const std::size_t count = axes.size();
    for (std::size_t i = count; i-- > 0;) {
      if (axes[i] + count - i >= sizes_.size()) continue;
      ++axes[i];
      for (std::size_t j = i + 1; j < count; ++j) axes[j] = axes[j - 1] + 1;
      return true;
    }
    return false;
  }

  // The index of the row's values in the group's list of combinations; `open` if an axis of the group has no
  // value.
  std::size_t index_in(const Group& group, const CoverRow& row) const {
    std::size_t place = 0;
    for (const std::size_t axis : group.axes) {
      if (row[axis] == open) return open;
      place = place * sizes_[axis] + row[axis];
    }
    return place;
  }

  bool settle(Group& group, std::size_t place, State state) {
    if (group.state[place] != missing_here) return false;
    group.state[place] = state;
    --group.missing, --missing_;
    return true;
  }

  std::size_t give_up(Group& group, const CoverTuple& tuple) {
    std::size_t given_up = 0;
    CoverRow row(sizes_.size(), 0);
    for (std::size_t place = 0; place < group.state.size(); ++place) {
      std::size_t rest = place;
      for (std::size_t i = group.axes.size(); i-- > 0; rest /= sizes_[group.axes[i]])
        row[group.axes[i]] = rest % sizes_[group.axes[i]];
      const bool holds =
          std::ranges::all_of(tuple, [&](const auto& part) { return row[part.first] == part.second; });
      if (holds && settle(group, place, impossible)) ++given_up;
    }
    return given_up;
  }

  std::span<const std::size_t> sizes_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::size_t>> groups_of_axis_;
  std::size_t tuples_ = 0, missing_ = 0;
};

// Suspect pairs: two values that were in a refused row together, but in no allowed row.
class Suspects {
 public:
  explicit Suspects(std::span<const std::size_t> sizes) : first_(sizes.size()) {
    std::size_t values = 0;
    for (std::size_t a = 0; a < sizes.size(); ++a) {
      first_[a] = values;
      values += sizes[a];
    }
    values_ = values;
    state_.resize(values * values, unknown);
  }

  void refuse(const CoverRow& row) {
    any_refused_ = true;
    for_each_pair(row, [](State& state) { state = state == unknown ? suspect : state; });
  }

  void allow(const CoverRow& row) {
    for_each_pair(row, [](State& state) { state = cleared; });
  }

  // The number of suspect pairs that `value` forms with the values of the row.
  std::size_t count(const CoverRow& row, std::size_t axis, std::size_t value) const {
    if (!any_refused_) return 0;
    std::size_t count = 0;
    for (std::size_t other = 0; other < row.size(); ++other)
      if (row[other] != open && other != axis)
        count += state_[(first_[axis] + value) * values_ + first_[other] + row[other]] == suspect;
    return count;
  }

 private:
  enum State : unsigned char { unknown, suspect, cleared };

  template <class Change>
  void for_each_pair(const CoverRow& row, Change change) {
    for (std::size_t a = 0; a < row.size(); ++a)
      for (std::size_t b = 0; b < row.size(); ++b)
        if (a != b) change(state_[(first_[a] + row[a]) * values_ + first_[b] + row[b]]);
  }

  std::vector<std::size_t> first_;
  std::size_t values_ = 0;
  std::vector<State> state_;
  bool any_refused_ = false;
};

class Builder {
 public:
  Builder(std::span<const std::size_t> sizes, const Cover& cover,
          const std::function<bool(const CoverRow&)>& allowed)
      : sizes_(sizes), allowed_(allowed), suspects_(sizes), random_(cover.seed) {
    const std::size_t strength = std::min(static_cast<std::size_t>(cover.strength), sizes.size());
    for (std::size_t s = 1; s <= strength; ++s) coverages_.emplace_back(sizes, s);
  }

  CoverRows build(std::size_t most_rows) {
    result_.tuples = coverages_.back().tuples();
    // Small combinations first: if two values are never allowed together, no larger combination with both
    // needs to be tried.
    for (const Coverage& coverage : coverages_)
      while (coverage.missing() > 0 && result_.rows.size() <= most_rows) cover(coverage.first_missing());
    return std::move(result_);
  }

 private:
  void cover(const CoverTuple& tuple) {
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      const CoverRow row = attempt < greedy_attempts ? best_row(tuple) : filled_row(tuple, true);
      if (!allowed_(row)) {
        suspects_.refuse(row);
        continue;
      }
      suspects_.allow(row);
      for (Coverage& coverage : coverages_) coverage.add(row);
      result_.rows.push_back(row);
      return;
    }
    result_.impossible.push_back(tuple);
    for (Coverage& coverage : coverages_) {
      const std::size_t given_up = coverage.give_up(tuple);
      if (&coverage == &coverages_.back()) result_.missing += given_up;
    }
  }

  CoverRow best_row(const CoverTuple& tuple) {
    CoverRow best;
    std::size_t best_gain = 0;
    for (int i = 0; i < candidates; ++i) {
      CoverRow row = filled_row(tuple, false);
      const std::size_t gain = coverages_.back().gain(row);
      if (best.empty() || gain > best_gain) best = std::move(row), best_gain = gain;
    }
    return best;
  }

  // A row that contains `tuple`. The remaining axes, in random order, take the value that covers most
  // combinations. With `loosely`, about half of these axes take a random value.
  CoverRow filled_row(const CoverTuple& tuple, bool loosely) {
    CoverRow row(sizes_.size(), open);
    for (const auto& [axis, value] : tuple) row[axis] = value;
    std::vector<std::size_t> axes;
    for (std::size_t axis = 0; axis < sizes_.size(); ++axis)
      if (row[axis] == open) axes.push_back(axis);
    random_.shuffle(axes);
    for (const std::size_t axis : axes)
      row[axis] = loosely && random_.below(2) == 0 ? random_.below(sizes_[axis]) : best_value(row, axis);
    return row;
  }

  // The value of the axis with the fewest suspect pairs; of these values, the value that covers most
  // combinations. The search starts at a random value, and takes the first of equal values.
  std::size_t best_value(CoverRow& row, std::size_t axis) {
    const std::size_t start = random_.below(sizes_[axis]);
    std::size_t best = open, best_gain = 0, fewest_suspects = 0;
    for (std::size_t i = 0; i < sizes_[axis]; ++i) {
      const std::size_t value = (start + i) % sizes_[axis];
      const std::size_t suspects = suspects_.count(row, axis, value);
      const std::size_t gain = coverages_.back().gain(row, axis, value);
      if (best == open || suspects < fewest_suspects || (suspects == fewest_suspects && gain > best_gain))
        best = value, best_gain = gain, fewest_suspects = suspects;
    }
    return best;
  }

  std::span<const std::size_t> sizes_;
  const std::function<bool(const CoverRow&)>& allowed_;
  std::vector<Coverage> coverages_;  // of 1, 2, … axes, up to the strength
  Suspects suspects_;
  Random random_;
  CoverRows result_;
};

}  // namespace

CoverRows covering_rows(std::span<const std::size_t> sizes, const Cover& cover,
                        const std::function<bool(const CoverRow&)>& allowed, std::size_t most_rows) {
  if (cover.strength < 1) throw std::invalid_argument("the strength of a cover must be at least 1");
  if (!sizes.empty()) return Builder(sizes, cover, allowed).build(most_rows);
  CoverRows single;
  if (allowed({})) single.rows.emplace_back();
  return single;
}

}  // namespace bendlab
