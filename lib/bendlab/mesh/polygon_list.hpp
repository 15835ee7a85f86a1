// The polygons of a mesh file on their way into a soup.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

/// Puts polygons into a soup: n corners become n - 2 triangles. Faces may come before their points: they are
/// cut at the end, by cut_polygon.hpp.
class PolygonList {
 public:
  /// `place`: what the numbers of add() count in the file, for error texts: "line" or "face".
  PolygonList(PolygonSoup& soup, std::string_view place) : soup_(soup), place_(place) {}

  /// Throws std::invalid_argument for fewer than three corners.
  void add(std::span<const std::int64_t> corners, std::size_t place);

  /// To be called after the last polygon and point. `others` (as many as triangles, or none): what else the
  /// corners have, in fans around each polygon's first corner; becomes what the triangles' corners have.
  /// Throws std::invalid_argument where a polygon cannot be cut. Polygons with corners that do not exist or
  /// are not finite become fans.
  void cut(std::span<std::array<std::int64_t, 3>> others = {});

 private:
  struct Polygon {
    std::size_t first_triangle, corners, place;
  };

  [[noreturn]] void fail(std::size_t place, std::string_view what) const;
  bool take_points(const Polygon& polygon);

  PolygonSoup& soup_;
  std::string_view place_;
  std::vector<Polygon> polygons_;  // of more than three corners
  std::vector<Vector3> points_;    // of the polygon that is being cut
};

}  // namespace bendlab
