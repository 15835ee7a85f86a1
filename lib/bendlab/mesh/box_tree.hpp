// A binary tree of boxes, which finds overlapping boxes, and the box nearest to a point. The tree is built
// once; as the elements move, only the boxes change.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// An axis-parallel box, at first empty. The fourth component is padding for SIMD.
struct Box {
  using Corner = Eigen::Array4f;
  Corner low = Corner::Constant(std::numeric_limits<float>::infinity()), high = -low;

  /// A box that surely contains the point: its corners are rounded outward.
  static Box around(const Vector3& point) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Box box;
    box.low(3) = box.high(3) = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(point(axis));
      box.low(axis) = std::nextafter(x, -infinity), box.high(axis) = std::nextafter(x, infinity);
    }
    return box;
  }

  void include(const Box& other) { low = low.min(other.low), high = high.max(other.high); }
  bool empty() const { return !(low(0) <= high(0)); }
  bool overlaps(const Box& other) const { return (low - other.high).max(other.low - high).maxCoeff() <= 0; }
  /// The squared distance to the nearest point of the box; infinite if the box is empty.
  double squared_distance(const Vector3& point) const {
    const Eigen::Array3d p = point.array();
    return (low.head<3>().cast<double>() - p).max(p - high.head<3>().cast<double>()).max(0).square().sum();
  }
};

/// Elements whose centres are near each other are in the same branch. The branches are not changed later,
/// because elements of a cloth move with their neighbours. For n elements, building takes O(n log n) time and
/// renew() O(n). Elements are split at the median, so the tree depends only on the centres.
class BoxTree {
 public:
  explicit BoxTree(const Positions& centres);  ///< #n by 3

  void renew(std::span<const Box> boxes);  ///< #n, the box of each element

  /// Calls action(i, j) once for each pair of elements with overlapping boxes. The order depends only on the
  /// centres.
  template <class Action>
  void for_overlaps(const Action& action) const {
    if (leaves_ > 0) inside(1, action);
  }

  /// The least squared_distance(i) over all elements i; infinite without elements. Evaluates
  /// squared_distance(i) only if the box of element i is nearer to `point` than the least distance so far.
  template <class SquaredDistance>
  double least_squared_distance(const Vector3& point, const SquaredDistance& squared_distance) const {
    double least = std::numeric_limits<double>::infinity();
    if (leaves_ > 0) look_into(1, point, squared_distance, least);
    return least;
  }

 private:
  // Visits the nearer branch first. The distance found there usually rules out the farther branch.
  template <class SquaredDistance>
  void look_into(std::size_t node, const Vector3& point, const SquaredDistance& squared_distance,
                 double& least) const {
    if (node >= leaves_) {
      least = std::min(least, squared_distance(element_[node - leaves_]));
      return;
    }
    std::array<std::size_t, 2> child = {2 * node, 2 * node + 1};
    std::array<double, 2> away = {boxes_[child[0]].squared_distance(point),
                                  boxes_[child[1]].squared_distance(point)};
    if (away[1] < away[0]) std::swap(child[0], child[1]), std::swap(away[0], away[1]);
    for (std::size_t i = 0; i < 2; ++i)
      if (away[i] < least) look_into(child[i], point, squared_distance, least);
  }

  template <class Action>
  void inside(std::size_t node, const Action& action) const {
    if (node >= leaves_ || boxes_[node].empty()) return;
    inside(2 * node, action), inside(2 * node + 1, action);
    between(2 * node, 2 * node + 1, action);
  }

  // Nodes a and b have the same depth.
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
  std::vector<int> element_;  // #n, the element of each leaf; the last leaves are empty
  std::vector<Box> boxes_;    // node i has the children 2i and 2i + 1; the root is 1, leaves from leaves_ on
};

}  // namespace bendlab
