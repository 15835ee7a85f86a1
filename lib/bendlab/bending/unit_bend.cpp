#include "bendlab/bending/unit_bend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bendlab/bending/model.hpp"
#include "bendlab/mesh/bad_triangles.hpp"
#include "bendlab/mesh/connected_parts.hpp"

namespace bendlab {
namespace {

using Gradients = Eigen::Matrix<double, 2, 3>;  // of a triangle's three hat functions, 1/m
using Forms = Eigen::Matrix<double, Eigen::Dynamic, 5>;

// The height z of the bent sheet, divided by κ: ½ x² c² + x y c s + ½ y² s².
QuadraticForm height(const Vector2& q) {
  return {0.5 * q.x() * q.x(), q.x() * q.y(), 0.5 * q.y() * q.y()};
}

QuarticForm product(const QuadraticForm& a, const QuadraticForm& b) {
  QuarticForm p{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) p[i + j] += a[i] * b[j];
  return p;
}

// The unit normal of a flat sheet, on the side that most of its area faces. Triangles that face the other
// side are added with the opposite normal; otherwise the sum would be 0 for a sheet with half of its
// triangles turned over.
Vector3 normal_of(const RestMesh& rest) {
  const auto twice_area = [&](int t) -> Vector3 {
    const auto corner = rest.triangles().row(t);
    const Vector3 first = rest.position(corner(0));
    return (rest.position(corner(1)) - first).cross(rest.position(corner(2)) - first);
  };
  const auto largest = std::ranges::max_element(rest.areas());
  if (largest == rest.areas().end()) return Vector3::Zero();
  const Vector3 side = twice_area(static_cast<int>(largest - rest.areas().begin()));
  Vector3 alike = Vector3::Zero(), sum = Vector3::Zero();
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const Vector3 normal = twice_area(t);
    sum += normal;
    if (normal.dot(side) < 0)
      alike -= normal;
    else
      alike += normal;
  }
  if (!(alike.norm() > 0)) return Vector3::Zero();
  return sum.dot(alike) < 0 ? -alike.normalized() : alike.normalized();
}

// Zero for a triangle without area, so that the triangle adds nothing.
Gradients hat_gradients(const std::array<Vector2, 3>& q, double twice_area) {
  Gradients g = Gradients::Zero();
  if (!(std::abs(twice_area) > 0)) return g;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 opposite = q[(i + 2) % 3] - q[(i + 1) % 3];
    g.col(static_cast<Eigen::Index>(i)) = Vector2(-opposite.y(), opposite.x()) / twice_area;
  }
  return g;
}

// The strains of a triangle as (xx, yy, √2 xy), whose squared norm is |ε|²: one part from the displacements
// of the triangle's corners, and one part from the triangle's slopes.
struct TriangleBend {
  std::array<int, 3> corner;
  double area;
  Eigen::Matrix<double, 3, 6> strain_of;   // of (w0x, w0y, w1x, …), 1/m
  Eigen::Matrix<double, 3, 5> from_slope;  // ½ ∇z ∇zᵀ over κ², quartic forms, m²
};

TriangleBend triangle_bend(const std::array<int, 3>& corner, const std::vector<Vector2>& plane) {
  std::array<Vector2, 3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = plane[static_cast<std::size_t>(corner[i])];
  const Vector2 u = q[1] - q[0], v = q[2] - q[0];
  const double twice_area = u.x() * v.y() - u.y() * v.x();
  const Gradients g = hat_gradients(q, twice_area);
  TriangleBend bend{corner, 0.5 * std::abs(twice_area), {}, {}};
  bend.strain_of.setZero();
  std::array<QuadraticForm, 2> slope{};
  for (int i = 0; i < 3; ++i) {
    const double gx = g(0, i), gy = g(1, i), shear = std::sqrt(0.5);
    bend.strain_of.col(2 * i) << gx, 0, shear * gy;
    bend.strain_of.col(2 * i + 1) << 0, gy, shear * gx;
    const QuadraticForm z = height(q[static_cast<std::size_t>(i)]);
    for (std::size_t k = 0; k < 3; ++k) slope[0][k] += gx * z[k], slope[1][k] += gy * z[k];
  }
  const std::array<QuarticForm, 3> half = {product(slope[0], slope[0]), product(slope[1], slope[1]),
                                           product(slope[0], slope[1])};
  for (int e = 0; e < 3; ++e)
    for (int k = 0; k < 5; ++k)
      bend.from_slope(e, k) = (e == 2 ? std::sqrt(2.0) : 1) * 0.5 *
                              half[static_cast<std::size_t>(e)][static_cast<std::size_t>(k)];
  return bend;
}

// The unknowns to fix so that no connected part of the sheet can move as a rigid body: in each part both
// unknowns of one vertex, and one unknown of a second vertex, which prevents the rotation.
std::vector<int> held_unknowns(const RestMesh& rest, const std::vector<Vector2>& plane) {
  std::vector<int> held;
  for (const std::vector<int>& part : connected_parts(rest.one_ring())) {
    Vector2 farthest = Vector2::Zero();
    const int seed = part.front();
    int end = seed;
    for (const int vertex : part) {
      const Vector2 offset = plane[static_cast<std::size_t>(vertex)] - plane[static_cast<std::size_t>(seed)];
      if (offset.norm() > farthest.norm()) farthest = offset, end = vertex;
    }
    held.insert(held.end(), {2 * seed, 2 * seed + 1});
    if (end != seed) held.push_back(2 * end + (std::abs(farthest.x()) > std::abs(farthest.y()) ? 1 : 0));
  }
  return held;
}

Forms least_strain(const RestMesh& rest, const std::vector<Vector2>& plane,
                   const std::vector<TriangleBend>& bends) {
  const Eigen::Index unknowns = 2 * rest.vertex_count();
  std::vector<Eigen::Triplet<double>> entries;
  Forms right = Forms::Zero(unknowns, 5);
  double stiffest = 0;
  const auto unknown = [](const TriangleBend& bend, int i) {
    return 2 * bend.corner[static_cast<std::size_t>(i / 2)] + i % 2;
  };
  for (const TriangleBend& bend : bends) {
    const Eigen::Matrix<double, 6, 6> stiffness = bend.area * bend.strain_of.transpose() * bend.strain_of;
    const Eigen::Matrix<double, 6, 5> load = -bend.area * bend.strain_of.transpose() * bend.from_slope;
    for (int i = 0; i < 6; ++i) {
      right.row(unknown(bend, i)) += load.row(i);
      stiffest = std::max(stiffest, stiffness(i, i));
      for (int j = 0; j < 6; ++j) entries.emplace_back(unknown(bend, i), unknown(bend, j), stiffness(i, j));
    }
  }
  // Stiff springs fix these unknowns. The springs remain unstrained: a rigid motion of a part costs no
  // energy.
  for (const int held : held_unknowns(rest, plane)) entries.emplace_back(held, held, stiffest);
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw std::invalid_argument(
        "the strain of this mesh's membrane cannot be computed, because a vertex lies only on triangles "
        "without area: repair the mesh");
  return factors.solve(right);
}

}  // namespace

std::vector<Vector2> plane_coordinates(const RestMesh& rest) {
  const Vector3 normal = normal_of(rest);
  if (normal.isZero()) return {};
  Vector3 x = Vector3::UnitX() - normal.x() * normal;
  if (x.norm() < 0.5) x = Vector3::UnitY() - normal.y() * normal;
  x.normalize();
  const Vector3 y = normal.cross(x);
  std::vector<Vector2> plane;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 offset = rest.position(v) - rest.centre();
    if (std::abs(offset.dot(normal)) > 1e-6 * rest.size()) return {};
    plane.push_back({offset.dot(x), offset.dot(y)});
  }
  return plane;
}

std::array<double, 4> fold_weights(const std::array<Vector2, 4>& q) {
  const Vector2 edge = q[1] - q[0];
  const double length = edge.norm();
  std::array<double, 4> weight{};  // of each height, in the sum of both triangles' slopes
  for (const std::size_t opposite : {2u, 3u}) {
    const Vector2 offset = q[opposite] - q[0];
    const double along = offset.dot(edge) / (length * length);
    const double away = std::abs(edge.x() * offset.y() - edge.y() * offset.x()) / length;
    weight[opposite] += 1 / away, weight[1] -= along / away, weight[0] -= (1 - along) / away;
  }
  return weight;
}

QuadraticForm fold(const std::array<Vector2, 4>& q) {
  const std::array<double, 4> weight = fold_weights(q);
  QuadraticForm sum{};
  for (std::size_t i = 1; i < 4; ++i) {
    const QuadraticForm z = height(q[i] - q[0]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight[i] * z[k];
  }
  return sum;
}

std::array<Vector2, 4> unfolded(const std::array<Vector3, 4>& p) {
  const Vector3 edge = p[1] - p[0];
  const double length = edge.norm();
  const auto laid = [&](const Vector3& at, double side) {
    const Vector3 offset = at - p[0];
    return Vector2(offset.dot(edge) / length, side * edge.cross(offset).norm() / length);
  };
  return {Vector2::Zero(), {length, 0}, laid(p[2], 1), laid(p[3], -1)};
}

UnitBend::UnitBend(const RestMesh& rest) : plane_(plane_coordinates(rest)) {
  if (plane_.empty())
    throw std::invalid_argument(
        fmt::format("the physical stiffness of springs is known for a flat rest shape only, and this mesh is "
                    "not flat: choose a model made of hinges ({}), or state the stiffness by k or compliance",
                    fmt::join(models_of_hinges(), ", ")));
  const std::vector<char> degenerate = triangles_without_area(rest.mesh());
  std::vector<TriangleBend> bends;
  for (int t = 0; t < rest.triangle_count(); ++t) {
    if (degenerate[static_cast<std::size_t>(t)] != 0) continue;
    const auto corner = rest.triangles().row(t);
    bends.push_back(triangle_bend({corner(0), corner(1), corner(2)}, plane_));
  }
  const Forms solution = least_strain(rest, plane_, bends);
  displacement_.resize(plane_.size());
  for (std::size_t v = 0; v < plane_.size(); ++v)
    for (std::size_t k = 0; k < 5; ++k)
      displacement_[v][k] = solution.block<2, 1>(2 * static_cast<int>(v), static_cast<int>(k));

  double area = 0, energy = 0;
  for (const TriangleBend& bend : bends) {
    Eigen::Matrix<double, 6, 5> w;
    for (int i = 0; i < 6; ++i)
      w.row(i) = solution.row(2 * bend.corner[static_cast<std::size_t>(i / 2)] + i % 2);
    const Eigen::Matrix<double, 3, 5> strain = bend.strain_of * w + bend.from_slope;
    area += bend.area;
    for (int e = 0; e < 3; ++e)
      energy += bend.area * 0.5 *
                mean_square({strain(e, 0), strain(e, 1), strain(e, 2), strain(e, 3), strain(e, 4)});
  }
  membrane_quartic_ = 4 * energy / area;
}

QuarticForm UnitBend::shortening(int a, int b) const {
  const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  const Vector2 offset = plane_[j] - plane_[i];
  const double length = offset.norm();
  const QuadraticForm from = height(plane_[i]), to = height(plane_[j]);
  const QuadraticForm rise = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  QuarticForm form = product(rise, rise);
  for (std::size_t k = 0; k < 5; ++k)
    form[k] = -(displacement_[j][k] - displacement_[i][k]).dot(offset) / length - form[k] / (2 * length);
  return form;
}

Vector2 UnitBend::displacement(int vertex, const Vector2& direction) const {
  QuarticForm x{}, y{};
  for (std::size_t k = 0; k < 5; ++k) {
    const Vector2& w = displacement_[static_cast<std::size_t>(vertex)][k];
    x[k] = w.x(), y[k] = w.y();
  }
  return {value_in(x, direction), value_in(y, direction)};
}

double mean_square(const QuarticForm& form) {
  // Means of c^(8-k) s^k over the circle: (7-k)!! (k-1)!! / 8!! for even k, and 0 for odd k.
  constexpr std::array<double, 5> even = {35.0 / 128, 5.0 / 128, 3.0 / 128, 5.0 / 128, 35.0 / 128};
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i % 2; j < 5; j += 2) sum += form[i] * form[j] * even[(i + j) / 2];
  return sum;
}

}  // namespace bendlab
