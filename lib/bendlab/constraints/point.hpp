// A vertex as four numbers: position and inverse mass, one load of 128 bits (float) or 256 bits (double).
#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "bendlab/constraints/large_array.hpp"

namespace bendlab {

template <class Real>
using Vector3Of = Eigen::Matrix<Real, 3, 1>;

template <class Real>
struct alignas(4 * sizeof(Real)) Point {
  Real x = 0, y = 0, z = 0, w = 0;

  Vector3Of<Real> vector() const { return {x, y, z}; }
  void set(const Vector3Of<Real>& v) { x = v.x(), y = v.y(), z = v.z(); }
};

template <class Real>
using Points = LargeArray<Point<Real>>;

/// The positions that projections change: `moved` if `base` is null, else base + moved (split places). Split
/// places have their inverse masses in `base`, and 0 in moved.w.
///
/// Single precision needs the sum: forces move a vertex by g h² in a substep, 10⁻¹⁰ m with 4096 substeps in
/// 1/60 s, far below the last digit of a position near 1 m. Constraints depend on differences. The difference
/// of two neighbours' bases is exact to the last digit of an edge, not of a position, and `moved`, which a
/// substep adds to it, keeps its own digits.
template <class Real>
struct Places {
  const Point<Real>* base = nullptr;
  Point<Real>* moved = nullptr;

  Places(Point<Real>* whole) : moved(whole) {}  // NOLINT: converts whole positions
  Places(const Point<Real>* at, Point<Real>* displacements) : base(at), moved(displacements) {}
};

/// For a function parameter from which Real is not deduced, so that an array of points converts to it.
template <class Real>
using PlacesOf = std::type_identity_t<Places<Real>>;

/// The index of a vertex's first number in an array of points. Batches store it instead of the vertex: a
/// processor scales an address by 4 or 8 for free, but not by the size of a point.
constexpr int offset_of(int vertex) {
  return 4 * vertex;
}

template <class Real>
Point<Real>& point_at(Point<Real>* points, int offset) {
  return *reinterpret_cast<Point<Real>*>(reinterpret_cast<Real*>(points) + offset);
}
template <class Real>
const Point<Real>& point_at(const Point<Real>* points, int offset) {
  return *reinterpret_cast<const Point<Real>*>(reinterpret_cast<const Real*>(points) + offset);
}

}  // namespace bendlab
