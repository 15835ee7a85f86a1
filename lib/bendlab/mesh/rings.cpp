#include "bendlab/mesh/rings.hpp"

namespace bendlab {

RingWalker::RingWalker(const Adjacency& one_ring)
    : one_ring_(one_ring), mark_(one_ring.offsets.size() - 1, 0) {}

std::span<const int> RingWalker::ring(int r) const {
  const auto at = static_cast<std::size_t>(r);
  if (at + 1 >= starts_.size()) return {};
  return std::span(queue_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
}

}  // namespace bendlab
