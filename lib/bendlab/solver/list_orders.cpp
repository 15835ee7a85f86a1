#include "bendlab/solver/list_orders.hpp"

#include "bendlab/solver/colouring.hpp"

namespace bendlab {

ListOrders::ListOrders(const SimulationInput& input)
    : strain(list_order(input.strain.size())), distance(list_order(input.distance.size())) {
  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    elements[kind_index<Kind>] = list_order(list.size());
  });
}

}  // namespace bendlab
