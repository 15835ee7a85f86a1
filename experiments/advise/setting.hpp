// What advice is about: a bending model, a solver with its work, and a mesh. What the cloth is, what holds it
// and what acts on it stay as the config has them.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

struct Setting {
  std::string model, method;
  std::string solver = "{}";  ///< further settings of the method, as JSON
  int substeps = 1, iterations = 1;
  int cells = 0;  ///< /mesh/cells; 0: the config's own mesh

  auto operator<=>(const Setting&) const = default;
};

/// Whether they differ in substeps and iterations only.
bool same_kind(const Setting& a, const Setting& b);

/// Substeps × iterations.
double work_of(const Setting& setting);

/// The setting with about `factor` times its work: more substeps if the method projects constraints, else
/// more iterations; at least 1 of them.
Setting with_work(Setting setting, double factor);

/// Settings that were the best of a measured scene (fronts.def); `cells` is 0.
const std::vector<Setting>& measured_fronts();

/// The methods in it, in its order.
std::vector<std::string> advised_methods();

/// "levels 12", "membrane auto, integrator bdf2".
std::string solver_text(const Setting& setting);

/// "dihedral, pbd (levels 12), 8 substeps, 1 iteration, 24 cells".
std::string setting_text(const Setting& setting);

}  // namespace bendlab
