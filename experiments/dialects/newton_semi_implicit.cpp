// Newton, solver SemiImplicit. The force on a vertex is -edge_ke L θ g. A wing vertex has g = normal times L,
// where ∂θ/∂x is the normal divided by the triangle's height. So g is ∂θ/∂x times twice the triangle's area.
// With equal triangles this is the force of a hinge of stiffness edge_ke L (A1 + A2).
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect newton_semi_implicit{
    .name = "newton_semi_implicit",
    .engine = "Newton, SolverSemiImplicit and SolverFeatherstone",
    .setting = {.name = "edge-ke", .unit = "N/m²", .meaning = "edge_ke of add_cloth_mesh() (default 100)"},
    .rule = "B = 0.75 edge_ke a³",
    .cell_power = 3,
    .limits =
        "two triangles of different area get a net torque from their hinge, so no energy belongs to "
        "this force; B is exact for equal triangles, otherwise it is a mean",
    .source =
        "newton-physics/newton 41a5392 (2026-08): newton/_src/solvers/semi_implicit/"
        "kernels_particle.py, eval_bending()",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers&) { return hinge.edge * hinge.area; }};
}  // namespace dialect
}  // namespace bendlab
