// The cost of the coloured order: how many more sweeps it needs than the mesh order for the same strain
// error.
#include "experiments/bench/convergence.hpp"

#include <array>
#include <string>

#include "tests/catch.hpp"

namespace bendlab {

// Once errors are smooth, Gauss-Seidel by colour and in list order converge at the same rate (Young 1954 for
// two colours; Adams & Jordan, "Is SOR color-blind?", 1986, for more colours). The difference is how far a
// correction travels in one sweep. In list order it can cross the whole sheet, in the direction of the list.
// By colour it crosses a few edges, at least one, because of any two constraints that share a vertex one acts
// after the other. So list order has a head start of at most as many sweeps as there are edges along the
// sheet.
TEST_CASE("the coloured order reaches the strain error of the mesh order within the sweeps to cross a sheet",
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
