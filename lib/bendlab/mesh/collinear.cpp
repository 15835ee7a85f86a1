#include "bendlab/mesh/collinear.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace bendlab {

bool exactly_collinear(const Vector3& a, const Vector3& b, const Vector3& c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  return CGAL::collinear(Point(a.x(), a.y(), a.z()), Point(b.x(), b.y(), b.z()), Point(c.x(), c.y(), c.z()));
}

bool collinear_within(double thickness, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const double twice_area = (b - a).cross(c - a).norm();
  return twice_area <= thickness * longest;
}

}  // namespace bendlab
