// Which vertices are pinned: the vertices that the scene names, and the rings around them.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct Pins {
  std::vector<int> seeds;       ///< the vertices that the scene names, ascending
  std::vector<int> all;         ///< seeds and the rings pinned with them, ascending
  std::vector<char> is_pinned;  ///< #V

  bool pinned(int vertex) const { return is_pinned[static_cast<std::size_t>(vertex)] != 0; }
};

/// Pins `seeds`, their first `rings` rings (0: the seeds alone; the paper pins 1) and the vertices within
/// `distance` (m, straight through the rest shape) of a seed or of an edge between two seeds. Throws
/// std::out_of_range for a seed that is not a vertex.
Pins make_pins(const RestMesh& rest, std::vector<int> seeds, int rings, double distance = 0);

/// Which coordinate axes (0 to 2) point right, up and towards the viewer in the names of places.
struct NamedAxes {
  int right = 0, up = 1, front = 2;
};

/// Right, up and front are x, y and z, unless the sheet stands: then it is thinner along x or y than a tenth
/// of its other two extents. The thin axis is the front of a standing sheet, z is up, and the remaining axis
/// is right.
NamedAxes named_axes(const RestMesh& rest);

/// Named places of a rest mesh.
enum class Place {
  upper_right,  ///< a corner: the vertex nearest to it
  upper_left,
  lower_right,
  lower_left,
  top,  ///< a side: all vertices within 10⁻⁶ mesh sizes of it
  bottom,
  left,
  right,
  centre,      ///< the vertex nearest to the centre
  top_rim,     ///< all vertices at the largest z, an end of a tube
  bottom_rim,  ///< all vertices at the smallest z
  circle,      ///< the outermost vertices within a quarter of the box's smaller x-y extent of the centre
  interior,    ///< four vertices, nearest to 0.3 and 0.7 of the box's width and height
};
inline constexpr std::array<std::string_view, 13> place_names = {
    "upper_right", "upper_left", "lower_right", "lower_left", "top",    "bottom",  "left",
    "right",       "centre",     "top_rim",     "bottom_rim", "circle", "interior"};

/// The vertices at a place. Places are seen from the front, see named_axes(). If several vertices are equally
/// near (within 10⁻⁶ mesh sizes), the frontmost is taken, then the lowest, then the leftmost, so the order of
/// vertices in the mesh does not matter. Throws std::invalid_argument for a rim of a flat mesh, because every
/// vertex would be on it.
std::vector<int> select_vertices(const RestMesh& rest, Place place);

}  // namespace bendlab
