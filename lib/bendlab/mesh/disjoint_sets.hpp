// Disjoint sets of numbers (union-find).
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace bendlab {

/// At first each number 0 … count - 1 is a set of its own. The representative of a set is its lowest element.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace bendlab
