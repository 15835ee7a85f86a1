// k-rings: ring r of a vertex holds the vertices exactly r edges away (breadth-first over mesh edges).
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Walks rings outward from one vertex at a time. Its #V marks need no clearing between walks. Not
/// thread-safe: use one object per thread.
class RingWalker {
 public:
  explicit RingWalker(const Adjacency& one_ring);

  /// Visits `centre` and its rings 1 … `rings`. Afterwards ring(r) holds the vertices exactly r edges away,
  /// in breadth-first order; ring(0) is the centre. Rings that do not exist are empty.
  void walk(int centre, int rings);
  std::span<const int> ring(int r) const;

 private:
  const Adjacency& one_ring_;
  std::vector<int> mark_;            // number of the last walk that visited the vertex
  std::vector<int> queue_;           // vertices in breadth-first order
  std::vector<std::size_t> starts_;  // starts_[r] .. starts_[r + 1]: ring r in queue_
  int walk_number_ = 0;
};

}  // namespace bendlab
