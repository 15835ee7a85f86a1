// Collects the polygons of a mesh file and cuts them into the triangles of a soup.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

/// Adds polygons to a soup: n corners give n - 2 triangles. In a file, faces may come before their points, so
/// all polygons are cut at the end (cut_polygon.hpp).
class PolygonList {
 public:
  /// `place` is "line" or "face", for error texts. add() gets the number of that line or face in the file.
  PolygonList(PolygonSoup& soup, std::string_view place) : soup_(soup), place_(place) {}

  /// Throws std::invalid_argument for fewer than three corners.
  void add(std::span<const std::int64_t> corners, std::size_t place);

  /// Cuts all polygons; to be called after the last polygon and point. `attributes` (one per triangle, or
  /// none) holds other indices of the triangles' corners, for example of texture coordinates; they are
  /// rearranged with the triangles. Throws std::invalid_argument if a polygon cannot be cut. A polygon
  /// becomes a fan if a corner does not exist or is not finite.
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
