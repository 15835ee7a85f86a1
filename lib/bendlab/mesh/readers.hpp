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
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

PolygonSoup parse_obj(std::string_view bytes);
PolygonSoup parse_off(std::string_view bytes);
PolygonSoup parse_ply(std::string_view bytes);
PolygonSoup parse_stl(std::string_view bytes);

/// A property of a PLY file besides its points and faces: a value per point, or a value per triangle (a face
/// with more than three corners gives its value to all of its triangles). The other list is empty.
struct PlyValues {
  PolygonSoup soup;
  std::vector<double> of_points, of_triangles;
};

/// Throws std::invalid_argument also if the file has no such property; the text then lists its properties.
PlyValues parse_ply_values(std::string_view bytes, std::string_view property);

}  // namespace bendlab
