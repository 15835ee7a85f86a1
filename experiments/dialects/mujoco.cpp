// MuJoCo, flex with elastic2d "bend" or "both". The quadratic bending energy of Garg et al. 2007 with the
// coefficient μ t³ / (8 (A1 + A2)), μ = E / (2 (1 + ν)). A hinge folded by θ has |Σ c x| = L θ, hence
// ½ μ t³ L² θ² / (8 (A1 + A2)). This is B = E t³ / (16 (1 + ν)) = 0.75 (1 - ν) D, D: rigidity of the plate.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace {
constexpr std::array mujoco_arguments = {
    DialectSetting{.name = "thickness", .unit = "m", .meaning = "thickness of the flex"},
    DialectSetting{.name = "poisson",
                   .unit = "1",
                   .meaning = "Poisson's ratio of the flex",
                   .standard = 0,
                   .may_equal = true,
                   .most = 0.5}};
}

namespace dialect {
extern const Dialect mujoco{
    .name = "mujoco",
    .engine = "MuJoCo, 2D flex with elastic2d bend or both",
    .setting = {.name = "young", .unit = "Pa", .meaning = "young of the flex's elasticity"},
    .arguments = mujoco_arguments,
    .rule = "B = 0.75 (1 - ν) D, D = E t³ / 12 (1 - ν²)",
    .depends = "thickness t and Poisson's ratio ν",
    .limits = "trilinear and quadratic flexes bend by another formula",
    .source =
        "google-deepmind/mujoco a725507 (2026-08): src/user/user_mesh.cc, ComputeBending(); "
        "src/engine/engine_passive.c, mj_flexPassiveBend()",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers& arguments) {
      const double t = arguments.at("thickness"), shear_of_young = 0.5 / (1 + arguments.at("poisson"));
      return shear_of_young * t * t * t * hinge.edge * hinge.edge / (8 * hinge.area);
    }};
}  // namespace dialect
}  // namespace bendlab
