// Newton, solver XPBD. The compliance of C = θ is 1 / edge_ke, but the vectors used as gradients are ∂θ/∂x
// times twice the triangle's area. With equal triangles the converged force -edge_ke C g is that of a hinge
// of stiffness edge_ke (A1 + A2).
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect newton_xpbd{
    .name = "newton_xpbd",
    .engine = "Newton, SolverXPBD",
    .setting = {.name = "edge-ke", .unit = "N/m", .meaning = "edge_ke of add_cloth_mesh() (default 100)"},
    .rule = "B = 0.75 edge_ke a²",
    .cell_power = 2,
    .depends = "iterations: B is reached when XPBD has converged",
    .limits =
        "two triangles of different area get a net torque from their hinge, so no energy belongs to "
        "this force; B is exact for equal triangles, otherwise it is a mean",
    .source =
        "newton-physics/newton 41a5392 (2026-08): newton/_src/solvers/xpbd/kernels.py, "
        "bending_constraint()",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers&) { return hinge.area; }};
}  // namespace dialect
}  // namespace bendlab
