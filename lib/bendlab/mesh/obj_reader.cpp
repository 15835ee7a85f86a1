#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {
namespace {

// tinyobjloader reads faces and their indices. Coordinates are read here, because tinyobjloader rounds them
// to float and reads 0 if a word is not a number.
void read_coordinates(std::string_view bytes, PolygonSoup& soup,
                      std::vector<std::array<double, 2>>& texture) {
  TextLines lines(bytes, '#');
  while (lines.next()) {
    if (lines.word(0) == "v") soup.points.push_back({lines.real(1), lines.real(2), lines.real(3)});
    if (lines.word(0) != "vt") continue;
    texture.push_back({lines.real(1), lines.word_count() > 2 ? lines.real(2) : 0.0});
    if (!std::isfinite(texture.back()[0]) || !std::isfinite(texture.back()[1]))
      lines.fail("a texture coordinate is not finite");
  }
}

void add_face(std::span<const tinyobj::index_t> corners, std::span<const std::array<double, 2>> texture,
              PolygonSoup& soup) {
  std::vector<std::int64_t> vertices;
  for (const auto& corner : corners) vertices.push_back(corner.vertex_index);
  add_polygon(soup, vertices);
  const auto add_texture = [&](const tinyobj::index_t& corner) {  // -1: the corner has none
    if (corner.texcoord_index >= static_cast<int>(texture.size()))
      throw std::invalid_argument(fmt::format("texture coordinate {} is named, but there are {}",
                                              corner.texcoord_index + 1, texture.size()));
    if (corner.texcoord_index >= 0)
      soup.texture_coordinates.push_back(texture[static_cast<std::size_t>(corner.texcoord_index)]);
  };
  for (std::size_t c = 2; c < corners.size(); ++c)
    for (const std::size_t at : {std::size_t{0}, c - 1, c}) add_texture(corners[at]);
}

}  // namespace

PolygonSoup parse_obj(const std::string& bytes) {
  PolygonSoup soup;
  std::vector<std::array<double, 2>> texture;
  read_coordinates(bytes, soup, texture);

  tinyobj::ObjReaderConfig config;
  config.triangulate = false;  // it would leave out polygons with an index out of range
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(bytes, "", config)) throw std::invalid_argument(reader.Error());
  if (reader.Warning().find("Degenerated face") != std::string::npos)
    throw std::invalid_argument("a face has fewer than 3 corners");

  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    const auto& counts = shape.mesh.num_face_vertices;
    const std::span<const tinyobj::index_t> corners(shape.mesh.indices);
    if (std::accumulate(counts.begin(), counts.end(), std::size_t{0}) != corners.size())
      throw std::invalid_argument(
          "a face has more than 255 corners");  // its count is a byte in older versions
    std::size_t first = 0;
    for (const std::size_t count : counts) {
      add_face(corners.subspan(first, count), texture, soup);
      first += count;
    }
  }
  if (soup.texture_coordinates.size() != 3 * soup.triangles.size()) soup.texture_coordinates.clear();
  return soup;
}

}  // namespace bendlab
