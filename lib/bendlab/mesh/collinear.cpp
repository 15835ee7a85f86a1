#include "bendlab/mesh/collinear.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace bendlab {

bool exactly_collinear(const Vector3& a, const Vector3& b, const Vector3& c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  return CGAL::collinear(Point(a.x(), a.y(), a.z()), Point(b.x(), b.y(), b.z()), Point(c.x(), c.y(), c.z()));
}

}  // namespace bendlab
