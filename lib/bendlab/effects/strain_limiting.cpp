// Strain limiting: no triangle is stretched or squeezed beyond bounds.
//
// F = P Q⁻¹ maps a triangle's material coordinates to space; the singular values σ₁ ≥ σ₂ of F are the
// principal stretches. With F = U Σ Vᵀ and Σ' the clamped stretches, U Σ' Vᵀ = F G for G = V Σ' Σ⁻¹ Vᵀ. To
// compute G, FᵀF = V Σ² Vᵀ is enough. The edges become P' = P Q⁻¹ G Q. The stretches do not determine the
// rigid motion of the triangle. The triangle's centre of mass does not move, so that linear momentum does not
// change. The triangle turns in its plane by the angle at which Σ m r × r' = 0, so that angular momentum does
// not change. So one projection is exact for any masses. Pins are infinite masses. A triangle with one pinned
// corner turns about this corner. In a triangle with two pinned corners only the free corner moves; the
// stretches reach their bounds after several projections, if the pinned edge allows it.
//
// Triangles are projected one after another, each on the result of the previous triangle. If only neighbours
// conflict, a few rounds are enough. If a whole sheet is too long, the number of rounds is about the square
// of the sheet's width in triangles, as with any method that projects one triangle after another.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "bendlab/constraints/tolerances.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/material_coordinates.hpp"

namespace bendlab {
namespace strain_limiting_effect {

constexpr std::array fields = {
    field<&StrainLimiting::min>({.name = "min",
                                 .unit = "1",
                                 .meaning = "smallest allowed principal stretch; 0: no lower bound",
                                 .minimum = 0,
                                 .maximum = 1}),
    field<&StrainLimiting::max>(
        {.name = "max", .unit = "1", .meaning = "largest allowed principal stretch", .minimum = 1}),
};

template <class Real>
using Matrix2 = Eigen::Matrix<Real, 2, 2>;
template <class Real>
using Edges2 = Eigen::Matrix<Real, 3, 2>;  // p1 - p0, p2 - p0

template <class Real>
struct Triangle {
  std::array<std::uint32_t, 3> corners;  // permuted
  std::array<Real, 4> inverse_rest;      // Q⁻¹ by rows, 1/m
};

// Bounds on the principal stretches, which are computed from C = FᵀF.
template <class Real>
class Limits {
  Real min_, max_;

 public:
  explicit Limits(const StrainLimiting& settings)
      : min_(static_cast<Real>(settings.min)), max_(static_cast<Real>(settings.max)) {}

  // Computes G. Returns false if the stretches are within their bounds. C = [[xx, xy], [xy, yy]].
  bool correction(Real xx, Real xy, Real yy, Matrix2<Real>& g) const {
    const Real mean = (xx + yy) / 2, half_difference = (xx - yy) / 2;
    const Real squared = half_difference * half_difference + xy * xy;
    const Real above = max_ * max_ - mean, below = mean - min_ * min_;  // distances of the mean to the bounds
    if (above >= 0 && below >= 0 && squared <= above * above && squared <= below * below) return false;
    const Real radius = std::sqrt(squared);  // σ² = mean ± radius
    const Real first = factor(std::sqrt(mean + radius));
    const Real second = factor(std::sqrt(std::max(mean - radius, Real(0))));
    g = (first + second) / 2 * Matrix2<Real>::Identity();
    if (radius > 0) {  // V diag(1, -1) Vᵀ
      const Matrix2<Real> mirror{{half_difference, xy}, {xy, -half_difference}};
      g += (first - second) / (2 * radius) * mirror;
    }
    return true;
  }

 private:
  // σ' / σ. A collapsed triangle has no direction in which it could grow.
  Real factor(Real stretch) const {
    return stretch > collapsed_ratio<Real> ? std::clamp(stretch, min_, max_) / stretch : Real(1);
  }
};

// Moves a triangle's corners so that the triangle's edges become `edges`, up to a rotation in the plane of
// the triangle. Linear and angular momentum do not change, as described above.
template <class Real>
void place(std::array<Point<Real>*, 3> corners, const Edges2<Real>& edges) {
  using Vector = Vector3Of<Real>;
  const auto pinned = std::ranges::count_if(corners, [](const Point<Real>* p) { return p->w == 0; });
  const auto weight = [](const Point<Real>& p, bool of_pins) {
    return of_pins ? (p.w == 0 ? Real(1) : Real(0)) : (p.w == 0 ? Real(0) : 1 / p.w);
  };
  const std::array<Vector, 3> shape = {Vector::Zero(), edges.col(0), edges.col(1)};
  Vector centre = Vector::Zero(), shape_centre = Vector::Zero();
  Real sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real m = weight(*corners[i], pinned > 0);
    centre += m * corners[i]->vector(), shape_centre += m * shape[i], sum += m;
  }
  centre /= sum, shape_centre /= sum;
  const Vector normal = edges.col(0).cross(edges.col(1)).normalized();
  Real along = 0, across = 0;  // Σ m r·r', Σ m (r × r')·n
  for (std::size_t i = 0; i < 3; ++i) {
    const Real m = weight(*corners[i], pinned > 1);
    const Vector r = corners[i]->vector() - centre, target = shape[i] - shape_centre;
    along += m * r.dot(target), across += m * r.cross(target).dot(normal);
  }
  const Real length = std::sqrt(along * along + across * across);
  const Real cosine = length > 0 ? along / length : Real(1), sine = length > 0 ? -across / length : Real(0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (corners[i]->w == 0) continue;
    const Vector target = shape[i] - shape_centre;
    corners[i]->set(centre + cosine * target + sine * normal.cross(target));
  }
}

template <class Real>
bool limit(const Triangle<Real>& triangle, const Limits<Real>& limits, Points<Real>& points) {
  const auto& [a, b, c] = triangle.corners;
  const auto& q = triangle.inverse_rest;
  const Vector3Of<Real> e1 = points[b].vector() - points[a].vector(),
                        e2 = points[c].vector() - points[a].vector();
  const Vector3Of<Real> f1 = q[0] * e1 + q[2] * e2, f2 = q[1] * e1 + q[3] * e2;  // F's columns
  Matrix2<Real> g;
  if (!limits.correction(f1.squaredNorm(), f1.dot(f2), f2.squaredNorm(), g)) return false;
  Edges2<Real> f;
  f << f1, f2;
  const Matrix2<Real> inverse_rest{{q[0], q[1]}, {q[2], q[3]}};
  place<Real>({&points[a], &points[b], &points[c]}, f * g * inverse_rest.inverse());
  return true;
}

// Sorts triangles by their first corner, so that neighbours are near in memory, for any number of threads.
template <class Real>
std::vector<Triangle<Real>> triangles_of(const EffectInput& input) {
  const std::vector<InverseRest> inverse = inverse_rest_from_warp(input.rest.mesh(), Vector3::UnitX());
  const std::vector<char> degenerate = triangles_without_area(input.rest.mesh());
  std::vector<Triangle<Real>> triangles;
  for (int t = 0; t < input.rest.triangle_count(); ++t) {
    const auto corner = input.rest.triangles().row(t);
    const bool held =
        input.pins.pinned(corner(0)) && input.pins.pinned(corner(1)) && input.pins.pinned(corner(2));
    if (held || degenerate[static_cast<std::size_t>(t)] != 0) continue;
    Triangle<Real> triangle;
    for (std::size_t i = 0; i < 3; ++i)
      triangle.corners[i] = static_cast<std::uint32_t>(input.permuted(corner(static_cast<Eigen::Index>(i))));
    const InverseRest& q = inverse[static_cast<std::size_t>(t)];
    std::ranges::transform(q, triangle.inverse_rest.begin(), [](double x) { return static_cast<Real>(x); });
    triangles.push_back(triangle);
  }
  std::ranges::stable_sort(triangles, {},
                           [](const Triangle<Real>& t) { return *std::ranges::min_element(t.corners); });
  return triangles;
}

template <class Real>
std::vector<Pass<Real>> compile(const StrainLimiting& settings, const EffectInput& input) {
  const Limits<Real> limits(settings);
  std::vector<Triangle<Real>> triangles = triangles_of<Real>(input);
  if (triangles.empty()) return {};
  return {{"strain_limiting", Stage::project,
           [limits, triangles = std::move(triangles)](PassContext<Real>& context) {
             for (const Triangle<Real>& triangle : triangles)
               context.acted += limit(triangle, limits, context.state.position);
           }}};
}

}  // namespace strain_limiting_effect

constinit const EffectKind StrainLimiting::kind{
    .name = "strain_limiting",
    .summary = "bounds on the principal stretches of every triangle; preserves linear and angular momentum",
    .source =
        "Wang, O'Brien and Ramamoorthi 2010 (one triangle is limited by its singular values); the turn that "
        "preserves angular momentum is not from a paper",
    .settings = table_of<StrainLimiting>(strain_limiting_effect::fields),
    .needs_projection = true,
    .keeps_momentum = true,
    .bounds_strain = true,
    .compile_float = erased<strain_limiting_effect::compile<float>>,
    .compile_double = erased<strain_limiting_effect::compile<double>>,
};
}  // namespace bendlab
