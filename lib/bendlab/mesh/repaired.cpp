#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/collinear.hpp"
#include "bendlab/mesh/disjoint_sets.hpp"
#include "bendlab/mesh/near_points.hpp"
#include "bendlab/mesh/orientation.hpp"

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

// CGAL's repair of soups is not used, because it renumbers vertices that need no repair, drops texture
// coordinates, merges different points if an unused point is NaN, and cuts a Möbius band along instead of
// across. CGAL's remove_degenerate_faces() removes only triangles whose area is exactly zero.
class Mender {
 public:
  explicit Mender(const PolygonSoup& soup)
      : points_(soup.points), textured_(!soup.texture_coordinates.empty()) {
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      Triangle& triangle = triangles_.emplace_back();
      for (std::size_t c = 0; c < 3; ++c)
        triangle[c] = {static_cast<std::size_t>(soup.triangles[t][c]),
                       textured_ ? soup.texture_coordinates[3 * t + c] : std::array<double, 2>{}};
    }
  }

  Repaired run() {
    unite_near_points();
    find_thickness();
    constexpr int rounds = 100;  // of two thin neighbours, the second is repaired in a later round
    for (int round = 0; round < rounds && mend_thin_triangles(); ++round) unite();
    std::erase_if(triangles_, [&](const Triangle& t) { return thin(t); });
    while (turn_and_cut()) {  // a cut may leave an edge with two triangles that face different sides
    }
    report_cuts();
    return {.soup = soup(), .notes = std::move(notes_)};
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

  void unite_near_points() {
    std::vector<char> used(points_.size(), 0);
    Eigen::AlignedBox3d box;
    for (const Triangle& t : triangles_)
      for (const Corner& corner : t) used[corner.vertex] = 1, box.extend(point(corner));
    const double tolerance = box.isEmpty() ? 0 : united_within * box.diagonal().norm();
    const std::vector<std::size_t> same_as = near_points(points_, used, tolerance);
    united_ = DisjointSets(points_.size());
    std::size_t united = 0;
    double farthest = 0;
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (same_as[v] == v) continue;
      united_.join(v, same_as[v]);
      ++united;
      farthest = std::max(farthest, (Eigen::Map<const Vector3>(points_[v].data()) -
                                     Eigen::Map<const Vector3>(points_[same_as[v]].data()))
                                        .norm());
    }
    unite();
    if (united > 0)
      notes_.push_back(fmt::format(
          "united: {}, each with a vertex {} (the tolerance is {:.2g} m, {:.0e} of the mesh's size)",
          united == 1 ? "1 vertex" : fmt::format("{} vertices", united),
          farthest > 0 ? fmt::format("at most {:.2g} m away", farthest) : "at the same place", tolerance,
          united_within));
  }

  // Gives united vertices the same index. Removes triangles with two equal corners, and duplicate triangles.
  void unite() {
    std::set<std::array<std::size_t, 3>> seen;
    std::erase_if(triangles_, [&](Triangle& t) {
      for (Corner& corner : t) corner.vertex = united_.find(corner.vertex);
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

  // Repairs triangles without area. If such a triangle has a short edge, the ends of that edge are united. If
  // not, a corner m lies on the longest edge: the triangles beyond that edge are split at m, and the thin
  // triangle is removed. Returns whether any triangle was thin.
  //
  //      a --- m --- b          a --- m --- b
  //        \       /     ->       \   |   /
  //          \   /                  \ | /
  //            d                      d
  bool mend_thin_triangles() {
    std::map<Edge, std::vector<std::size_t>> at_edge;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) at_edge[edge_of(triangles_[t], c)].push_back(t);
    const std::size_t count = triangles_.size();
    std::vector<char> touched(count, 0), gone(count, 0);
    bool any_thin = false;
    for (std::size_t t = 0; t < count; ++t) {
      if (touched[t] != 0 || !thin(triangles_[t])) continue;
      any_thin = true;
      const Triangle triangle = triangles_[t];
      std::array<std::size_t, 3> by_length = {0, 1, 2};
      std::ranges::sort(by_length, {}, [&](std::size_t c) { return length(triangle, c); });
      if (length(triangle, by_length[0]) <= 2 * thickness_) {
        const auto [low, high] = edge_of(triangle, by_length[0]);
        united_.join(low, high);
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
    return any_thin;
  }

  void split(std::size_t t, const Edge& edge, const Corner& at) {
    Triangle second = triangles_[t];
    for (Corner& corner : second)
      if (corner.vertex == edge[0]) corner = at;
    for (Corner& corner : triangles_[t])
      if (corner.vertex == edge[1]) corner = at;
    triangles_.push_back(second);
  }

  PolygonSoup soup() const {
    PolygonSoup soup{.points = points_};
    for (const Triangle& t : triangles_) {
      auto& corners = soup.triangles.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = static_cast<std::int64_t>(t[c].vertex);
        if (textured_) soup.texture_coordinates.push_back(t[c].texture);
      }
    }
    return soup;
  }

  // Reverses triangles so that neighbours face the same side. Then cuts the mesh where the surface branches,
  // touches itself at a point, or has only one side, by giving every fan of triangles around a vertex a
  // separate vertex. Returns whether the mesh was cut.
  bool turn_and_cut() {
    const PolygonSoup before = soup();
    const Orientation orientation = orientation_of(before);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (orientation.turned[t] != 0) std::swap(triangles_[t][1], triangles_[t][2]);
    DisjointSets fans(3 * triangles_.size());  // of corners
    const auto corner_at = [&](std::size_t t, std::int64_t vertex) {
      std::size_t c = 0;
      while (triangles_[t][c].vertex != static_cast<std::size_t>(vertex)) ++c;
      return 3 * t + c;
    };
    for (const SharedEdge& edge : orientation.edges) {
      if (!edge.alike) {
        ++seams_, seam_length_ += length(edge);
        continue;
      }
      for (const std::int64_t end : edge.ends)
        fans.join(corner_at(edge.triangles[0], end), corner_at(edge.triangles[1], end));
    }
    return double_vertices(fans);
  }

  // Gives each fan a vertex; the first fan keeps the old vertex. Returns whether vertices were added.
  bool double_vertices(DisjointSets& fans) {
    constexpr std::size_t unset = static_cast<std::size_t>(-1);
    const std::size_t before = points_.size();
    std::vector<std::size_t> first_fan(before, unset), vertex_of(3 * triangles_.size(), unset);
    for (std::size_t i = 0; i < 3 * triangles_.size(); ++i) {
      std::size_t& vertex = triangles_[i / 3][i % 3].vertex;
      const std::size_t fan = fans.find(i);
      if (vertex_of[fan] == unset) {
        const bool is_first = first_fan[vertex] == unset;
        if (is_first) first_fan[vertex] = fan;
        vertex_of[fan] = is_first ? vertex : points_.size();
        if (!is_first) points_.push_back(std::array(points_[vertex]));
      }
      vertex = vertex_of[fan];
    }
    return points_.size() > before;
  }

  double length(const SharedEdge& edge) const {
    const auto at = [&](std::int64_t vertex) {
      return Eigen::Map<const Vector3>(points_[static_cast<std::size_t>(vertex)].data());
    };
    return (at(edge.ends[0]) - at(edge.ends[1])).norm();
  }

  void report_cuts() {
    if (seams_ > 0)
      notes_.push_back(fmt::format(
          "cut along {}, {:.3g} m in all, because the surface has only one side there, like a Möbius band, "
          "so that not all triangles can face the same side",
          seams_ == 1 ? "1 edge" : fmt::format("{} edges", seams_), seam_length_));
  }

  std::vector<std::array<double, 3>> points_;
  std::vector<Triangle> triangles_;
  bool textured_;
  DisjointSets united_{0};  // sets of points
  double thickness_ = 0;    // m
  std::size_t seams_ = 0;   // cut edges of surfaces with only one side
  double seam_length_ = 0;  // m
  std::vector<std::string> notes_;
};

}  // namespace

Repaired repaired(const PolygonSoup& soup) {
  return Mender(soup).run();
}

}  // namespace bendlab
