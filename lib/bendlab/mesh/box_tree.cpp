#include "bendlab/mesh/box_tree.hpp"

#include <bit>
#include <numeric>

namespace bendlab {
namespace {

// Halves the elements recursively, along the longest side of the bounding box of their centres. All leaves of
// the left branch get an element before the right branch gets any.
void halve(std::span<int> elements, std::size_t leaves, const Positions& centres) {
  const std::size_t half = leaves / 2;
  if (half == 0) return;
  if (elements.size() > half) {
    Eigen::RowVector3d low = centres.row(elements[0]), high = low;
    for (const int e : elements) {
      low = low.cwiseMin(centres.row(e));
      high = high.cwiseMax(centres.row(e));
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::nth_element(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(half), elements.end(),
                     [&](int a, int b) {
                       const double l = centres(a, axis), r = centres(b, axis);
                       return l < r || (l == r && a < b);
                     });
    halve(elements.subspan(half), half, centres);
  }
  halve(elements.first(std::min(half, elements.size())), half, centres);
}

}  // namespace

BoxTree::BoxTree(const Positions& centres) : element_(static_cast<std::size_t>(centres.rows())) {
  if (element_.empty()) return;
  leaves_ = std::bit_ceil(element_.size());
  std::iota(element_.begin(), element_.end(), 0);
  halve(element_, leaves_, centres);
  boxes_.resize(2 * leaves_);
}

void BoxTree::renew(std::span<const Box> boxes) {
  for (std::size_t leaf = 0; leaf < element_.size(); ++leaf)
    boxes_[leaves_ + leaf] = boxes[static_cast<std::size_t>(element_[leaf])];
  for (std::size_t node = leaves_; node-- > 1;) {
    boxes_[node] = boxes_[2 * node];
    boxes_[node].include(boxes_[2 * node + 1]);
  }
}

}  // namespace bendlab
