// The mesh file formats, from a file's bytes to a soup. All throw std::invalid_argument, with the line where
// there are lines, if the bytes do not follow the format; indices and coordinates are not checked.
//
// OFF, PLY and STL are read here and not by CGAL: its readers answer bad indices and coordinates with a bare
// "false", and, compiled without assertions, crash on a PLY file with whole-number coordinates.
#pragma once

#include <string>
#include <string_view>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

PolygonSoup parse_obj(const std::string& bytes);
PolygonSoup parse_off(std::string_view bytes);
PolygonSoup parse_ply(std::string_view bytes);
PolygonSoup parse_stl(std::string_view bytes);

}  // namespace bendlab
