// No bending: the control.
#include "bendlab/bending/models.hpp"

namespace bendlab {

constinit const BendingKind None::kind{
    .name = "none",
    .label = "no bending",
    .summary = "no bending constraints, for comparison with other models",
    .source = "control",
    .limits = "does not resist bending, except that on some meshes the membrane itself does",
    .compliance = "no constraints",
    .settings = table_of<None>({}),
    .bends = false,
    .springs_only = true,
    .build = [](const void*, const BendingInput&) { return BendingConstraints{}; },
};

}  // namespace bendlab
