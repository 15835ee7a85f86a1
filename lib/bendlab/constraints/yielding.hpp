// Elements that yielded in a step keep a set: their rest values follow their values (moment_law.hpp).
#pragma once

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Whether any element can yield.
bool can_yield(const ElementLists& lists);

/// Moves the rest values of elements whose |C| is beyond their yield in these positions (#P by 3, m), so that
/// |C| is the yield after hardening. The force of an element does not change. Returns the number of such
/// elements.
std::size_t yield_to(ElementLists& lists, const Positions& positions);

/// The same for batches and the points of a solver.
template <class Real>
std::size_t yield_to(ElementBatches<Real>& batches, const Point<Real>* points);

}  // namespace bendlab
