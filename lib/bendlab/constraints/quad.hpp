// The four numbers of a point as a vector type of the compiler (GCC, Clang): the same code for all
// processors.
#pragma once

#include <cstring>

#include "bendlab/constraints/point.hpp"

#define BENDLAB_INLINE inline __attribute__((always_inline))

namespace bendlab::detail {

template <class Real>
struct QuadType {
  typedef Real type __attribute__((vector_size(4 * sizeof(Real))));
};

template <class Real>
BENDLAB_INLINE typename QuadType<Real>::type load_point(const Point<Real>& point) {
  typename QuadType<Real>::type quad;
  std::memcpy(&quad, &point, sizeof(quad));
  return quad;
}

template <class Real>
BENDLAB_INLINE void store_point(Point<Real>& point, const typename QuadType<Real>::type& quad) {
  std::memcpy(static_cast<void*>(&point), &quad, sizeof(quad));
}

}  // namespace bendlab::detail
