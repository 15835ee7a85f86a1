#include "bendlab/effects/named_vertices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/settings/names.hpp"

namespace bendlab {

std::vector<int> loaded_vertices(const RestMesh& rest, const Pins& pins, const std::vector<Place>& places,
                                 const std::vector<int>& indices) {
  std::vector<int> vertices;
  for (const Place place : places)
    for (const int v : select_vertices(rest, place)) vertices.push_back(v);
  for (const int v : indices) {
    if (v >= rest.vertex_count())
      throw std::invalid_argument(fmt::format("indices: {} is not a vertex; the mesh has vertices 0 to {}", v,
                                              rest.vertex_count() - 1));
    vertices.push_back(v);
  }
  if (places.empty() && indices.empty())
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (!pins.pinned(v)) vertices.push_back(v);
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto pinned = std::ranges::count_if(vertices, [&](int v) { return pins.pinned(v); });
  if (pinned == static_cast<std::ptrdiff_t>(vertices.size()))
    throw std::invalid_argument(
        vertices.empty() ? "the load acts on no vertex, because all vertices are pinned: remove the load"
                         : fmt::format("the load acts only on pinned vertices ({} of them), where it does "
                                       "nothing: name other vertices, or remove them from /pins",
                                       pinned));
  return vertices;
}

}  // namespace bendlab
