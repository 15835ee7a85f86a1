#include "bendlab/bending/sheet_response.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

using Heights = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // #V by 3, for the three unit curvatures

constexpr int held_depth = 1;  // two rows of vertices are held: they fix heights and slopes at the boundary

// #V: edges to the nearest vertex of `from`.
std::vector<int> hops(const RestMesh& rest, std::vector<int> from) {
  std::vector<int> depth(static_cast<std::size_t>(rest.vertex_count()), std::numeric_limits<int>::max());
  for (const int vertex : from) depth[static_cast<std::size_t>(vertex)] = 0;
  for (std::size_t next = 0; next < from.size(); ++next)
    for (const int other : rest.one_ring()[from[next]])
      if (int& there = depth[static_cast<std::size_t>(other)]; there == std::numeric_limits<int>::max())
        there = depth[static_cast<std::size_t>(from[next])] + 1, from.push_back(other);
  return depth;
}

// The vertices where the sheet ends or is not free: ends of edges that have one or more than two triangles,
// pins, corners of triangles without area, and vertices without neighbours.
std::vector<int> ends(const RestMesh& rest, const Pins& pins) {
  std::vector<char> end(pins.is_pinned);
  const std::vector<char> degenerate = triangles_without_area(rest.mesh());
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; degenerate[static_cast<std::size_t>(t)] != 0 && c < 3; ++c)
      end[static_cast<std::size_t>(rest.triangles()(t, c))] = 1;
  for_each_edge(half_edges(rest.triangles()), [&](std::span<const HalfEdge<int>> sides) {
    if (sides.size() != 2)
      for (const int vertex : {sides[0].low, sides[0].high}) end[static_cast<std::size_t>(vertex)] = 1;
  });
  std::vector<int> list;
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (end[static_cast<std::size_t>(v)] != 0 || rest.one_ring()[v].empty()) list.push_back(v);
  return list;
}

Heights surfaces(std::span<const Vector2> plane) {
  Heights z(static_cast<Eigen::Index>(plane.size()), 3);
  for (std::size_t v = 0; v < plane.size(); ++v) {
    const Vector2& p = plane[v];
    z.row(static_cast<Eigen::Index>(v)) << p.x() * p.x() / 2, p.y() * p.y() / 2, p.x() * p.y();
  }
  return z;
}

Eigen::RowVector3d angle(const HeightStencil& stencil, const Heights& z) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += stencil.weight[i] * z.row(stencil.vertices[i]);
  return sum;
}

// Moves the unknown vertices to where the forces on them are zero. `unknown` (#V) numbers these vertices; -1:
// the vertex is held. Returns false if nothing resists the motion of a vertex.
bool relax(std::span<const HeightStencil> stencils, std::span<const double> factor,
           const std::vector<int>& unknown, Eigen::Index unknowns, Heights& z) {
  std::vector<Eigen::Triplet<double>> entries;
  Heights force = Heights::Zero(unknowns, 3);
  for (std::size_t c = 0; c < stencils.size(); ++c) {
    const HeightStencil& stencil = stencils[c];
    const double stiffness = stencil.stiffness * factor[c];
    const Eigen::RowVector3d angles = angle(stencil, z);
    for (std::size_t i = 0; i < 4; ++i) {
      const int row = unknown[static_cast<std::size_t>(stencil.vertices[i])];
      if (row < 0) continue;
      force.row(row) -= stiffness * stencil.weight[i] * angles;
      for (std::size_t j = 0; j < 4; ++j)
        if (const int column = unknown[static_cast<std::size_t>(stencil.vertices[j])]; column >= 0)
          entries.emplace_back(row, column, stiffness * stencil.weight[i] * stencil.weight[j]);
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return false;
  // A stiffness below 10⁻¹³ of the largest is rounding: nothing holds that vertex.
  if (factors.vectorD().minCoeff() <= 1e-13 * factors.vectorD().maxCoeff()) return false;
  const Heights moved = factors.solve(force);
  for (std::size_t v = 0; v < unknown.size(); ++v)
    if (unknown[v] >= 0) z.row(static_cast<Eigen::Index>(v)) += moved.row(unknown[v]);
  return moved.allFinite();
}

}  // namespace

double cylinder_rigidity(const Rigidity& rigidity, const Vector2& d) {
  const Eigen::Vector3d curvature(d.x() * d.x(), d.y() * d.y(), d.x() * d.y());
  return curvature.dot(rigidity * curvature);
}

double strip_rigidity(const Rigidity& rigidity, const Vector2& d) {
  const Eigen::Vector3d moment(d.x() * d.x(), d.y() * d.y(), 2 * d.x() * d.y());  // its work on κ is κ_dd
  return 1 / moment.dot(rigidity.ldlt().solve(moment));
}

SheetResponse::SheetResponse(const RestMesh& rest, const Pins& pins, std::span<const Vector2> plane,
                             int patch)
    : rest_(rest), plane_(plane), area_(static_cast<std::size_t>(rest.vertex_count()), 0) {
  std::vector<int> end = ends(rest, pins);
  if (end.empty()) return;  // a flat sheet has a boundary
  depth_ = hops(rest, end);
  if (patch > 0) {
    const auto reached = [](int depth) { return depth < std::numeric_limits<int>::max(); };
    const auto innermost = std::ranges::max_element(
        depth_, [&](int a, int b) { return (reached(a) ? a : -1) < (reached(b) ? b : -1); });
    const std::vector<int> away = hops(rest, {static_cast<int>(innermost - depth_.begin())});
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (away[static_cast<std::size_t>(v)] >= patch) end.push_back(v);
    std::ranges::sort(end);
    end.erase(std::unique(end.begin(), end.end()), end.end());
    depth_ = hops(rest, end);
  }
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c)
      area_[static_cast<std::size_t>(rest.triangles()(t, c))] +=
          rest.areas()[static_cast<std::size_t>(t)] / 3;
  // The weight falls to 0 near the held vertices. So the result hardly depends on where the rim cuts the
  // cells of a repeating pattern.
  for (const int depth : depth_) {
    const double inside = depth < std::numeric_limits<int>::max() ? std::max(0, depth - held_depth - 1) : 0;
    window_.push_back(inside * inside);
  }
}

bool SheetResponse::measurable() const {
  return std::ranges::any_of(
      depth_, [](int depth) { return depth >= least_depth && depth < std::numeric_limits<int>::max(); });
}

std::optional<SheetResponse::Answer> SheetResponse::operator()(std::span<const HeightStencil> stencils,
                                                               std::span<const double> factor) const {
  if (!measurable()) return std::nullopt;
  std::vector<int> unknown(depth_.size(), -1);
  Eigen::Index unknowns = 0;
  for (std::size_t v = 0; v < depth_.size(); ++v)
    if (depth_[v] > held_depth && depth_[v] < std::numeric_limits<int>::max())
      unknown[v] = static_cast<int>(unknowns++);
  const Heights smooth = surfaces(plane_);
  Heights z = smooth;
  if (!relax(stencils, factor, unknown, unknowns, z)) return std::nullopt;

  // Twice the energy per area at unit curvatures is the rigidity.
  const auto inside = [&](const HeightStencil& stencil) {
    double sum = 0;
    for (const int vertex : stencil.vertices) sum += window_[static_cast<std::size_t>(vertex)] / 4;
    return sum;
  };
  Answer answer{Rigidity::Zero(), Rigidity::Zero(), Heights(static_cast<Eigen::Index>(stencils.size()), 3)};
  for (std::size_t c = 0; c < stencils.size(); ++c) {
    const Eigen::RowVector3d here = angle(stencils[c], z), before = angle(stencils[c], smooth);
    const double weight = inside(stencils[c]) * stencils[c].stiffness * factor[c];
    answer.angles.row(static_cast<Eigen::Index>(c)) = here;
    answer.relaxed += weight * here.transpose() * here;
    answer.unrelaxed += weight * before.transpose() * before;
  }
  // The held rim changes the curvature inside a little. The quadratic surface that fits the relaxed sheet
  // best gives the mean curvature inside.
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
  double area = 0;
  const double size = rest_.size();
  for (std::size_t v = 0; v < depth_.size(); ++v) {
    const double weight = window_[v] * area_[v];
    if (!(weight > 0)) continue;
    area += weight;
    const auto row = static_cast<Eigen::Index>(v);
    Eigen::Matrix<double, 6, 1> basis;
    basis << size * size, size * plane_[v], smooth.row(row).transpose();
    normal += weight * basis * basis.transpose(), right += weight * basis * z.row(row);
  }
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> fit(normal);
  Eigen::Matrix3d mean;  // curvatures, one column per load
  for (int load = 0; load < 3; ++load) {
    const Eigen::Matrix<double, 6, 1> of_load = right.col(load);
    const Eigen::Matrix<double, 6, 1> surface = fit.solve(of_load);
    mean.col(load) = surface.tail<3>();
  }
  const Eigen::Matrix3d back = mean.inverse();
  answer.relaxed = (back.transpose() * answer.relaxed * back / area).eval();
  answer.unrelaxed /= area;
  if (!answer.relaxed.allFinite()) return std::nullopt;
  return answer;
}

}  // namespace bendlab
