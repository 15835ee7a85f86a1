// PositionBasedDynamics, bending method "Dihedral angle": C is the angle between the normals, and each
// projection removes the share k of C.
#include "experiments/dialects/projections.hpp"

namespace bendlab {

namespace {
constexpr std::array pbd_dihedral_arguments = {pbd_density, pbd_dt, pbd_iterations};
}

namespace dialect {
extern const Dialect pbd_dihedral{
    .name = "pbd_dihedral",
    .engine = "PositionBasedDynamics, DihedralConstraint",
    .setting = {.name = "k", .unit = "1", .meaning = "cloth_bendingStiffness (default 0.01)", .most = 1},
    .arguments = pbd_dihedral_arguments,
    .rule = "B = 0.141 n (k + k²/2) ρ a⁴ / dt²",
    .cell_power = 4,
    .depends =
        "the time step (∝ 1/dt²), iterations (∝ n) and masses (the library's default is 1 kg per vertex)",
    .limits = pbd_limits,
    .source =
        "InteractiveComputerGraphics/PositionBasedDynamics d0894bd (2025-09): PositionBasedDynamics/"
        "PositionBasedDynamics.cpp, solve_DihedralConstraint(); Simulation/TimeStepController.cpp",
    .stiffness = projection_stiffness,
    .factor = [](double k, const DialectNumbers&) { return sweep_factor(k); },
    .value = [](double factor, const DialectNumbers&) { return share_of(factor); }};
}  // namespace dialect
}  // namespace bendlab
