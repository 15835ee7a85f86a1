// Collects the polygons of a mesh file and cuts them into the triangles of a soup.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

/// Puts polygons into a soup: n corners become n - 2 triangles. Faces may come before their points in a file,
/// so all polygons are cut at the end, by cut_polygon.hpp.
class PolygonList {
 public:
  /// `place` is "line" or "face", for error texts: add() gets the number of a line or of a face of the file.
  PolygonList(PolygonSoup& soup, std::string_view place) : soup_(soup), place_(place) {}

  /// Throws std::invalid_argument for fewer than three corners.
  void add(std::span<const std::int64_t> corners, std::size_t place);

  /// Call it after the last polygon and point. `attributes` (one per triangle, or none) holds further indices
  /// of the corners, such as those of texture coordinates, in fans around each polygon's first corner. They
  /// are rearranged like the triangles. Throws std::invalid_argument if a polygon cannot be cut. Polygons
  /// with corners that do not exist or are not finite become fans.
  void cut(std::span<std::array<std::int64_t, 3>> attributes = {});

 private:
  struct Polygon {
    std::size_t first_triangle, corners, place;
  };

  [[noreturn]] void fail(std::size_t place, std::string_view what) const;
  bool take_points(const Polygon& polygon);

  PolygonSoup& soup_;
  std::string_view place_;
  std::vector<Polygon> polygons_;  // all with more than three corners
  std::vector<Vector3> points_;    // corners of the polygon that is being cut
};

}  // namespace bendlab
