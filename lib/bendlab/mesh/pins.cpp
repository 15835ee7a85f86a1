#include "bendlab/mesh/pins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bendlab/mesh/rings.hpp"
#include "bendlab/settings/names.hpp"

namespace bendlab {
namespace {

constexpr double relative_tolerance = 1e-6;  // of the mesh's size: more than rounding, less than any edge

// The two coordinates of the point in a view from the front.
Vector2 on_face(const NamedAxes& axes, const Vector3& point) {
  return {point(axes.right), point(axes.up)};
}

// The shape of a mesh in which places have their names, and its box.
struct NamedShape {
  explicit NamedShape(const RestMesh& rest)
      : positions(rest.named_positions()),
        low(positions.colwise().minCoeff()),
        high(positions.colwise().maxCoeff()) {}

  Vector3 position(int v) const { return positions.row(v).transpose(); }
  double size() const { return (high - low).norm(); }

  const Positions& positions;
  Vector3 low, high;
};

int nearest_vertex(const RestMesh& rest, const Vector2& target) {
  const NamedAxes axes = named_axes(rest);
  const NamedShape shape(rest);
  const auto distance = [&](int v) { return (on_face(axes, shape.position(v)) - target).norm(); };
  const double equal = relative_tolerance * shape.size();
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < rest.vertex_count(); ++v) least = std::min(least, distance(v));
  // Whether v is farther to the front than `other`. Ties go to the lower vertex, and then to the left vertex.
  const auto goes_before = [&](int v, int other) {
    const Vector3 way = shape.position(v) - shape.position(other);
    for (const double by : {way(axes.front), -way(axes.up), -way(axes.right)})
      if (std::abs(by) > equal) return by > 0;
    return false;
  };
  int nearest = -1;
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (distance(v) <= least + equal && (nearest < 0 || goes_before(v, nearest))) nearest = v;
  return nearest;
}

// Vertices whose coordinate `axis` is `level`, up to rounding.
std::vector<int> side_vertices(const RestMesh& rest, int axis, double level) {
  std::vector<int> side;
  const NamedShape shape(rest);
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (std::abs(shape.positions(v, axis) - level) <= relative_tolerance * shape.size()) side.push_back(v);
  return side;
}

std::vector<int> rim_vertices(const RestMesh& rest, std::string_view name, double level) {
  std::vector<int> rim = side_vertices(rest, 2, level);
  if (static_cast<int>(rim.size()) == rest.vertex_count())
    throw std::invalid_argument(
        fmt::format("'{}' means the vertices at one end of a tube along z, but this mesh is flat, so that "
                    "all vertices would be pinned. Use corners or sides instead",
                    name));
  return rim;
}

// The vertices of a disc around the middle vertex that have a neighbour outside the disc.
std::vector<int> circle_vertices(const RestMesh& rest) {
  const NamedAxes axes = named_axes(rest);
  const NamedShape shape(rest);
  const Vector2 extent = on_face(axes, shape.high - shape.low);
  const double radius = 0.25 * extent.minCoeff() + relative_tolerance * shape.size();
  const Vector3 centre = 0.5 * (shape.low + shape.high);
  const Vector3 middle = shape.position(nearest_vertex(rest, on_face(axes, centre)));
  const auto is_inside = [&](int v) { return (shape.position(v) - middle).norm() <= radius; };
  std::vector<int> circle;
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (is_inside(v) && !std::ranges::all_of(rest.one_ring()[v], is_inside)) circle.push_back(v);
  return circle;
}

// The vertices nearest to 0.3 and 0.7 of both extents. (On a grid, several vertices are equally near to
// 0.25.)
std::vector<int> interior_vertices(const RestMesh& rest) {
  const NamedAxes axes = named_axes(rest);
  const NamedShape shape(rest);
  const Vector2 low = on_face(axes, shape.low), extent = on_face(axes, shape.high) - low;
  std::vector<int> interior;
  for (const double y : {0.3, 0.7})
    for (const double x : {0.3, 0.7})
      interior.push_back(nearest_vertex(rest, low + extent.cwiseProduct(Vector2(x, y))));
  return interior;
}

// Squared distance of a point from the segment from a to b.
double squared_distance(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = b - a;
  const double length = along.squaredNorm(),
               share = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
  return (point - a - share * along).squaredNorm();
}

// Marks the vertices within `distance` of a seed (see pins.hpp) or of an edge between two seeds.
void pin_within(const RestMesh& rest, const std::vector<int>& seeds, double distance,
                std::vector<char>& is_pinned) {
  std::vector<std::array<int, 2>> segments;
  for (const int seed : seeds) {
    segments.push_back({seed, seed});
    for (const int other : rest.one_ring()[seed])
      if (other > seed && std::binary_search(seeds.begin(), seeds.end(), other))
        segments.push_back({seed, other});
  }
  const double reach = distance + relative_tolerance * rest.size();
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (std::ranges::any_of(segments, [&](const auto& s) {
          return squared_distance(rest.position(v), rest.position(s[0]), rest.position(s[1])) <=
                 reach * reach;
        }))
      is_pinned[static_cast<std::size_t>(v)] = 1;
}

}  // namespace

Pins make_pins(const RestMesh& rest, std::vector<int> seeds, int rings, double distance) {
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  Pins pins;
  pins.is_pinned.assign(static_cast<std::size_t>(rest.vertex_count()), 0);
  RingWalker walker(rest.one_ring());
  for (const int seed : seeds) {
    if (seed < 0 || seed >= rest.vertex_count())
      throw std::out_of_range(fmt::format("vertex {} cannot be pinned: the mesh has vertices 0 to {}", seed,
                                          rest.vertex_count() - 1));
    walker.walk(seed, rings);
    for (int r = 0; r <= rings; ++r)
      for (const int vertex : walker.ring(r)) pins.is_pinned[static_cast<std::size_t>(vertex)] = 1;
  }
  if (distance > 0) pin_within(rest, seeds, distance, pins.is_pinned);
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (pins.pinned(v)) pins.all.push_back(v);
  pins.seeds = std::move(seeds);
  return pins;
}

NamedAxes named_axes(const RestMesh& rest) {
  constexpr double thin = 0.1;  // of the other two extents; the folds of a curtain are less deep
  const NamedShape shape(rest);
  const Vector3 extent = shape.high - shape.low;
  const auto is_thin = [&](int axis, int second, int third) {
    return extent(axis) < thin * std::min(extent(second), extent(third));
  };
  if (is_thin(1, 0, 2)) return {0, 2, 1};
  if (is_thin(0, 1, 2)) return {1, 2, 0};
  return {};
}

std::vector<int> select_vertices(const RestMesh& rest, Place place) {
  const NamedAxes axes = named_axes(rest);
  const NamedShape shape(rest);
  const Vector2 low = on_face(axes, shape.low), high = on_face(axes, shape.high);
  switch (place) {
    case Place::upper_right:
      return {nearest_vertex(rest, high)};
    case Place::upper_left:
      return {nearest_vertex(rest, {low.x(), high.y()})};
    case Place::lower_right:
      return {nearest_vertex(rest, {high.x(), low.y()})};
    case Place::lower_left:
      return {nearest_vertex(rest, low)};
    case Place::top:
      return side_vertices(rest, axes.up, high.y());
    case Place::bottom:
      return side_vertices(rest, axes.up, low.y());
    case Place::left:
      return side_vertices(rest, axes.right, low.x());
    case Place::right:
      return side_vertices(rest, axes.right, high.x());
    case Place::centre:
      return {nearest_vertex(rest, 0.5 * (low + high))};
    case Place::top_rim:
      return rim_vertices(rest, name_in(place_names, place), shape.high.z());
    case Place::bottom_rim:
      return rim_vertices(rest, name_in(place_names, place), shape.low.z());
    case Place::circle:
      return circle_vertices(rest);
    case Place::interior:
      return interior_vertices(rest);
  }
  throw std::logic_error("select_vertices: unknown place");
}

}  // namespace bendlab
