// PositionBasedDynamics, bending method "Isometric bending (XPBD)": XPBD with the compliance 1 / stiffness
// and the constraint C = -¾ L² θ² / (A1 + A2). The energy ½ stiffness C² is ¼ c θ⁴ with c = (9/8) stiffness
// L⁴ / (A1 + A2)². So a flat sheet has no rigidity.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace {
constexpr std::array xpbd_isometric_arguments = {DialectSetting{
    .name = "curvature", .unit = "1/m", .meaning = "the curvature at which the sheet has the rigidity B"}};
}

namespace dialect {
extern const Dialect xpbd_isometric{
    .name = "xpbd_isometric",
    .engine = "PositionBasedDynamics, IsometricBendingConstraint_XPBD",
    .setting = {.name = "stiffness", .unit = "N m", .meaning = "cloth_bendingStiffness (default 0.01)"},
    .arguments = xpbd_isometric_arguments,
    .rule = "B = 0.686 stiffness a² κ² at the curvature κ",
    .cell_power = 2,
    .depends = "the curvature κ (the moment is ∝ κ³), and iterations: B is reached when XPBD has converged",
    .limits = "flat cloth has no rigidity. The hinges have no rest angle",
    .source =
        "InteractiveComputerGraphics/PositionBasedDynamics d0894bd (2025-09): PositionBasedDynamics/"
        "XPBD.cpp, solve_IsometricBendingConstraint(); Simulation/SimulationModel.cpp (defaults)",
    .stiffness =
        [](const MeshHinge& hinge, const DialectNumbers&) {
          const double ratio = hinge.edge * hinge.edge / hinge.area;
          return 1.125 * ratio * ratio;
        },
    .cubic = true};
}  // namespace dialect
}  // namespace bendlab
