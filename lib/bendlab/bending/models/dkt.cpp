// The discrete Kirchhoff triangle: normals at the vertices are unknowns; at the middles of edges they follow
// the edges.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"
#include "bendlab/constraints/corners.hpp"

namespace bendlab {
namespace dkt_model {

constexpr std::size_t arity = 6;  // three vertices, then their normals
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Normals are quadratic over the triangle, with values at its corners and then at the middles of the edges
// opposite to them. #q by 6: the derivatives of the shape functions along the edges from corner 0, at the
// three points of the quadrature.
struct Slopes {
  std::array<Vector6, 3> s, t;
  Slopes() {
    constexpr std::array<std::array<double, 2>, 3> points = {
        {{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}};
    for (std::size_t q = 0; q < 3; ++q) {
      const auto [x, y] = points[q];
      s[q] << -3 + 4 * x + 4 * y, 4 * x - 1, 0, 4 * y, -4 * y, 4 * (1 - 2 * x - y);
      t[q] << -3 + 4 * x + 4 * y, 0, 4 * y - 1, 4 * x, 4 * (1 - x - 2 * y), -4 * x;
    }
  }
};
const Slopes slopes;

// The edge opposite to each corner, as a sum of the two edges from corner 0.
const std::array<Eigen::Vector2d, 3> opposite = {Eigen::Vector2d(-1, 1), Eigen::Vector2d(0, 1),
                                                 Eigen::Vector2d(1, 0)};

// A triangle with unit normals at its corners. At the middle of an edge, the part of the normal along the
// edge is such that the edge bends as a cubic curve, and the part across it is the mean of both ends.
struct Shape {
  Eigen::Matrix<double, 3, 2> edges;   // from corner 0
  Eigen::Matrix3d normals;             // unit, a column for each corner
  Eigen::Matrix2d metric;              // products of edges
  Eigen::Matrix<double, 2, 6> slants;  // products of both edges with the normals at corners and middles
  std::array<double, 3> sum_along;     // of an edge: product with the normals at both ends
  Eigen::Matrix<double, 2, 3> along;   // of both edges: the part along an edge, over that edge's length

  Shape(const std::array<Vector3, 3>& v, const Eigen::Matrix3d& unit) : normals(unit) {
    edges << v[1] - v[0], v[2] - v[0];
    metric = edges.transpose() * edges;
    slants.leftCols<3>() = edges.transpose() * normals;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d& edge = opposite[static_cast<std::size_t>(i)];
      const Eigen::Vector2d sum = slants.col((i + 1) % 3) + slants.col((i + 2) % 3);
      const Eigen::Vector2d part = metric * edge;
      along.col(i) = part / edge.dot(part);
      sum_along[static_cast<std::size_t>(i)] = edge.dot(sum);
      slants.col(3 + i) = 0.5 * sum - 0.75 * edge.dot(sum) * along.col(i);
    }
  }

  // The second fundamental form at a point of the quadrature, in the basis of the edges: b11, b12, b22.
  Vector3 form(std::size_t q) const {
    const Vector6 &s = slopes.s[q], &t = slopes.t[q];
    return {slants.row(0).dot(s), 0.5 * (slants.row(0).dot(t) + slants.row(1).dot(s)), slants.row(1).dot(t)};
  }

  // From the derivatives by `slants` to those by edges and unit normals.
  void pull_back(Eigen::Matrix<double, 2, 6>& by_slants, Eigen::Matrix<double, 3, 2>& by_edges,
                 Eigen::Matrix3d& by_normals) const {
    Eigen::Matrix2d by_metric = Eigen::Matrix2d::Zero();
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d& edge = opposite[static_cast<std::size_t>(i)];
      const Eigen::Vector2d middle = by_slants.col(3 + i);
      const Eigen::Vector2d by_sum = 0.5 * middle - 0.75 * middle.dot(along.col(i)) * edge;
      by_slants.col((i + 1) % 3) += by_sum;
      by_slants.col((i + 2) % 3) += by_sum;
      const Eigen::Vector2d by_along = -0.75 * sum_along[static_cast<std::size_t>(i)] * middle;
      by_metric +=
          (by_along - by_along.dot(along.col(i)) * edge) / edge.dot(metric * edge) * edge.transpose();
    }
    by_edges = edges * (by_metric + by_metric.transpose()) + normals * by_slants.leftCols<3>().transpose();
    by_normals = edges * by_slants.leftCols<3>();
  }
};

struct Triangle {
  Eigen::Matrix3d rigidity;            // κᵀ D κ of a form b is bᵀ times this times b, for 1 N m
  std::array<Vector3, 3> rest_form{};  // b at the points of the quadrature
  double area;                         // m²
  std::array<double, 3> length;        // of a normal, m
};

// D for a flexural rigidity of 1 N m, which is its mean over the directions.
OrthotropicRigidity relative_rigidity(const BendingInput& input) {
  if (input.directed == nullptr) return {1, 1, input.poisson_ratio, 0.5 * (1 - input.poisson_ratio)};
  const OrthotropicRigidity& stated = input.directed->rigidity;
  const double mean = stated.mean();
  return {stated.warp / mean, stated.weft / mean, stated.coupling / mean, stated.twist / mean};
}

// `edges`: the two edges from corner 0, as columns along warp and weft, or along any two perpendicular axes
// if the rigidity does not depend on the direction.
Eigen::Matrix3d rigidity_of_forms(const OrthotropicRigidity& rigidity, const Eigen::Matrix2d& edges) {
  const Eigen::Matrix2d i = edges.inverse();
  Eigen::Matrix3d curvature;  // of the forms (1, 0, 0), (0, 1, 0) and (0, 0, 1)
  curvature << i(0, 0) * i(0, 0), 2 * i(0, 0) * i(1, 0), i(1, 0) * i(1, 0),  //
      i(0, 1) * i(0, 1), 2 * i(0, 1) * i(1, 1), i(1, 1) * i(1, 1),           //
      2 * i(0, 0) * i(0, 1), 2 * (i(0, 0) * i(1, 1) + i(1, 0) * i(0, 1)), 2 * i(1, 0) * i(1, 1);
  Eigen::Matrix3d result;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) result(a, b) = rigidity.product(curvature.col(a), curvature.col(b));
  return result;
}

std::array<Vector3, 3> points_at(const double* corners) {
  return {Eigen::Map<const Vector3>(corners), Eigen::Map<const Vector3>(corners + 3),
          Eigen::Map<const Vector3>(corners + 6)};
}

// U of a triangle, for a flexural rigidity of 1 N m, and its gradient by the corners. A normal of another
// length than at rest has an energy, too, so that its length is determined.
double energy_of(const Triangle& triangle, const double* corners, double* gradient) {
  const std::array<Vector3, 3> vectors = points_at(corners + 9);
  Eigen::Matrix3d unit;
  for (int i = 0; i < 3; ++i) unit.col(i) = vectors[static_cast<std::size_t>(i)].normalized();
  const Shape shape(points_at(corners), unit);
  double energy = 0;
  Eigen::Matrix<double, 2, 6> by_slants = Eigen::Matrix<double, 2, 6>::Zero();
  for (std::size_t q = 0; q < 3; ++q) {
    const Vector3 change = shape.form(q) - triangle.rest_form[q],
                  moment = triangle.area / 3 * (triangle.rigidity * change);
    energy += 0.5 * moment.dot(change);
    by_slants.row(0) += moment(0) * slopes.s[q].transpose() + 0.5 * moment(1) * slopes.t[q].transpose();
    by_slants.row(1) += 0.5 * moment(1) * slopes.s[q].transpose() + moment(2) * slopes.t[q].transpose();
  }
  Eigen::Matrix<double, 3, 2> by_edges;
  Eigen::Matrix3d by_normals;
  shape.pull_back(by_slants, by_edges, by_normals);
  Eigen::Map<Eigen::Matrix<double, 3, 6>> by_corners(gradient);
  by_corners.col(0) = -by_edges.col(0) - by_edges.col(1);
  by_corners.middleCols<2>(1) = by_edges;
  for (int i = 0; i < 3; ++i) {
    const double length = vectors[static_cast<std::size_t>(i)].norm(),
                 rest = triangle.length[static_cast<std::size_t>(i)], stretch = length / rest - 1;
    const Vector3 n = unit.col(i), slope = by_normals.col(i);
    energy += 0.5 * stretch * stretch;
    by_corners.col(3 + i) = (slope - slope.dot(n) * n) / length + stretch / rest * n;
  }
  return energy;
}

class Function final : public ElementFunction {
 public:
  explicit Function(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {}

  std::string_view name() const override { return "dkt"; }
  bool is_energy() const override { return true; }
  void evaluate(std::span<const int> which, std::span<const double> corners, std::span<double> values,
                std::span<double> gradients) const override {
    for (std::size_t i = 0; i < which.size(); ++i)
      values[i] = energy_of(triangles_[static_cast<std::size_t>(which[i])], &corners[3 * arity * i],
                            &gradients[3 * arity * i]);
  }
  /// Makes the shape with these corners (#T by 6 by 3) the rest shape.
  void rest_at(std::span<const double> corners) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const double* own = &corners[3 * arity * t];
      Eigen::Matrix3d unit;
      for (int i = 0; i < 3; ++i) unit.col(i) = points_at(own + 9)[static_cast<std::size_t>(i)].normalized();
      const Shape shape(points_at(own), unit);
      for (std::size_t q = 0; q < 3; ++q) triangles_[t].rest_form[q] = shape.form(q);
    }
  }

 private:
  std::vector<Triangle> triangles_;
};

// A normal at every vertex: the mean of its triangles' normals, weighted by area, as long as the root of the
// vertex's area. A plane of symmetry doubles the area of its vertices, so that a normal there has the same
// inertia as in the whole sheet. The normal of a pinned vertex is pinned if a triangle of pinned vertices
// clamps it.
Directors normals_of(const BendingInput& input, const std::vector<RestFace>& faces) {
  const RestMesh& rest = input.rest;
  Directors directors;
  directors.coordinates = 3;
  directors.rest = Positions::Zero(rest.vertex_count(), 3);
  directors.is_pinned.assign(static_cast<std::size_t>(rest.vertex_count()), 0);
  std::vector<double> area(directors.is_pinned.size(), 0);
  std::map<int, std::array<int, 3>> clamps;  // of a vertex: a triangle of pinned vertices
  for (const RestFace& face : faces) {
    const auto p = corners(rest.positions(), face.vertices);
    const bool is_clamp = std::ranges::all_of(face.vertices, [&](int v) { return input.pins.pinned(v); });
    for (const int v : face.vertices) {
      directors.rest.row(v) += (p[1] - p[0]).cross(p[2] - p[0]).transpose();
      area[static_cast<std::size_t>(v)] += face.area / 3;
      if (is_clamp) clamps.try_emplace(v, face.vertices);
    }
  }
  directors.held = input.pins.symmetric;  // a normal lies in the planes of symmetry through its vertex
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    directors.vertices.push_back({v, v});
    for (int axis = 0; axis < 3; ++axis)
      if (directors.is_held(v, axis)) directors.rest(v, axis) = 0, area[at] *= 2;
    if (directors.rest.row(v).norm() > 0)
      directors.rest.row(v) *= std::sqrt(area[at]) / directors.rest.row(v).norm();
    else
      directors.is_pinned[at] = 1;  // a vertex without area
  }
  for (const auto& [v, triangle] : clamps) {
    directors.is_pinned[static_cast<std::size_t>(v)] = 1;
    directors.clamped.emplace_back(v, triangle, rest.positions(), directors.rest.row(v).transpose());
  }
  return directors;
}

BendingConstraints build(const Dkt&, const BendingInput& input) {
  BendingConstraints constraints;
  const RestMesh& rest = input.rest;
  const std::vector<RestFace> faces = rest_faces(rest, input.pins);
  Directors& directors = constraints.directors = normals_of(input, faces);
  OwnElements& own = constraints.own;
  own.arity = arity, own.directors = 3;
  const OrthotropicRigidity rigidity = relative_rigidity(input);
  std::vector<Triangle> triangles;
  for (const RestFace& face : faces) {
    if (std::ranges::all_of(face.vertices, [&](int v) { return input.pins.pinned(v); })) continue;
    const auto p = corners(rest.positions(), face.vertices);
    const bool is_directed = input.directed != nullptr;
    const Vector3 x = is_directed ? input.directed->warp[static_cast<std::size_t>(face.triangle)] : face.x,
                  y = is_directed ? Vector3(face.x.cross(face.y).cross(x)) : face.y;
    Eigen::Matrix2d edges;
    edges << (p[1] - p[0]).dot(x), (p[2] - p[0]).dot(x), (p[1] - p[0]).dot(y), (p[2] - p[0]).dot(y);
    Triangle triangle{.rigidity = rigidity_of_forms(rigidity, edges), .area = face.area, .length = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.length[i] = directors.rest.row(face.vertices[i]).norm();
      own.vertices.push_back(face.vertices[i]);
    }
    for (const int v : face.vertices) own.vertices.push_back(rest.vertex_count() + v);
    triangles.push_back(triangle);
    own.softness.push_back(1);
  }
  const auto function = std::make_shared<Function>(std::move(triangles));
  own.function = function;
  if (input.is_flat) return constraints;
  directors.rest = relaxed_directors(directors, constraints.elements, own, rest.positions(), directors.rest);
  const Positions points = joined(rest.positions(), directors.rest);
  std::vector<double> all;
  for (const int v : own.vertices)
    for (int axis = 0; axis < 3; ++axis) all.push_back(points(v, axis));
  function->rest_at(all);
  return constraints;
}

}  // namespace dkt_model

constinit const BendingKind Dkt::kind{
    .name = "dkt",
    .label = "DKT",
    .summary =
        "the discrete Kirchhoff triangle: the normals at the vertices are unknowns, and the normals at "
        "the middles of edges follow from cubic edges",
    .source = "Batoz, Bathe and Ho 1980; for large deflections as in Chen, Kaufman and Vouga 2026",
    .limits =
        "an iteration of quasi_newton takes about 5 times as long as with hinges; a sheet of one triangle "
        "has "
        "no stiffness; needs the method newton, quasi_newton or equilibrium, and triangles that all face the "
        "same side",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder",
    .settings = table_of<Dkt>({}),
    .uses_sides = true,
    .needs_energy = true,
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .takes_poisson_ratio = true,
    .takes_directions = true,
    .build = erased<dkt_model::build>,
    .points_per_vertex = 2,
};
}  // namespace bendlab
