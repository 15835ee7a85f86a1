#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <map>
#include <stdexcept>

#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is copied as it is");

// Finds points by their bits: exactly equal points are one vertex.
class PointMerger {
 public:
  explicit PointMerger(PolygonSoup& soup) : soup_(soup) {}

  std::int64_t add(std::array<double, 3> point) {
    std::array<std::uint64_t, 3> bits;
    for (std::size_t i = 0; i < 3; ++i) bits[i] = std::bit_cast<std::uint64_t>(point[i] + 0.0);  // -0 is 0
    const auto [known, is_new] = index_.try_emplace(bits, static_cast<std::int64_t>(soup_.points.size()));
    if (is_new) soup_.points.push_back(point);
    return known->second;
  }

 private:
  PolygonSoup& soup_;
  std::map<std::array<std::uint64_t, 3>, std::int64_t> index_;
};

constexpr std::size_t header_size = 84;    // 80 bytes of anything, then the number of triangles
constexpr std::size_t triangle_size = 50;  // normal and three points as 12 floats, then two bytes of anything

std::size_t binary_triangles(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_size) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

PolygonSoup parse_binary(std::string_view bytes) {
  PolygonSoup soup;
  PointMerger points(soup);
  for (std::size_t at = header_size; at < bytes.size(); at += triangle_size) {
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

PolygonSoup parse_text(std::string_view bytes) {
  PolygonSoup soup;
  PointMerger points(soup);
  std::vector<std::int64_t> corners;
  TextLines lines(bytes);
  do {
    lines.need_next("'endsolid'");
    if (lines.word(0) == "vertex")
      corners.push_back(points.add({lines.real(1), lines.real(2), lines.real(3)}));
    if (lines.word(0) != "endfacet") continue;
    add_polygon(soup, corners);
    corners.clear();
  } while (lines.word(0) != "endsolid");
  return soup;
}

}  // namespace

PolygonSoup parse_stl(std::string_view bytes) {
  // Checks the size first: the header of a binary file may start with "solid", too.
  const std::size_t triangles = binary_triangles(bytes);
  if (bytes.size() == header_size + triangle_size * triangles) return parse_binary(bytes);
  if (bytes.starts_with("solid")) return parse_text(bytes);
  throw std::invalid_argument(fmt::format(
      "neither text (it does not start with 'solid') nor binary ({} triangles would take {} bytes, it has "
      "{})",
      triangles, header_size + triangle_size * triangles, bytes.size()));
}

}  // namespace bendlab
