// A vertex as four numbers in one 128-bit (float) or 256-bit (double) load: position and inverse mass.
#pragma once

#include <Eigen/Core>
#include <vector>

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
using Points = std::vector<Point<Real>>;

}  // namespace bendlab
