// PositionBasedDynamics, bending method "Isometric bending": C is the quadratic bending energy ½ q θ².
// Because C ∇C / |∇C|² = ½ θ ∂θ/∂x / |∂θ/∂x|², a projection removes the share k/2 of θ, whatever q is.
#include "experiments/dialects/projections.hpp"

namespace bendlab {

namespace {
constexpr std::array pbd_isometric_arguments = {pbd_density, pbd_dt, pbd_iterations};
}

namespace dialect {
extern const Dialect pbd_isometric{
    .name = "pbd_isometric",
    .engine = "PositionBasedDynamics, IsometricBendingConstraint",
    .setting = {.name = "k", .unit = "1", .meaning = "cloth_bendingStiffness (default 0.01)", .most = 1},
    .arguments = pbd_isometric_arguments,
    .rule = "B = 0.0703 n (k + k²/4) ρ a⁴ / dt²",
    .cell_power = 4,
    .depends =
        "the time step (∝ 1/dt²), iterations (∝ n) and masses (the library's default is 1 kg per vertex)",
    .limits =
        "for bends much wider than a cell that swing slowly compared with the time step; narrower bends "
        "are stiffer. A hinge that is almost flat (Σ w |∇C|² below 1e-6) is not projected. The hinges "
        "have no rest angle",
    .source =
        "InteractiveComputerGraphics/PositionBasedDynamics d0894bd (2025-09): PositionBasedDynamics/"
        "PositionBasedDynamics.cpp, init_ and solve_IsometricBendingConstraint()",
    .stiffness = projection_stiffness,
    .factor = [](double k, const DialectNumbers&) { return sweep_factor(k / 2); },
    .value = [](double factor, const DialectNumbers&) { return 2 * share_of(factor); }};
}  // namespace dialect
}  // namespace bendlab
