// Rings of neighbours: ring r of a vertex consists of the vertices that are exactly r edges away.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Finds the rings around one vertex after another, without clearing an array of #V entries each time. Not
/// thread-safe: use one object per thread.
class RingWalker {
 public:
  explicit RingWalker(const Adjacency& one_ring);

  /// Finds the rings 1 … `rings` around `centre`. Afterwards ring(r) gives the vertices exactly r edges away,
  /// in breadth-first order; ring(0) is the centre. On a small mesh, the last rings are empty.
  void walk(int centre, int rings) {
    walk(centre, rings, [](int) { return true; });
  }
  /// The same in the part of the mesh whose vertices v fulfil may_enter(v).
  template <class MayEnter>
  void walk(int centre, int rings, const MayEnter& may_enter);
  int rings() const { return static_cast<int>(starts_.size()) - 2; }
  std::span<const int> ring(int r) const;

 private:
  const Adjacency& one_ring_;
  std::vector<int> mark_;            // number of the last walk that visited the vertex
  std::vector<int> queue_;           // vertices in breadth-first order
  std::vector<std::size_t> starts_;  // starts_[r] .. starts_[r + 1]: ring r in queue_
  int walk_number_ = 0;
};

template <class MayEnter>
void RingWalker::walk(int centre, int rings, const MayEnter& may_enter) {
  ++walk_number_;
  queue_.assign(1, centre);
  starts_.assign({0, 1});
  mark_[static_cast<std::size_t>(centre)] = walk_number_;
  for (int r = 1; r <= rings; ++r) {
    const std::size_t first = starts_[starts_.size() - 2], last = queue_.size();
    for (std::size_t at = first; at < last; ++at)
      for (const int neighbour : one_ring_[queue_[at]]) {
        int& mark = mark_[static_cast<std::size_t>(neighbour)];
        if (mark == walk_number_ || !may_enter(neighbour)) continue;
        mark = walk_number_;
        queue_.push_back(neighbour);
      }
    starts_.push_back(queue_.size());
    if (queue_.size() == last) break;
  }
}

}  // namespace bendlab
