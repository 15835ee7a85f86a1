// No bending: the control.
#include "bendlab/bending/models.hpp"

namespace bendlab {

constinit const BendingKind None::kind{
    .name = "none",
    .label = "no bending",
    .summary = "no bending constraints; the control beside every other model",
    .source = "control",
    .limits = "resists no bending, but for what the membrane resists by itself on some meshes",
    .compliance = "no constraints",
    .settings = table_of<None>({}),
    .bends = false,
    .springs_only = true,
    .build = [](const void*, const BendingInput&) { return BendingConstraints{}; },
};

}  // namespace bendlab
