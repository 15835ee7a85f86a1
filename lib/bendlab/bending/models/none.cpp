// No bending: the control.
#include "bendlab/bending/model.hpp"

namespace bendlab::models {

extern constinit const BendingModel none{
    .name = "none",
    .label = "no bending",
    .summary = "no bending constraints; the control beside every other model",
    .source = "control",
    .limits = "resists no bending, but for what the membrane resists by itself on some meshes",
    .compliance = "no constraints",
    .parameters = {},
    .springs_only = true,
    .build = [](const BendingInput&) { return BendingConstraints{}; },
    .expect = [](const ExpectedMesh&, const ParameterValues&) { return ExpectedConstraints{}; },
};

}  // namespace bendlab::models
