// A vertex as four numbers in one 128-bit (float) or 256-bit (double) load: position and inverse mass.
#pragma once

#include <Eigen/Core>
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
