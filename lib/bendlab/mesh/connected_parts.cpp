#include "bendlab/mesh/connected_parts.hpp"

#include <utility>

namespace bendlab {

std::vector<std::vector<int>> connected_parts(const Adjacency& one_ring) {
  std::vector<std::vector<int>> parts;
  std::vector<char> seen(one_ring.offsets.size() - 1, 0);
  for (std::size_t lowest = 0; lowest < seen.size(); ++lowest) {
    if (std::exchange(seen[lowest], 1) != 0) continue;
    std::vector<int>& part = parts.emplace_back(1, static_cast<int>(lowest));
    for (std::size_t next = 0; next < part.size(); ++next)
      for (const int neighbour : one_ring[part[next]])
        if (std::exchange(seen[static_cast<std::size_t>(neighbour)], 1) == 0) part.push_back(neighbour);
  }
  return parts;
}

}  // namespace bendlab
