// libuipc, DiscreteShellBending. The documented energy density κ θ² L / h, with h = (A1 + A2) / (3 L), is
// multiplied by the volume (A1 + A2) t, t: the thickness attribute. So a hinge has the energy 3 κ t L² θ².
// Without the volume, which the documentation does not mention, B would be 6 κ.
#include "experiments/dialects/dialect.hpp"

namespace bendlab {

namespace {
constexpr std::array libuipc_arguments = {DialectSetting{
    .name = "thickness", .unit = "m", .meaning = "the thickness of the vertices", .standard = 0.001}};
}

namespace dialect {
extern const Dialect libuipc{
    .name = "libuipc",
    .engine = "libuipc, DiscreteShellBending",
    .setting = {.name = "kappa",
                .unit = "Pa",
                .meaning = "bending_stiffness of apply_to() (default 100 kPa)"},
    .arguments = libuipc_arguments,
    .rule = "B = 5.20 κ t a²",
    .cell_power = 2,
    .depends = "the shell's thickness t",
    .limits =
        "libuipc documents κ θ² L / h as an energy density, and its code multiplies it by a volume, hence "
        "the "
        "dependence on cell size and thickness. Without the volume B would be 6 κ",
    .source =
        "spiriMirror/libuipc 619a541 (2026-07): src/backends/cuda/finite_element/constitutions/"
        "discrete_shell_bending.cu (energy times V_bar), discrete_shell_bending_function.h; default "
        "thickness: include/uipc/constitution/neo_hookean_shell.h",
    .stiffness = [](const MeshHinge& hinge, const DialectNumbers& arguments) {
      return 6 * arguments.at("thickness") * hinge.edge * hinge.edge;
    }};
}  // namespace dialect
}  // namespace bendlab
