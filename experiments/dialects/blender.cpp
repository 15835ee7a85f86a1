// Blender's cloth, bending model Angular. A fold by θ pushes each triangle along its normal with the force
// F = 0.1 bending L θ, equally divided among its three corners, and pulls the edge back. The wing vertex thus
// gets F/3, and a hinge of stiffness k gives it k θ / h: so k = 0.1 bending L h / 3. Blender's unit of time
// makes gravity 0.001 times the scene's, so its forces are 1000 times as large in N.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace dialect {
extern const Dialect blender{
    .name = "blender",
    .engine = "Blender, cloth with the bending model Angular",
    .setting = {.name = "bending", .unit = "1000 N/m", .meaning = "Bending of Stiffness (default 0.5)"},
    .rule = "B = 25 bending a² N/m",
    .cell_power = 2,
    .limits =
        "for a mesh of triangles: in a quad the force is divided among four corners. Two triangles of "
        "different height get a net torque from their hinge, so B is exact for equal triangles, "
        "otherwise it is a mean. B is relative to Blender's gravity of 9.81 m/s²; its clock runs at "
        "31.6 frames per second. Blender's mass is per vertex. The bending model Linear (springs of Choi "
        "and Ko) has no rigidity in a flat sheet",
    .source =
        "blender/blender: source/blender/simulation/intern/SIM_mass_spring.cc at 01eb06e, "
        "cloth_calc_spring_force() and cloth_calc_force(); implicit_blender.cc at d973355, "
        "SIM_mass_spring_force_spring_angular()",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers&) {
      constexpr double force_unit = 1000;  // N, from the factor 0.001 of gravity
      return force_unit * 0.1 * hinge.edge * hinge.height / 3;
    }};
}  // namespace dialect
}  // namespace bendlab
