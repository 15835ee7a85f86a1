#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bendlab/mesh/polygon_list.hpp"
#include "bendlab/mesh/readers.hpp"
#include "bendlab/mesh/text_lines.hpp"

namespace bendlab {
namespace {

constexpr std::int64_t no_index = -1;

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : lines_(bytes, '#', '\\') {}

  // Reads the lines v, vt and f. Skips all other lines: normals, names, materials, lines, points, curves.
  PolygonSoup run() {
    while (lines_.next()) {
      const std::string_view key = lines_.word(0);
      if (key == "v") read_point();
      if (key == "vt") read_texture();
      if (key == "f" || key == "fo") read_face();  // fo: the keyword in old files
    }
    polygons_.cut(corner_textures_);
    look_up_textures();
    return std::move(soup_);
  }

 private:
  // x y z. A weight and a colour may follow; these numbers are checked, but not used.
  void read_point() {
    soup_.points.push_back({lines_.real(1), lines_.real(2), lines_.real(3)});
    for (std::size_t i = 4; i < lines_.word_count(); ++i) lines_.real(i);
  }

  // u v w; v and w are optional.
  void read_texture() {
    textures_.push_back({lines_.real(1), lines_.word_count() > 2 ? lines_.real(2) : 0.0});
    if (!std::isfinite(textures_.back()[0]) || !std::isfinite(textures_.back()[1]))
      lines_.fail("a texture coordinate is not finite");
  }

  // Corners v, v/vt, v//vn or v/vt/vn. A number after a slash is optional.
  void read_face() {
    vertices_.clear(), face_textures_.clear();
    for (std::size_t i = 1; i < lines_.word_count(); ++i) {
      const std::string_view word = lines_.word(i);
      const std::size_t slash = std::min(word.find('/'), word.size());
      vertices_.push_back(index(word.substr(0, slash), soup_.points.size()));
      if (vertices_.back() == no_index)
        lines_.fail(fmt::format("{} refers to vertex {}, but only {} vertices are defined before",
                                TextLines::quoted(word), TextLines::quoted(word.substr(0, slash)),
                                soup_.points.size()));
      face_textures_.push_back(texture_of(word.substr(std::min(slash + 1, word.size()))));
    }
    polygons_.add(vertices_, lines_.line());
    for (std::size_t c = 2; c < face_textures_.size(); ++c)
      corner_textures_.push_back({face_textures_[0], face_textures_[c - 1], face_textures_[c]});
  }

  // The index of the texture coordinates, or no_index. `rest` is the text after the first slash: "vt", "vt/",
  // "vt/vn", "/vn" or nothing.
  std::int64_t texture_of(std::string_view rest) {
    if (rest.empty()) return no_index;
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view normal = rest.substr(std::min(slash + 1, rest.size()));
    if (!normal.empty()) lines_.integer_of(normal);
    if (slash == 0) return no_index;
    const std::int64_t texture = index(rest.substr(0, slash), textures_.size());
    if (texture == no_index)
      lines_.fail(fmt::format("texture coordinate {} is used, but only {} are defined before",
                              TextLines::quoted(rest.substr(0, slash)), textures_.size()));
    return texture;
  }

  // The index, counted from 0. A negative number counts back from the last of the `before` entries so far. If
  // there are not so many entries, the result is no_index.
  std::int64_t index(std::string_view text, std::size_t before) const {
    const std::int64_t number = lines_.integer_of(text);
    if (number == 0) lines_.fail("index 0 is not allowed: indices start at 1");
    if (number > 0) return number - 1;
    return std::max(no_index, static_cast<std::int64_t>(before) + number);
  }

  void look_up_textures() {
    std::size_t untextured = 0;
    for (const auto& corners : corner_textures_)
      if (std::ranges::find(corners, no_index) != corners.end()) ++untextured;
    if (untextured > 0) {
      if (untextured < corner_textures_.size()) soup_.untextured_triangles = untextured;
      return;
    }
    soup_.texture_coordinates.reserve(3 * corner_textures_.size());
    for (std::size_t t = 0; t < corner_textures_.size(); ++t)
      for (const std::int64_t corner : corner_textures_[t]) {
        if (corner >= static_cast<std::int64_t>(textures_.size()))
          throw std::invalid_argument(
              fmt::format("triangle {} uses texture coordinate {}, but the file has {} (texture coordinates "
                          "are numbered from 1, triangles from 0)",
                          t, corner + 1, textures_.size()));
        soup_.texture_coordinates.push_back(textures_[static_cast<std::size_t>(corner)]);
      }
  }

  TextLines lines_;
  PolygonSoup soup_;
  PolygonList polygons_{soup_, "line"};
  std::vector<std::array<double, 2>> textures_;
  std::vector<std::array<std::int64_t, 3>> corner_textures_;  // #T: indices into textures_, or no_index
  std::vector<std::int64_t> vertices_, face_textures_;        // of the current face, by corner
};

}  // namespace

PolygonSoup parse_obj(std::string_view bytes) {
  return ObjReader(bytes).run();
}

}  // namespace bendlab
