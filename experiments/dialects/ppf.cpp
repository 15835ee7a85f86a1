// ppf-contact-solver, shells. Energy of a hinge: ½ 1.28e-5 bend ρ L² θ² / (A1 + A2), ρ: mass per area. The
// factor L² / area makes B independent of the cells, and ρ makes the drape independent of the density.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace {
constexpr std::array ppf_arguments = {
    DialectSetting{.name = "density", .unit = "kg/m²", .meaning = "the shell's density", .standard = 1.0}};
}

namespace dialect {
extern const Dialect ppf{
    .name = "ppf",
    .engine = "ppf-contact-solver, triangle shell",
    .setting = {.name = "bend", .unit = "1.28e-5 m⁴/s²", .meaning = "bend of a shell (default 10)"},
    .arguments = ppf_arguments,
    .rule = "B = 1.28e-5 bend ρ",
    .depends = "the density ρ",
    .limits = "bend-warp and bend-weft, which add stiffness by direction, are taken as 0",
    .source =
        "st-tech/ppf-contact-solver f23b356 (2026-08): crates/ppf-cts-solver/src/cpp/energy/energy.cu, "
        "embed_hinge_force_hessian(); defaults: crates/ppf-cts-core/src/datamodel/params.rs",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers& arguments) {
      constexpr double scale = 1.28e-5;  // BEND_SCALE of energy.cu, m⁴/s²
      return scale * arguments.at("density") * hinge.edge * hinge.edge / hinge.area;
    }};
}  // namespace dialect
}  // namespace bendlab
