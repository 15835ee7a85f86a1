#include "bendlab/solver/method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace bendlab {

namespace method {
#define BENDLAB_METHOD(name) extern const Method name;
#include "bendlab/solver/methods.def"
#undef BENDLAB_METHOD
}  // namespace method

std::span<const Method* const> methods() {
  static constexpr std::array all = {
#define BENDLAB_METHOD(name) &method::name,
#include "bendlab/solver/methods.def"
#undef BENDLAB_METHOD
  };
  return all;
}

const Method* find_method(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, &Method::name);
  return found == methods().end() ? nullptr : *found;
}

const Method& default_method() {
  return *methods().front();
}

bool Method::reads(std::string_view setting) const {
  return setting == "method" || setting == "dt" || setting == "threads" ||
         std::ranges::find(shared, setting) != shared.end() ||
         std::ranges::find(parameters, setting, &Parameter::name) != parameters.end();
}

bool Method::takes_effect(std::string_view effect, bool needs_projection) const {
  return projects || !needs_projection || std::ranges::find(takes, effect) != takes.end();
}

ParameterValues own_settings(const SimulationInput& input) {
  const Method& method = *input.method;
  ParameterValues values(method.parameters);
  for (const auto& [name, value] : input.settings.own.all()) {
    if (std::ranges::find(method.parameters, name, &Parameter::name) == method.parameters.end())
      throw std::invalid_argument(fmt::format("{}: has no setting {}", method.name, name));
    values.set(name, value);
  }
  return values;
}

template <class Real>
std::unique_ptr<Simulation> make_simulation(const SimulationInput& input,
                                            std::vector<Pass<Real>> effect_passes) {
  const MakeSimulation<Real> make = input.method->make<Real>();
  if (make == nullptr)
    throw std::invalid_argument(fmt::format("{}: does not come in {} precision", input.method->name,
                                            std::is_same_v<Real, float> ? "single" : "double"));
  if (input.method->mesh_order && !input.permutation.empty())
    throw std::invalid_argument(fmt::format("{}: keeps the mesh's order, so that no vertex may be permuted",
                                            input.method->name));
  return make(input, std::move(effect_passes));
}

template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<float>>);
template std::unique_ptr<Simulation> make_simulation(const SimulationInput&, std::vector<Pass<double>>);

}  // namespace bendlab
