// A vertex as four numbers in one 128-bit (float) or 256-bit (double) load: position and inverse mass.
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

/// Where the vertices are, for projections. `moved` alone where `base` is null; else base + moved, and
/// projections change `moved`. Inverse masses stand in `base` then, and 0 in moved.w.
///
/// The sum is what single precision needs: forces move a vertex by g h² in a substep, 10⁻¹⁰ m with 4096
/// substeps, far below the last digit of a position near 1 m. Constraints depend on differences, and that of
/// two neighbours' bases is exact to the last digit of an edge, not of a position; what a substep adds to it
/// is kept apart, to its own last digit.
template <class Real>
struct Places {
  const Point<Real>* base = nullptr;
  Point<Real>* moved = nullptr;

  Places(Point<Real>* whole) : moved(whole) {}  // NOLINT: positions are places
  Places(const Point<Real>* at, Point<Real>* displacements) : base(at), moved(displacements) {}
};

/// Of a parameter from which Real is not deduced, so that an array of points will do.
template <class Real>
using PlacesOf = std::type_identity_t<Places<Real>>;

/// Where a vertex stands in an array of points, counted in numbers. Batches store this instead of the vertex:
/// a processor scales an address by 4 or 8 on the way, but not by the size of a point.
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
