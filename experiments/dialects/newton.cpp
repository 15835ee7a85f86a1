// Newton, solver VBD. Energy of a hinge: ½ edge_ke L θ², L: length of the edge at rest. The heights of the
// triangles do not occur, so the same edge_ke is half as stiff on cells of half the size.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect newton{
    .name = "newton",
    .engine = "Newton, SolverVBD",
    .setting = {.name = "edge-ke", .unit = "N", .meaning = "edge_ke of add_cloth_mesh() (default 100)"},
    .rule = "B = 0.866 edge_ke a",
    .cell_power = 1,
    .depends = "iterations: B is reached when VBD has converged",
    .limits =
        "Newton documents edge_ke in N m/rad, but SolverVBD multiplies it by the edge's length. Its "
        "other solvers give the same edge_ke other meanings: newton_semi_implicit, newton_xpbd",
    .source =
        "newton-physics/newton 41a5392 (2026-08): newton/_src/solvers/vbd/particle_vbd_kernels.py, "
        "evaluate_dihedral_angle_based_bending_force_hessian()",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers&) { return hinge.edge; }};
}  // namespace dialect
}  // namespace bendlab
