// Finds the pinned vertices: seeds, which the scene lists by name or index, and vertices near the seeds.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct Pins {
  std::vector<int> seeds;       ///< the vertices that the scene lists, ascending
  std::vector<int> all;         ///< all pinned vertices, ascending
  std::vector<char> is_pinned;  ///< #V
  /// #V, or empty: the axes along which a free vertex is held, a bit each (1: x, 2: y, 4: z).
  std::vector<char> held = {};
  /// #V, or empty: the axes of `held` that are normal to a plane of symmetry, where the sheet also keeps its
  /// slope.
  std::vector<char> symmetric = {};

  bool pinned(int vertex) const { return is_pinned[static_cast<std::size_t>(vertex)] != 0; }
};

/// Pins the `seeds` and `rings` rings of neighbours around each seed (the paper pins one ring). Also pins the
/// vertices within `distance` (m, in a straight line at rest) of a seed or of an edge between two seeds.
/// Throws std::out_of_range for a seed that is not a vertex.
Pins make_pins(const RestMesh& rest, std::vector<int> seeds, int rings, double distance = 0);

enum class CoordinateAxis { x, y, z };
inline constexpr std::array<std::string_view, 3> coordinate_axis_names = {"x", "y", "z"};

/// Which coordinate axes (0 to 2) mean right, up and towards the viewer in names such as `upper_right`.
struct NamedAxes {
  int right = 0, up = 1, front = 2;
};

/// Usually right, up and front are x, y and z. But if the extent along x or y is less than a tenth of the
/// other extents (an upright sheet), that axis is front, z is up, and the remaining axis is right.
NamedAxes named_axes(const RestMesh& rest);

/// Names of vertices of a rest mesh that a scene can pin, in the shape RestMesh::named_positions().
enum class Place {
  upper_right,  ///< the vertex nearest to a corner of the mesh's box
  upper_left,
  lower_right,
  lower_left,
  top,  ///< all vertices within 10⁻⁶ mesh sizes of a side of the box
  bottom,
  left,
  right,
  centre,      ///< the vertex nearest to the centre
  top_rim,     ///< all vertices at the largest z, an end of a tube
  bottom_rim,  ///< all vertices at the smallest z
  circle,      ///< the outermost vertices of a disc around the centre; radius: 1/4 of the smaller extent
  interior,    ///< the vertices nearest to 0.3 and 0.7 of the box's width and height
};
inline constexpr std::array<std::string_view, 13> place_names = {
    "upper_right", "upper_left", "lower_right", "lower_left", "top",    "bottom",  "left",
    "right",       "centre",     "top_rim",     "bottom_rim", "circle", "interior"};

/// The vertices with that name, in a view from the front (see named_axes()). If several vertices are equally
/// near (within 10⁻⁶ mesh sizes), ties go to the frontmost, then to the lowest, then to the leftmost vertex.
/// Throws std::invalid_argument for a rim of a flat mesh, where every vertex would be on the rim.
std::vector<int> select_vertices(const RestMesh& rest, Place place);

}  // namespace bendlab
