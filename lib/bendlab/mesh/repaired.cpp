#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/collinear.hpp"

namespace bendlab {
namespace {

struct Corner {
  std::size_t vertex;
  std::array<double, 2> texture;
};
using Triangle = std::array<Corner, 3>;
using Edge = std::array<std::size_t, 2>;

// The edge opposite a corner.
Edge edge_of(const Triangle& t, std::size_t corner) {
  const std::size_t a = t[(corner + 1) % 3].vertex, b = t[(corner + 2) % 3].vertex;
  return {std::min(a, b), std::max(a, b)};
}

// Why not CGAL's repair of a soup: it renumbers vertices that need no repair, it has no texture, and a NaN in
// an unused point makes it merge different points. Its remove_degenerate_faces() only sees areas that are
// exactly zero.
class Mender {
 public:
  explicit Mender(const PolygonSoup& soup)
      : points_(soup.points), textured_(!soup.texture_coordinates.empty()), same_as_(points_.size()) {
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      Triangle& triangle = triangles_.emplace_back();
      for (std::size_t c = 0; c < 3; ++c)
        triangle[c] = {static_cast<std::size_t>(soup.triangles[t][c]),
                       textured_ ? soup.texture_coordinates[3 * t + c] : std::array<double, 2>{}};
    }
    std::iota(same_as_.begin(), same_as_.end(), std::size_t(0));
  }

  PolygonSoup run() {
    unite_equal_points();
    find_thickness();
    constexpr int rounds = 100;  // of two thin neighbours one waits for the next round
    for (int round = 0; round < rounds && mend_thin_ones(); ++round) unite();
    std::erase_if(triangles_, [&](const Triangle& t) { return thin(t); });
    return oriented();
  }

 private:
  Vector3 point(const Corner& corner) const {
    return Eigen::Map<const Vector3>(points_[corner.vertex].data());
  }
  // Length of the edge opposite a corner.
  double length(const Triangle& t, std::size_t corner) const {
    return (point(t[(corner + 1) % 3]) - point(t[(corner + 2) % 3])).norm();
  }
  bool thin(const Triangle& t) const {
    return collinear_within(thickness_, point(t[0]), point(t[1]), point(t[2]));
  }

  void unite_equal_points() {
    std::map<std::array<double, 3>, std::size_t> first;
    for (const Triangle& t : triangles_)
      for (const Corner& corner : t)
        same_as_[corner.vertex] = first.try_emplace(points_[corner.vertex], corner.vertex).first->second;
    unite();
  }

  std::size_t representative(std::size_t vertex) const {
    while (same_as_[vertex] != vertex) vertex = same_as_[vertex];
    return vertex;
  }

  // Gives united vertices one index. Removes triangles that lose a corner by it, and copies.
  void unite() {
    std::set<std::array<std::size_t, 3>> seen;
    std::erase_if(triangles_, [&](Triangle& t) {
      for (Corner& corner : t) corner.vertex = representative(corner.vertex);
      std::array<std::size_t, 3> key = {t[0].vertex, t[1].vertex, t[2].vertex};
      std::ranges::sort(key);
      return key[0] == key[1] || key[1] == key[2] || !seen.insert(key).second;
    });
  }

  void find_thickness() {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : triangles_)
      for (const Corner& corner : t) box.extend(point(corner));
    thickness_ = box.isEmpty() ? 0 : zero_area_thickness * box.diagonal().norm();
  }

  // If a thin triangle has a short edge, the ends of that edge are united. Otherwise a vertex m lies on its
  // longest edge: the triangles beyond that edge are split at m, and the thin one is removed.
  //
  //      a --- m --- b          a --- m --- b
  //        \       /     ->       \   |   /
  //          \   /                  \ | /
  //            d                      d
  bool mend_thin_ones() {
    std::map<Edge, std::vector<std::size_t>> at_edge;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) at_edge[edge_of(triangles_[t], c)].push_back(t);
    const std::size_t count = triangles_.size();
    std::vector<char> touched(count, 0), gone(count, 0);
    bool found = false;
    for (std::size_t t = 0; t < count; ++t) {
      if (touched[t] != 0 || !thin(triangles_[t])) continue;
      found = true;
      const Triangle triangle = triangles_[t];
      std::array<std::size_t, 3> by_length = {0, 1, 2};
      std::ranges::sort(by_length, {}, [&](std::size_t c) { return length(triangle, c); });
      if (length(triangle, by_length[0]) <= 2 * thickness_) {
        const auto [low, high] = edge_of(triangle, by_length[0]);
        const std::size_t a = representative(low), b = representative(high);
        same_as_[std::max(a, b)] = std::min(a, b);
        continue;
      }
      const Edge longest = edge_of(triangle, by_length[2]);
      std::vector<std::size_t> beyond = at_edge[longest];
      std::erase(beyond, t);
      if (std::ranges::any_of(beyond, [&](std::size_t other) { return touched[other] != 0; })) continue;
      for (const std::size_t other : beyond) split(other, longest, triangle[by_length[2]]);
      for (const std::size_t other : beyond) touched[other] = 1;
      touched[t] = gone[t] = 1;
    }
    gone.resize(triangles_.size(), 0);
    std::size_t at = 0;
    std::erase_if(triangles_, [&](const Triangle&) { return gone[at++] != 0; });
    return found;
  }

  void split(std::size_t t, const Edge& edge, const Corner& at) {
    Triangle second = triangles_[t];
    for (Corner& corner : second)
      if (corner.vertex == edge[0]) corner = at;
    for (Corner& corner : triangles_[t])
      if (corner.vertex == edge[1]) corner = at;
    triangles_.push_back(second);
  }

  // CGAL doubles vertices where the surface branches, touches itself in a point or cannot be oriented. It
  // also reverses triangles, but keeps their order.
  PolygonSoup oriented() const {
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    std::vector<Point> points;
    for (const auto& p : points_) points.emplace_back(p[0], p[1], p[2]);
    std::vector<std::vector<std::size_t>> polygons;
    for (const Triangle& t : triangles_) polygons.push_back({t[0].vertex, t[1].vertex, t[2].vertex});
    CGAL::Polygon_mesh_processing::orient_polygon_soup(points, polygons);

    PolygonSoup soup;
    for (const Point& p : points) soup.points.push_back({p.x(), p.y(), p.z()});
    for (std::size_t t = 0; t < polygons.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        soup.triangles.resize(t + 1);
        soup.triangles[t][c] = static_cast<std::int64_t>(polygons[t][c]);
        if (textured_)
          soup.texture_coordinates.push_back(texture_at(triangles_[t], soup.points[polygons[t][c]]));
      }
    }
    return soup;
  }

  // By position: a doubled vertex has another index, but no other corner of the triangle is at its position.
  std::array<double, 2> texture_at(const Triangle& t, const std::array<double, 3>& position) const {
    return std::ranges::find_if(t, [&](const Corner& corner) { return points_[corner.vertex] == position; })
        ->texture;
  }

  std::vector<std::array<double, 3>> points_;
  std::vector<Triangle> triangles_;
  bool textured_;
  std::vector<std::size_t> same_as_;  // for each point itself, or one that it was united with
  double thickness_ = 0;              // m
};

}  // namespace

PolygonSoup repaired(const PolygonSoup& soup) {
  return Mender(soup).run();
}

}  // namespace bendlab
