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
