// A list of vertex pairs in half the memory of two numbers each: there may be a hundred million.
//
// Models list the springs of one vertex after another. So the first vertices come in runs, each of which is
// stored once:
//
//   pairs    (3,7) (3,8) (3,12) (4,8) (4,9) …
//   second     7     8     12     8     9   …
//   runs       3 from pair 0,     4 from pair 3, …
//
// Any list can be stored. One whose neighbours have different first vertices takes 12 bytes a pair.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace bendlab {

class PairList {
 public:
  using value_type = std::array<int, 2>;

  PairList() = default;
  PairList(std::initializer_list<value_type> pairs);
  explicit PairList(const std::vector<value_type>& pairs);

  std::size_t size() const { return second_.size(); }
  bool empty() const { return second_.empty(); }
  void reserve(std::size_t count);
  void push_back(const value_type& pair);

  value_type operator[](std::size_t index) const { return {first(index), second_[index]}; }
  int first(std::size_t index) const;
  int second(std::size_t index) const { return second_[index]; }
  /// Whether no first vertex is below that of the pair before.
  bool ascends() const;

  bool operator==(const PairList&) const = default;
  std::size_t memory_bytes() const;

  /// Goes through the pairs. They are made when they are read, so there are no references to them.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = std::array<int, 2>;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = value_type;

    Iterator(const PairList& list, std::size_t index) : list_(&list), index_(index) {}
    value_type operator*() const { return (*list_)[index_]; }
    Iterator& operator++() { return ++index_, *this; }
    Iterator operator++(int) { return {*list_, index_++}; }
    bool operator==(const Iterator&) const = default;

   private:
    const PairList* list_;
    std::size_t index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  struct Run {
    int vertex;
    int begin;  // its first pair
    bool operator==(const Run&) const = default;
  };
  // A pair's run is among the few of its block.
  static constexpr std::size_t block = 64;

  std::vector<int> second_;
  std::vector<Run> runs_;
  std::vector<int> run_of_block_;  // of the first pair of each block
};

inline int PairList::first(std::size_t index) const {
  const std::size_t at = index / block;
  auto low = static_cast<std::size_t>(run_of_block_[at]);
  std::size_t high =
      at + 1 < run_of_block_.size() ? static_cast<std::size_t>(run_of_block_[at + 1]) : runs_.size() - 1;
  while (low < high) {  // the last of these runs that begins at the pair or before
    const std::size_t middle = (low + high + 1) / 2;
    if (static_cast<std::size_t>(runs_[middle].begin) <= index)
      low = middle;
    else
      high = middle - 1;
  }
  return runs_[low].vertex;
}

}  // namespace bendlab
