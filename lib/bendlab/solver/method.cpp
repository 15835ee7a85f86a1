#include "bendlab/solver/method.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "bendlab/solver/methods.hpp"

namespace bendlab {

namespace {

Registry<MethodKind>& registry() {
  static Registry<MethodKind> all("solver method", listed_methods);
  return all;
}

}  // namespace

std::span<const MethodKind* const> methods() {
  return registry().all();
}

const MethodKind* find_method(std::string_view name) {
  return registry().find(name);
}

void register_method(const MethodKind& kind) {
  registry().add(kind);
}

std::span<const MethodKind* const> added_methods() {
  return registry().added();
}

int projections_per_substep(const SimulationInput& input) {
  const auto sweeps = input.method.kind().sweeps_per_iteration;
  return input.settings.iterations * (sweeps != nullptr ? sweeps(input.method.settings()) : 1);
}

template <class Real>
std::unique_ptr<Simulation> make_simulation(const SimulationInput& input,
                                            std::vector<Pass<Real>> effect_passes) {
  const MakeSimulation<Real> make = input.method.kind().make<Real>();
  if (make == nullptr)
    throw std::invalid_argument(fmt::format("{}: is not available in {} precision", input.method.name(),
                                            std::is_same_v<Real, float> ? "single" : "double"));
  if (input.method.kind().mesh_order && !input.permutation.empty())
    throw std::invalid_argument(
        fmt::format("{}: keeps the mesh's order of vertices, so SimulationInput::permutation has to be empty",
                    input.method.name()));
  return make(input, std::move(effect_passes));
}

template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<float>>);
template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<double>>);

}  // namespace bendlab
