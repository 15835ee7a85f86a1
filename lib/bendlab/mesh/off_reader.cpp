#include <fmt/format.h>

#include "bendlab/mesh/polygon_list.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {

// An OFF file has the keyword [ST][C][N]OFF, the numbers of vertices, faces (and edges), a line "x y z …" for
// each vertex, and a line "n i1 … in …" for each face with n corners.
PolygonSoup parse_off(std::string_view bytes) {
  TextLines lines(bytes, '#');
  lines.need_next("its keyword OFF");
  const std::string_view keyword = lines.word(0);
  if (!keyword.ends_with("OFF") || keyword.find_first_of("4n") != keyword.npos)
    lines.fail(
        fmt::format("starts with {}, but a mesh in three dimensions starts with OFF", lines.quoted(0)));
  if (lines.word_count() > 1 && lines.word(1) == "BINARY")
    lines.fail("binary OFF files are not supported; save the mesh as text");

  std::size_t first = 1;  // the counts may be on the line of the keyword
  if (lines.word_count() == 1) {
    lines.need_next("the counts of vertices and faces");
    first = 0;
  }
  const std::size_t vertices = lines.count(first), faces = lines.count(first + 1);

  PolygonSoup soup;
  PolygonList polygons(soup, "line");
  for (std::size_t v = 0; v < vertices; ++v) {
    lines.need_next(fmt::format("vertex {} of {}", v, vertices));
    soup.points.push_back({lines.real(0), lines.real(1), lines.real(2)});
  }
  std::vector<std::int64_t> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    lines.need_next(fmt::format("face {} of {}", f, faces));
    const std::size_t count = lines.count(0);
    if (count >= lines.word_count()) lines.fail(fmt::format("a face of {} corners has fewer indices", count));
    corners.clear();
    for (std::size_t c = 1; c <= count; ++c) corners.push_back(lines.integer(c));
    polygons.add(corners, lines.line());
  }
  polygons.cut();
  return soup;
}

}  // namespace bendlab
