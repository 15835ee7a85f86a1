// Which of many boxes overlap: a binary tree of boxes, built once, its boxes renewed as the elements move.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// An axis-parallel box; empty as it is made. The fourth number is for the processor's lanes.
struct Box {
  using Corner = Eigen::Array4f;
  Corner low = Corner::Constant(std::numeric_limits<float>::infinity()), high = -low;

  void include(const Box& other) { low = low.min(other.low), high = high.max(other.high); }
  bool empty() const { return !(low(0) <= high(0)); }
  bool overlaps(const Box& other) const { return (low - other.high).max(other.low - high).maxCoeff() <= 0; }
};

/// Elements whose centres are near stand in the same branch; that they were near once is enough, as elements
/// of a cloth move with their neighbours. Building costs n log n, renewing n. Elements are halved by the
/// median, so the tree depends on nothing but the centres.
class BoxTree {
 public:
  explicit BoxTree(const Positions& centres);  ///< #n by 3

  void renew(std::span<const Box> boxes);  ///< #n

  /// Calls action(i, j) once for each two elements whose boxes overlap, in an order that depends on the
  /// centres alone.
  template <class Action>
  void for_overlaps(const Action& action) const {
    if (leaves_ > 0) inside(1, action);
  }

 private:
  template <class Action>
  void inside(std::size_t node, const Action& action) const {
    if (node >= leaves_ || boxes_[node].empty()) return;
    inside(2 * node, action), inside(2 * node + 1, action);
    between(2 * node, 2 * node + 1, action);
  }

  // Both at the same depth.
  template <class Action>
  void between(std::size_t a, std::size_t b, const Action& action) const {
    if (!boxes_[a].overlaps(boxes_[b])) return;
    if (a >= leaves_) {
      action(element_[a - leaves_], element_[b - leaves_]);
      return;
    }
    for (const std::size_t left : {2 * a, 2 * a + 1})
      for (const std::size_t right : {2 * b, 2 * b + 1}) between(left, right, action);
  }

  std::size_t leaves_ = 0;    // a power of two, or 0
  std::vector<int> element_;  // #n, of each leaf; the last leaves are empty
  std::vector<Box> boxes_;    // node i has the children 2i and 2i + 1; the root is 1, leaves from leaves_ on
};

}  // namespace bendlab
