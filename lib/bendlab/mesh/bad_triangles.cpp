#include "bendlab/mesh/bad_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>

#include "bendlab/mesh/collinear.hpp"

namespace bendlab {
namespace {

// The part of a warning that says what the policy did about a problem.
std::string_view treatment(MeshProblemKind kind, BadTriangles policy) {
  const bool mends = policy == BadTriangles::repair;
  switch (kind) {
    case MeshProblemKind::empty:
      break;
    case MeshProblemKind::non_finite_vertex:
      return "left out with its triangles";
    case MeshProblemKind::index_out_of_range:
    case MeshProblemKind::repeated_vertex:
      return "left out";
    case MeshProblemKind::duplicate_triangle:
      return "left out except for the first copy";
    case MeshProblemKind::isolated_vertex:
      return "left out, which shifts the indices of later vertices";
    case MeshProblemKind::zero_area:
      return mends ? "collapsed to an edge, or removed by splitting the triangles beyond the longest edge"
             : policy == BadTriangles::membrane_off
                 ? "simulated without strain constraint and without bending (but with a rest height and a "
                   "strain constraint if a vertex would otherwise have no strain constraint)"
                 : "simulated with a small rest height and without bending";
    case MeshProblemKind::non_manifold_edge:
      return mends ? "cut, its vertices doubled" : "kept, without bending across it";
    case MeshProblemKind::non_manifold_vertex:
      return mends ? "cut, the vertex doubled" : "kept as one vertex";
    case MeshProblemKind::inconsistent_orientation:
      return mends ? "turned to face the same side where possible"
                   : "kept: the simulation depends on it only where a warning says so";
  }
  return {};
}

// The soup without duplicate triangles and without triangles that cannot be used.
PolygonSoup without_unusable(const PolygonSoup& soup) {
  PolygonSoup usable{.points = soup.points, .triangles = {}, .texture_coordinates = {}};
  std::set<std::array<std::int64_t, 3>> seen;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    auto corners = soup.triangles[t];
    const bool usable_corners = std::ranges::all_of(corners, [&](std::int64_t v) {
      return v >= 0 && v < static_cast<std::int64_t>(soup.points.size()) &&
             is_finite(soup.points[static_cast<std::size_t>(v)]);
    });
    std::ranges::sort(corners);
    if (!usable_corners || corners[0] == corners[1] || corners[1] == corners[2] ||
        !seen.insert(corners).second)
      continue;
    usable.triangles.push_back(soup.triangles[t]);
    for (std::size_t c = 3 * t; c < 3 * t + 3 && !soup.texture_coordinates.empty(); ++c)
      usable.texture_coordinates.push_back(soup.texture_coordinates[c]);
  }
  // Points that no triangle uses may still be NaN or infinite; to_mesh() leaves them out.
  return usable;
}

// Whether any policy other than `refuse` accepts the soup.
bool has_remedy(const PolygonSoup& soup) {
  for (const BadTriangles policy :
       {BadTriangles::repair, BadTriangles::regularise, BadTriangles::membrane_off})
    try {
      accept(soup, policy);
      return true;
    } catch (const std::invalid_argument&) {
    }
  return false;
}

std::string lines_of(const std::vector<MeshProblem>& problems) {
  std::string lines;
  for (const MeshProblem& problem : problems)
    if (!problem.harmless()) lines += "\n  " + describe(problem);
  return lines;
}

}  // namespace

AcceptedMesh accept(const PolygonSoup& soup, BadTriangles policy, std::string_view remedy) {
  const std::vector<MeshProblem> problems = diagnose(soup);
  if (soup.triangles.empty())
    throw std::invalid_argument(
        "has no triangles: export the whole mesh with its faces, not only the selected part");
  const std::string refusal = lines_of(problems);
  if (!refusal.empty() && policy == BadTriangles::refuse)
    throw std::invalid_argument(
        fmt::format("can't be simulated: repair the mesh in an editor{} (indices count from 0):{}",
                    has_remedy(soup) ? fmt::format(", or {}", remedy) : "", refusal));
  AcceptedMesh accepted;
  for (const MeshProblem& problem : problems)
    accepted.notes.push_back(fmt::format("{}: {}", treatment(problem.kind, policy), describe(problem)));
  if (soup.untextured_triangles > 0)
    accepted.notes.push_back(
        fmt::format("texture coordinates left out, because {} of {} triangles have no texture coordinates",
                    soup.untextured_triangles, soup.triangles.size()));
  PolygonSoup usable = policy == BadTriangles::refuse ? soup : without_unusable(soup);
  if (policy == BadTriangles::repair) {
    const std::size_t used = static_cast<std::size_t>(to_mesh(usable).vertex_count());
    Repaired mended = repaired(usable);
    usable = std::move(mended.soup);
    std::ranges::move(mended.notes, std::back_inserter(accepted.notes));
    const std::size_t left = static_cast<std::size_t>(to_mesh(usable).vertex_count());
    if (used != left) accepted.notes.push_back(fmt::format("repaired: {} vertices became {}", used, left));
  }
  if (usable.triangles.empty())
    throw std::invalid_argument(
        "can't be simulated: no usable triangle is left; repair the mesh in an editor (indices count from "
        "0):" +
        refusal);
  accepted.mesh = to_mesh(usable);
  if (!((accepted.mesh.positions.colwise().maxCoeff() - accepted.mesh.positions.colwise().minCoeff()).norm() >
        0))
    throw std::invalid_argument("can't be simulated: all vertices are at the same point");
  accepted.renumbered =
      policy == BadTriangles::repair
          ? !problems.empty() || accepted.mesh.vertex_count() != static_cast<Eigen::Index>(soup.points.size())
          : accepted.mesh.vertex_count() != static_cast<Eigen::Index>(soup.points.size());
  return accepted;
}

std::vector<char> triangles_without_area(const TriangleMesh& mesh) {
  std::vector<char> degenerate;
  degenerate.reserve(static_cast<std::size_t>(mesh.triangle_count()));
  const double thickness = zero_area_thickness *
                           (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  for (const auto& corner : mesh.triangles.rowwise())
    degenerate.push_back(collinear_within(thickness, mesh.positions.row(corner(0)),
                                          mesh.positions.row(corner(1)), mesh.positions.row(corner(2))));
  return degenerate;
}

}  // namespace bendlab
