#include <cmath>

#include "bendlab/bending/rest_hinges.hpp"
#include "mine.hpp"

using namespace bendlab;

constexpr std::array fields = {
    field<&EdgeHinge::power>({.name = "power", .unit = "1", .meaning = "p of ½ k |e|^p θ²", .minimum = 0})};

BendingConstraints build(const EdgeHinge& settings, const BendingInput& input) {
  BendingConstraints constraints;
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins), HingeAngle::Law::angle,
                        [&](const RestHinge& hinge) { return std::pow(hinge.edge, -settings.power); });
  return constraints;
}

const BendingKind EdgeHinge::kind{
    .name = "edge_hinge",
    .label = "edge hinge",
    .summary = "the fold angle at every interior edge; stiffness is a power of the edge's length",
    .settings = table_of<EdgeHinge>(fields),
    .build = erased<build>};
