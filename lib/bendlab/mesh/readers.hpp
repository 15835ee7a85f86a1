// Readers of mesh file formats: from the bytes of a file to a soup. If the bytes do not follow the format, a
// reader throws std::invalid_argument, for text files with the line number. Indices and coordinates are not
// checked. Polygons are cut into triangles (cut_polygon.hpp).
//
// The readers of CGAL (5.5) are not used, because they
// * return "false" without a reason for bad numbers and indices,
// * read "1.5" as the index 1,
// * allocate as much memory as a header announces, even if the data are missing,
// * crash on a PLY file whose coordinates are integers,
// * refuse STL files in capital letters, with quads, or with a solid named "facet".
#pragma once

#include <string_view>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

PolygonSoup parse_obj(std::string_view bytes);
PolygonSoup parse_off(std::string_view bytes);
PolygonSoup parse_ply(std::string_view bytes);
PolygonSoup parse_stl(std::string_view bytes);

}  // namespace bendlab
