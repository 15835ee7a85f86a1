#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <stdexcept>

#include "bendlab/mesh/polygon_list.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is copied as it is");

// Gives exactly equal points the same vertex.
class PointMerger {
 public:
  explicit PointMerger(PolygonSoup& soup) : soup_(soup) {}

  std::int64_t add(std::array<double, 3> point) {
    std::array<std::uint64_t, 3> bits;
    for (std::size_t i = 0; i < 3; ++i) bits[i] = std::bit_cast<std::uint64_t>(point[i] + 0.0);  // -0 is 0
    const auto [entry, is_new] = index_.try_emplace(bits, static_cast<std::int64_t>(soup_.points.size()));
    if (is_new) soup_.points.push_back(point);
    return entry->second;
  }

 private:
  PolygonSoup& soup_;
  std::map<std::array<std::uint64_t, 3>, std::int64_t> index_;
};

constexpr std::size_t header_size = 84;    // 80 arbitrary bytes, then the number of triangles
constexpr std::size_t triangle_size = 50;  // normal and three points as 12 floats, then two arbitrary bytes

PolygonSoup parse_binary(std::string_view bytes) {
  std::uint32_t triangles = 0;
  if (bytes.size() >= header_size) std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
  const std::size_t size = header_size + triangle_size * triangles;
  if (bytes.size() < size)
    throw std::invalid_argument(
        fmt::format("the file is neither a text (it does not start with 'solid', or has bytes of value 0) "
                    "nor a binary STL file ({} triangles would need {} bytes, but the file has {} bytes)",
                    triangles, size, bytes.size()));
  // If the bytes after the last triangle are whole triangles, the number in the header is wrong.
  if (const std::size_t more = bytes.size() - size; more > 0 && more % triangle_size == 0)
    throw std::invalid_argument(
        fmt::format("the header of the binary file says {} triangles, but the file has room for {}: export "
                    "the mesh again with another program",
                    triangles, triangles + more / triangle_size));
  PolygonSoup soup;
  PointMerger points(soup);
  for (std::size_t at = header_size; at < size; at += triangle_size) {
    std::array<float, 12> values;
    std::memcpy(values.data(), bytes.data() + at, sizeof values);
    std::array<std::int64_t, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = points.add({static_cast<double>(values[3 * c + 3]), static_cast<double>(values[3 * c + 4]),
                               static_cast<double>(values[3 * c + 5])});
    soup.triangles.push_back(corners);
  }
  return soup;
}

// Whether `text` is the word `lower`, in small or capital letters. Old programs write capitals.
bool equal_but_for_case(std::string_view text, std::string_view lower) {
  return std::ranges::equal(text, lower, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

// Reads all solids of the file into one mesh.
PolygonSoup parse_text(std::string_view bytes) {
  PolygonSoup soup;
  PointMerger points(soup);
  PolygonList polygons(soup, "line");
  std::vector<std::int64_t> corners;
  TextLines lines(bytes);
  bool in_solid = false, in_facet = false;
  while (lines.next()) {
    const auto is = [&](std::string_view keyword) { return equal_but_for_case(lines.word(0), keyword); };
    if (is("solid") || is("endsolid") || is("facet")) {
      if (in_facet) lines.fail("the facet before this line has no 'endfacet'");
      in_solid = !is("endsolid"), in_facet = is("facet");
    } else if (is("vertex")) {
      corners.push_back(points.add({lines.real(1), lines.real(2), lines.real(3)}));
    } else if (is("endfacet")) {
      polygons.add(corners, lines.line());
      corners.clear();
      in_facet = false;
    }
  }
  if (in_solid || in_facet) lines.fail("the file ends before 'endsolid'");
  polygons.cut();
  return soup;
}

// A file that starts with "solid" can still be binary. A binary file has a byte of value 0 near the start: in
// the number of triangles if that is less than 2²⁴, or in the first triangles.
bool is_text(std::string_view bytes) {
  constexpr std::size_t beginning = 1024;
  if (bytes.substr(0, beginning).find('\0') != bytes.npos) return false;
  TextLines lines(bytes);
  return lines.next() && equal_but_for_case(lines.word(0), "solid");
}

}  // namespace

PolygonSoup parse_stl(std::string_view bytes) {
  return is_text(bytes) ? parse_text(bytes) : parse_binary(bytes);
}

}  // namespace bendlab
