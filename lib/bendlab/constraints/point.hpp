// A vertex as four numbers: position and inverse mass. One load takes all 128 bits (float) or 256 bits
// (double).
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

/// The positions that projections change: `moved` if `base` is null. If `base` is not null, the places are
/// split: the positions are base + moved, the inverse masses are in base.w, and moved.w is 0.
///
/// Single precision needs split places. With 4096 substeps in 1/60 s, gravity moves a vertex by g h² = 10⁻¹⁰
/// m in a substep, far below the last digit of a position near 1 m. Constraints depend on differences of
/// positions. The rounding error of the difference of two neighbours' bases is that of an edge's length,
/// which is smaller than that of a position. `moved` is small and has digits of its own.
template <class Real>
struct Places {
  const Point<Real>* base = nullptr;
  Point<Real>* moved = nullptr;

  Places(Point<Real>* whole) : moved(whole) {}  // NOLINT: converts whole positions
  Places(const Point<Real>* at, Point<Real>* displacements) : base(at), moved(displacements) {}
};

/// For a function parameter from which Real is not deduced, so that an array of points converts to Places.
template <class Real>
using PlacesOf = std::type_identity_t<Places<Real>>;

/// The index of a vertex's first number in an array of points. Batches store this index instead of the
/// vertex, because a processor multiplies an index by 4 or 8 at no cost, but not by the size of a point.
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
