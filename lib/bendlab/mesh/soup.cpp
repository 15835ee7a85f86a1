#include "bendlab/mesh/soup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bendlab/mesh/collinear.hpp"
#include "bendlab/mesh/disjoint_sets.hpp"
#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

constexpr std::size_t listed_offenders = 5;

struct KindText {
  std::string_view singular, plural;
};

// Does not give a NaN to fmt, which compares numbers: with BENDLAB_TRAPS that would stop the program.
std::string number_text(double number) {
  if (std::isfinite(number)) return fmt::format("{}", number);
  return std::isnan(number) ? "nan" : number < 0 ? "-inf" : "inf";
}

KindText text_of(MeshProblemKind kind) {
  switch (kind) {
    case MeshProblemKind::empty:
      return {"no triangles", "no triangles"};
    case MeshProblemKind::non_finite_vertex:
      return {"vertex with a coordinate that is not a finite number",
              "vertices with a coordinate that is not a finite number"};
    case MeshProblemKind::index_out_of_range:
      return {"triangle with a vertex index out of range", "triangles with a vertex index out of range"};
    case MeshProblemKind::repeated_vertex:
      return {"triangle with a repeated vertex", "triangles with a repeated vertex"};
    case MeshProblemKind::zero_area:
      return {"triangle with zero area", "triangles with zero area"};
    case MeshProblemKind::duplicate_triangle:
      return {"duplicate triangle", "duplicate triangles"};
    case MeshProblemKind::non_manifold_edge:
      return {"edge shared by more than two triangles", "edges shared by more than two triangles"};
    case MeshProblemKind::non_manifold_vertex:
      return {"vertex where parts of the mesh touch only at this point",
              "vertices where parts of the mesh touch only at a point"};
    case MeshProblemKind::inconsistent_orientation:
      return {"edge whose two triangles face different sides",
              "edges whose two triangles face different sides"};
    case MeshProblemKind::isolated_vertex:
      return {"vertex in no triangle", "vertices in no triangle"};
  }
  return {};
}

class Diagnosis {
 public:
  explicit Diagnosis(const PolygonSoup& soup) : soup_(soup) {}

  std::vector<MeshProblem> run() {
    if (soup_.triangles.empty()) report(MeshProblemKind::empty, "");
    check_vertices();
    check_indices();
    check_areas();
    drop_duplicates();
    check_edges();
    check_fans();
    std::sort(problems_.begin(), problems_.end(),
              [](const auto& l, const auto& r) { return l.kind < r.kind; });
    return std::move(problems_);
  }

 private:
  void report(MeshProblemKind kind, std::string offender) {
    auto problem =
        std::find_if(problems_.begin(), problems_.end(), [&](const auto& p) { return p.kind == kind; });
    if (problem == problems_.end()) problem = problems_.insert(problem, {kind, 0, {}});
    if (++problem->count <= listed_offenders && !offender.empty())
      problem->offenders.push_back(std::move(offender));
  }

  void report_triangle(MeshProblemKind kind, std::size_t t) {
    report(kind, fmt::format("triangle {} ({})", t, fmt::join(soup_.triangles[t], ", ")));
  }

  bool is_point(std::int64_t index) const {
    return index >= 0 && index < static_cast<std::int64_t>(soup_.points.size());
  }

  Vector3 point(std::int64_t index) const {
    return Eigen::Map<const Vector3>(soup_.points[static_cast<std::size_t>(index)].data());
  }

  void check_vertices() {
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      const Vector3 p = point(static_cast<std::int64_t>(v));
      if (is_finite(p))
        box_min_ = box_min_.cwiseMin(p), box_max_ = box_max_.cwiseMax(p);
      else
        report(MeshProblemKind::non_finite_vertex,
               fmt::format("vertex {} ({}, {}, {})", v, number_text(p.x()), number_text(p.y()),
                           number_text(p.z())));
    }
  }

  void check_indices() {
    std::vector<char> used(soup_.points.size(), 0);
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      const auto& [a, b, c] = soup_.triangles[t];
      for (const std::int64_t v : {a, b, c})
        if (is_point(v)) used[static_cast<std::size_t>(v)] = 1;
      if (!is_point(a) || !is_point(b) || !is_point(c))
        report_triangle(MeshProblemKind::index_out_of_range, t);
      else if (a == b || b == c || c == a)
        report_triangle(MeshProblemKind::repeated_vertex, t);
      else
        sound_.push_back(t);
    }
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v] == 0) report(MeshProblemKind::isolated_vertex, fmt::format("vertex {}", v));
  }

  void check_areas() {
    const double thickness = zero_area_thickness * (box_max_ - box_min_).norm();
    for (const std::size_t t : sound_) {
      const auto& [a, b, c] = soup_.triangles[t];
      const bool finite = is_finite(point(a)) && is_finite(point(b)) && is_finite(point(c));
      if (finite && collinear_within(thickness, point(a), point(b), point(c)))
        report_triangle(MeshProblemKind::zero_area, t);
    }
  }

  void drop_duplicates() {
    const auto key = [&](std::size_t t) {
      auto corners = soup_.triangles[t];
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    std::vector<std::pair<std::array<std::int64_t, 3>, std::size_t>> keyed;
    for (const std::size_t t : sound_) keyed.emplace_back(key(t), t);
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::size_t> copies;
    for (std::size_t i = 1; i < keyed.size(); ++i)
      if (keyed[i].first == keyed[i - 1].first) copies.push_back(keyed[i].second);
    std::sort(copies.begin(), copies.end());
    for (const std::size_t t : copies) report_triangle(MeshProblemKind::duplicate_triangle, t);
    std::erase_if(sound_, [&](std::size_t t) { return std::binary_search(copies.begin(), copies.end(), t); });
  }

  // Checks edges, and finds the fans of triangles around vertices. A fan consists of the triangles at a
  // vertex that are connected by edges at that vertex.
  void check_edges() {
    using Side = HalfEdge<std::int64_t>;
    const auto triangle = [&](const Side& side) { return sound_[static_cast<std::size_t>(side.triangle())]; };
    const auto start = [&](const Side& side) {
      return soup_.triangles[triangle(side)][static_cast<std::size_t>(side.corner())];
    };
    const std::vector<Side> all =
        half_edges(static_cast<std::int64_t>(sound_.size()), [&](std::int64_t t, std::int64_t c) {
          return soup_.triangles[sound_[static_cast<std::size_t>(t)]][static_cast<std::size_t>(c)];
        });
    for_each_edge(all, [&](std::span<const Side> sides) {
      const std::int64_t low = sides[0].low, high = sides[0].high;
      for (const Side& side : sides.subspan(1))
        for (const std::int64_t end : {low, high})
          fans_.join(corner_at(triangle(sides[0]), end), corner_at(triangle(side), end));
      if (sides.size() > 2)
        report(MeshProblemKind::non_manifold_edge,
               fmt::format("edge {}-{} ({} triangles)", low, high, sides.size()));
      if (sides.size() == 2 && start(sides[0]) == start(sides[1]))
        report(MeshProblemKind::inconsistent_orientation,
               fmt::format("edge {}-{} (triangles {} and {})", low, high, triangle(sides[0]),
                           triangle(sides[1])));
    });
  }

  std::size_t corner_at(std::size_t triangle, std::int64_t vertex) const {
    const auto& corners = soup_.triangles[triangle];
    return 3 * triangle +
           static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
  }

  void check_fans() {
    std::vector<int> fan_count(soup_.points.size(), 0);
    for (const std::size_t t : sound_)
      for (std::size_t c = 0; c < 3; ++c)
        if (fans_.find(3 * t + c) == 3 * t + c) ++fan_count[static_cast<std::size_t>(soup_.triangles[t][c])];
    for (std::size_t v = 0; v < fan_count.size(); ++v)
      if (fan_count[v] > 1)
        report(MeshProblemKind::non_manifold_vertex, fmt::format("vertex {} ({} fans)", v, fan_count[v]));
  }

  const PolygonSoup& soup_;
  std::vector<MeshProblem> problems_;
  std::vector<std::size_t> sound_;  // triangles with three different vertices that exist
  Vector3 box_min_ = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 box_max_ = -box_min_;
  DisjointSets fans_{3 * soup_.triangles.size()};  // of triangle corners
};

}  // namespace

std::vector<MeshProblem> diagnose(const PolygonSoup& soup) {
  return Diagnosis(soup).run();
}

PolygonSoup to_soup(const TriangleMesh& mesh) {
  PolygonSoup soup;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
    soup.points.push_back({mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)});
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    soup.triangles.push_back({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)});
  return soup;
}

std::vector<MeshProblem> diagnose(const TriangleMesh& mesh) {
  return diagnose(to_soup(mesh));
}

std::string describe(const MeshProblem& problem) {
  const KindText text = text_of(problem.kind);
  if (problem.kind == MeshProblemKind::empty) return std::string(text.singular);
  std::string line = fmt::format("{} {}: {}", problem.count, problem.count == 1 ? text.singular : text.plural,
                                 fmt::join(problem.offenders, ", "));
  if (problem.count > problem.offenders.size()) line += ", …";
  return line;
}

TriangleMesh to_mesh(const PolygonSoup& soup) {
  std::vector<int> new_index(soup.points.size(), -1);
  for (const auto& triangle : soup.triangles)
    for (const std::int64_t v : triangle) new_index[static_cast<std::size_t>(v)] = 0;
  int kept = 0;
  for (int& index : new_index)
    if (index == 0) index = kept++;

  TriangleMesh mesh;
  mesh.positions.resize(kept, 3);
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (new_index[v] >= 0)
      mesh.positions.row(new_index[v]) = Eigen::Map<const Eigen::RowVector3d>(soup.points[v].data());
  mesh.triangles.resize(static_cast<Eigen::Index>(soup.triangles.size()), 3);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      mesh.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(c)) =
          new_index[static_cast<std::size_t>(soup.triangles[t][c])];
  mesh.texture_coordinates.resize(static_cast<Eigen::Index>(soup.texture_coordinates.size()), 2);
  for (std::size_t c = 0; c < soup.texture_coordinates.size(); ++c)
    mesh.texture_coordinates.row(static_cast<Eigen::Index>(c)) =
        Eigen::Map<const Eigen::RowVector2d>(soup.texture_coordinates[c].data());
  return mesh;
}

}  // namespace bendlab
