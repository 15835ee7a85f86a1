// Scenes and settings for the tests of implicit steps.
#pragma once

#include "bendlab/solver/method.hpp"
#include "tests/support.hpp"

namespace bendlab::test {

// Models whose energy has a gradient everywhere. The compliance is 1 / stiffness for springs and 1 / rigidity
// for hinges.
struct SmoothModel {
  std::string_view name;
  double compliance;
};
inline const std::vector<SmoothModel> smooth_models = {
    {"none", 1},
    {"crossover", 0.1},
    {"k_ring", 0.2},
    {"adaptive", 0.2},
    {"lod", 0.2},
    {"sparse_lod", 1},
    {"dihedral", 100},
    {"discrete_shells", 100},
    {"bridson", 100},
    {"isometric", 100},
    {"mid_edge", 100},
    {"mid_edge_average", 100},
    {"corotational_face", 100},
    {"corotational_edge", 100},
    {"laplacian", 100},
};

inline SimulationInput compliant(SimulationInput input, std::string_view method, double strain,
                                 double bending) {
  input.strain_stiffness = {
      .form = StrainForm::angle, .kind = StiffnessKind::compliance, .compliance = strain};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = bending};
  input.method = Method(*find_method(method));
  return input;
}

inline void disturb(SimulationInput& input, double size) {
  std::mt19937_64 random(11);
  for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
    input.positions.row(v) += random_vector(random, size).transpose();
}

/// A simulation with steps of h. Iterations end once no vertex moves by more than `tolerance` sizes of the
/// cloth.
template <class Real = double>
std::unique_ptr<Simulation> implicit_steps(SimulationInput input, std::string_view method,
                                           std::string_view integrator, double h,
                                           std::vector<Pass<Real>> passes, int iterations,
                                           double tolerance = 1e-12) {
  input.settings.dt = h, input.settings.substeps = 1, input.settings.iterations = iterations;
  Changes changes = {{"integrator", std::string(integrator)}, {"tolerance", tolerance}};
  if (method == "quasi_newton")
    changes.insert(changes.end(), {{"membrane", std::string("stated")}, {"history", std::int64_t{10}}});
  input.method = chosen(*find_method(method), changes);
  return make_simulation<Real>(input, std::move(passes));
}

}  // namespace bendlab::test
