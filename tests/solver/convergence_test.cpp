// What the coloured order costs: sweeps until its strain error is that of the mesh order.
#include "experiments/bench/convergence.hpp"

#include <array>
#include <string>

#include "tests/catch.hpp"

namespace bendlab {

// Once errors are smooth, Gauss-Seidel by colour and in list order contract alike (Young 1954 for two
// colours, Adams & Jordan, "Is SOR color-blind?", 1986, for more). What differs is how far a correction gets
// in one sweep: in list order across the whole sheet, where the list runs its way; by colour over a few
// edges, at least one, because every constraint acts after another one that shares a vertex with it, or
// before. So list order has a head start of at most the sweeps in which colours carry a correction across: as
// many as there are edges along the sheet.
TEST_CASE("the coloured order leaves the strain error of the mesh order a sheet's crossing later",
          "[solver]") {
  constexpr std::array sweeps = {1, 5, 10, 20};
  for (const ConvergenceScene& scene : convergence_scenes()) {
    std::string report = "strain error by colour / in mesh order, " + std::string(scene.name) + ":";
    for (const ConvergenceError& error : convergence_errors(scene, sweeps)) {
      report += " " + std::to_string(error.colour / error.mesh) + " after " + std::to_string(error.sweeps) +
                " sweeps (matched after " + std::to_string(error.sweeps_to_match) + ");";
      INFO(report);
      CHECK(error.sweeps_to_match > 0);
      CHECK(error.sweeps_to_match <= error.sweeps + convergence_cells);
    }
    WARN(report);
  }
}

}  // namespace bendlab
