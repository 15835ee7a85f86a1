#include "bendlab/mesh/rings.hpp"

namespace bendlab {

RingWalker::RingWalker(const Adjacency& one_ring)
    : one_ring_(one_ring), mark_(one_ring.offsets.size() - 1, 0) {}

void RingWalker::walk(int centre, int rings) {
  ++walk_number_;
  queue_.assign(1, centre);
  starts_.assign({0, 1});
  mark_[static_cast<std::size_t>(centre)] = walk_number_;
  for (int r = 1; r <= rings; ++r) {
    const std::size_t first = starts_[starts_.size() - 2], last = queue_.size();
    for (std::size_t at = first; at < last; ++at)
      for (const int neighbour : one_ring_[queue_[at]]) {
        int& mark = mark_[static_cast<std::size_t>(neighbour)];
        if (mark == walk_number_) continue;
        mark = walk_number_;
        queue_.push_back(neighbour);
      }
    starts_.push_back(queue_.size());
    if (queue_.size() == last) break;
  }
}

std::span<const int> RingWalker::ring(int r) const {
  const auto at = static_cast<std::size_t>(r);
  if (at + 1 >= starts_.size()) return {};
  return std::span(queue_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
}

}  // namespace bendlab
