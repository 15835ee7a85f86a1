// The discrete Kirchhoff triangle: normals at the vertices are unknowns; at the middles of edges they follow
// the edges.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"
#include "bendlab/constraints/corners.hpp"

namespace bendlab {
namespace {

constexpr std::size_t arity = 6;  // three vertices, then their normals
using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, 3 * arity, 1>>;
template <class Scalar>
using Vec = Eigen::Matrix<Scalar, 3, 1>;

// The second fundamental form of the triangle at the point with barycentric coordinates (1 - s - t, s, t), in
// the basis of its two edges from corner 0: b11, b12, b22. `normal` has the unit normals at the vertices.
// Normals are quadratic over the triangle. At the middle of an edge, the part along the edge is such that the
// edge bends as a cubic curve, and the part across it is the mean of both ends.
template <class Scalar>
Vec<Scalar> second_form(const std::array<Vec<Scalar>, 3>& v, const std::array<Vec<Scalar>, 3>& normal,
                        double s, double t) {
  const std::array<Eigen::Vector2d, 6> slope = {Eigen::Vector2d(-3 + 4 * s + 4 * t, -3 + 4 * s + 4 * t),
                                                Eigen::Vector2d(4 * s - 1, 0),
                                                Eigen::Vector2d(0, 4 * t - 1),
                                                Eigen::Vector2d(4 * t, 4 * s),
                                                Eigen::Vector2d(-4 * t, 4 * (1 - s - 2 * t)),
                                                Eigen::Vector2d(4 * (1 - 2 * s - t), -4 * s)};
  const Vec<Scalar> e1 = v[1] - v[0], e2 = v[2] - v[0], face = e1.cross(e2).normalized();
  std::array<Vec<Scalar>, 6> n;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = normal[i];
    const Vec<Scalar> along = (v[k] - v[j]).normalized(), across = face.cross(along),
                      sum = normal[j] + normal[k];
    n[3 + i] = across * (Scalar(0.5) * across.dot(sum)) - along * (Scalar(0.25) * along.dot(sum));
  }
  Vec<Scalar> b = Vec<Scalar>::Zero();
  for (std::size_t i = 0; i < 6; ++i) {
    b(0) += Scalar(slope[i].x()) * e1.dot(n[i]);
    b(1) += Scalar(0.5 * slope[i].y()) * e1.dot(n[i]) + Scalar(0.5 * slope[i].x()) * e2.dot(n[i]);
    b(2) += Scalar(slope[i].y()) * e2.dot(n[i]);
  }
  return b;
}

constexpr std::array<std::array<double, 2>, 3> quadrature = {
    {{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}};

struct Triangle {
  Eigen::Matrix2d inverse;  // of the two edges in the rest triangle's plane, 1/m; the x axis is the warp,
                            // if the rigidity depends on the direction
  std::array<Eigen::Vector3d, 3> rest_form{};  // b at the points of the quadrature
  double area;                                 // m²
  std::array<double, 3> length;                // of a normal, m
};

// Twice the energy per area of a curvature, for a flexural rigidity of 1 N m (its mean over the directions).
class RelativeRigidity {
 public:
  explicit RelativeRigidity(const BendingInput& input) : poisson_ratio_(input.poisson_ratio) {
    if (input.directed == nullptr) return;
    const OrthotropicRigidity& stated = input.directed->rigidity;
    const double mean = stated.mean();
    directed_ = {stated.warp / mean, stated.weft / mean, stated.coupling / mean, stated.twist / mean};
  }

  template <class Scalar>
  Scalar operator()(const Eigen::Matrix<Scalar, 2, 2>& k) const {
    if (directed_)
      return Scalar(directed_->warp) * k(0, 0) * k(0, 0) + Scalar(directed_->weft) * k(1, 1) * k(1, 1) +
             Scalar(2 * directed_->coupling) * k(0, 0) * k(1, 1) +
             Scalar(4 * directed_->twist) * k(0, 1) * k(0, 1);
    const Scalar trace = k(0, 0) + k(1, 1);
    return Scalar(1 - poisson_ratio_) * k.squaredNorm() + Scalar(poisson_ratio_) * trace * trace;
  }

 private:
  double poisson_ratio_;
  std::optional<OrthotropicRigidity> directed_;
};

// U of a triangle, for a flexural rigidity of 1 N m. A normal of another length than at rest has an energy,
// too, so that its length is determined.
template <class Scalar>
Scalar energy_of(const Triangle& triangle, const RelativeRigidity& rigidity,
                 const std::array<Vec<Scalar>, arity>& p) {
  std::array<Vec<Scalar>, 3> v, normal;
  Scalar sum(0);
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = p[i];
    const Scalar length = p[3 + i].norm();
    normal[i] = p[3 + i] / length;
    const Scalar stretch = length / Scalar(triangle.length[i]) - Scalar(1);
    sum += Scalar(0.5) * stretch * stretch;
  }
  for (std::size_t q = 0; q < 3; ++q) {
    const Vec<Scalar> b = second_form<Scalar>(v, normal, quadrature[q][0], quadrature[q][1]) -
                          triangle.rest_form[q].template cast<Scalar>();
    Eigen::Matrix<Scalar, 2, 2> form;
    form << b(0), b(1), b(1), b(2);
    const Eigen::Matrix<Scalar, 2, 2> inverse = triangle.inverse.template cast<Scalar>();
    const Eigen::Matrix<Scalar, 2, 2> k = inverse.transpose() * form * inverse;
    sum += Scalar(0.5 * triangle.area / 3) * rigidity(k);
  }
  return sum;
}

class Function final : public ElementFunction {
 public:
  Function(std::vector<Triangle> triangles, const RelativeRigidity& rigidity)
      : triangles_(std::move(triangles)), rigidity_(rigidity) {}

  std::string_view name() const override { return "dkt"; }
  bool is_energy() const override { return true; }
  void evaluate(std::span<const int> which, std::span<const double> corners, std::span<double> values,
                std::span<double> gradients) const override {
    for (std::size_t i = 0; i < which.size(); ++i) {
      std::array<Vec<Number>, arity> p;
      const std::size_t first = 3 * arity * i;
      for (std::size_t k = 0; k < 3 * arity; ++k)
        p[k / 3](static_cast<Eigen::Index>(k % 3)) =
            Number(corners[first + k], 3 * arity, static_cast<int>(k));
      const Number energy = energy_of(triangles_[static_cast<std::size_t>(which[i])], rigidity_, p);
      values[i] = energy.value();
      for (std::size_t k = 0; k < 3 * arity; ++k)
        gradients[first + k] = energy.derivatives()(static_cast<Eigen::Index>(k));
    }
  }
  /// Makes the shape with these corners (#T by 6 by 3) the rest shape.
  void rest_at(std::span<const double> corners) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      std::array<Vector3, 3> v, normal;
      for (std::size_t i = 0; i < 3; ++i) {
        v[i] = Eigen::Map<const Vector3>(&corners[3 * (arity * t + i)]);
        normal[i] = Eigen::Map<const Vector3>(&corners[3 * (arity * t + 3 + i)]).normalized();
      }
      for (std::size_t q = 0; q < 3; ++q)
        triangles_[t].rest_form[q] = second_form<double>(v, normal, quadrature[q][0], quadrature[q][1]);
    }
  }

 private:
  std::vector<Triangle> triangles_;
  RelativeRigidity rigidity_;
};

// A normal at every vertex: the mean of its triangles' normals, weighted by area, as long as the root of the
// vertex's area. The normal of a pinned vertex is pinned if a triangle of pinned vertices clamps it.
Directors normals_of(const BendingInput& input, const std::vector<RestFace>& faces) {
  const RestMesh& rest = input.rest;
  Directors directors;
  directors.coordinates = 3;
  directors.rest = Positions::Zero(rest.vertex_count(), 3);
  directors.is_pinned.assign(static_cast<std::size_t>(rest.vertex_count()), 0);
  std::vector<double> area(directors.is_pinned.size(), 0);
  for (const RestFace& face : faces) {
    const auto p = corners(rest.positions(), face.vertices);
    const bool clamps = std::ranges::all_of(face.vertices, [&](int v) { return input.pins.pinned(v); });
    for (const int v : face.vertices) {
      directors.rest.row(v) += (p[1] - p[0]).cross(p[2] - p[0]).transpose();
      area[static_cast<std::size_t>(v)] += face.area / 3;
      if (clamps) directors.is_pinned[static_cast<std::size_t>(v)] = 1;
    }
  }
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    directors.vertices.push_back({v, v});
    if (directors.rest.row(v).norm() > 0)
      directors.rest.row(v) *= std::sqrt(area[at]) / directors.rest.row(v).norm();
    else
      directors.is_pinned[at] = 1;  // a vertex without area
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
  std::vector<Triangle> triangles;
  for (const RestFace& face : faces) {
    if (std::ranges::all_of(face.vertices, [&](int v) { return input.pins.pinned(v); })) continue;
    const auto p = corners(rest.positions(), face.vertices);
    const bool is_directed = input.directed != nullptr;
    const Vector3 x = is_directed ? input.directed->warp[static_cast<std::size_t>(face.triangle)] : face.x,
                  y = is_directed ? Vector3(face.x.cross(face.y).cross(x)) : face.y;
    Eigen::Matrix2d edges;
    edges << (p[1] - p[0]).dot(x), (p[2] - p[0]).dot(x), (p[1] - p[0]).dot(y), (p[2] - p[0]).dot(y);
    Triangle triangle{.inverse = edges.inverse(), .area = face.area, .length = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.length[i] = directors.rest.row(face.vertices[i]).norm();
      own.vertices.push_back(face.vertices[i]);
    }
    for (const int v : face.vertices) own.vertices.push_back(rest.vertex_count() + v);
    triangles.push_back(triangle);
    own.softness.push_back(1);
  }
  const auto function = std::make_shared<Function>(std::move(triangles), RelativeRigidity(input));
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

}  // namespace

constinit const BendingKind Dkt::kind{
    .name = "dkt",
    .label = "DKT",
    .summary =
        "the discrete Kirchhoff triangle: the normals at the vertices are unknowns, and the normals at "
        "the middles of edges follow from cubic edges",
    .source = "Batoz, Bathe and Ho 1980; for large deflections as in Chen, Kaufman and Vouga 2026",
    .limits =
        "10 to 100 times slower than models with kernels; a sheet of one triangle has no stiffness; needs "
        "the method newton, quasi_newton or equilibrium, and triangles that all face the same side",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder",
    .settings = table_of<Dkt>({}),
    .uses_sides = true,
    .needs_energy = true,
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .takes_poisson_ratio = true,
    .takes_directions = true,
    .build = erased<build>,
};
}  // namespace bendlab
