// A list of vertex pairs in half the memory of two numbers per pair. Scenes may have a hundred million pairs.
//
// Models list all springs of one vertex, then all springs of the next vertex. So the list consists of
// sections, whose pairs have the same first vertex. The first vertex is stored once per section:
//
//   pairs    (3,7) (3,8) (3,12) (4,8) (4,9) …
//   second     7     8     12     8     9   …
//   sections   3 from pair 0,     4 from pair 3, …
//
// The list can have any other order, too. A pair takes 12 bytes if the next pair has a different first
// vertex.
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
  /// Whether the first vertices are in ascending order; equal neighbours are allowed.
  bool ascends() const;

  bool operator==(const PairList&) const = default;
  std::size_t memory_bytes() const;

  /// Goes through the pairs. operator* returns a copy of a pair, because the list stores no pairs.
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
  struct Section {
    int vertex;
    int begin;  // index of the first pair
    bool operator==(const Section&) const = default;
  };
  // Number of pairs of a block. first() searches the section of a pair only among the sections of its block.
  static constexpr std::size_t block = 64;

  std::vector<int> second_;
  std::vector<Section> sections_;
  std::vector<int> section_of_block_;  // section of the first pair of each block
};

inline int PairList::first(std::size_t index) const {
  const std::size_t at = index / block;
  auto low = static_cast<std::size_t>(section_of_block_[at]);
  std::size_t high = at + 1 < section_of_block_.size() ? static_cast<std::size_t>(section_of_block_[at + 1])
                                                       : sections_.size() - 1;
  while (low < high) {  // search the last section that begins at or before `index`
    const std::size_t middle = (low + high + 1) / 2;
    if (static_cast<std::size_t>(sections_[middle].begin) <= index)
      low = middle;
    else
      high = middle - 1;
  }
  return sections_[low].vertex;
}

}  // namespace bendlab
