// Position Based Dynamics (Müller et al. 2007): C is the angle between the normals, and a projection removes
// the share k' = 1 - (1 - k)^(1/n) of C, so that n projections of one hinge alone remove k.
#include "experiments/dialects/projections.hpp"

namespace bendlab {

namespace {
constexpr std::array mueller_arguments = {pbd_density, pbd_dt, pbd_iterations};
}

namespace dialect {
extern const Dialect mueller{
    .name = "mueller",
    .engine = "Position Based Dynamics, k of the paper",
    .setting = {.name = "k", .unit = "1", .meaning = "the bending stiffness k", .most = 1},
    .arguments = mueller_arguments,
    .rule = "B = 0.141 n (k' + k'²/2) ρ a⁴ / dt², k' = 1 - (1 - k)^(1/n)",
    .cell_power = 4,
    .depends = "the time step (∝ 1/dt²), masses, and iterations n (little: for small k, n k' is about k)",
    .limits = pbd_limits,
    .source = "Müller, Heidelberger, Hennix and Ratcliff 2007, Position Based Dynamics, §3.3 (k'), §4.1",
    .stiffness = projection_stiffness,
    .factor =
        [](double k, const DialectNumbers& arguments) {
          return sweep_factor(1 - std::pow(1 - k, 1 / arguments.at("iterations")));
        },
    .value =
        [](double factor, const DialectNumbers& arguments) {
          const double share = share_of(factor);
          return share <= 1 ? 1 - std::pow(1 - share, arguments.at("iterations")) : std::nan("");
        }};
}  // namespace dialect
}  // namespace bendlab
