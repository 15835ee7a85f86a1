// The mesh file formats, from a file's bytes to a soup. All throw std::invalid_argument if the bytes do not
// follow the format; for text files it names the line. Indices and coordinates are not checked. Polygons are
// cut into triangles, by cut_polygon.hpp.
//
// CGAL (5.5) could read these formats, too, but is not used. Its readers return a bare "false" for bad
// numbers and indices; read "1.5" as the index 1; allocate as much as a header or a list announces, even if
// the data are missing; crash on a PLY file whose coordinates are whole numbers; and refuse STL in capitals,
// with quads, or of a solid named "facet".
#pragma once

#include <string_view>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

PolygonSoup parse_obj(std::string_view bytes);
PolygonSoup parse_off(std::string_view bytes);
PolygonSoup parse_ply(std::string_view bytes);
PolygonSoup parse_stl(std::string_view bytes);

}  // namespace bendlab
