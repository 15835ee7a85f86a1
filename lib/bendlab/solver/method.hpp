// The interface of a solver method: what one step does to a cloth. A new method is one file in methods/, one
// line in methods.def, one test and one config. It declares here what it can simulate; the config's rules and
// scenes follow that.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bendlab/parameters/parameter.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// What holds the cloth together in its plane.
enum class Membrane {
  triangles,  ///< SimulationInput::strain
  edges,      ///< SimulationInput::edges, a spring along each
};

/// What a method factorises: a forecast of its memory needs to know.
enum class Factorised {
  nothing,
  scalars,  ///< once, a matrix with a number for each pair of neighbours
  blocks,   ///< in every iteration, one with a 3 by 3 block for each
};

/// A pass that a method adds to the plan, and why.
struct MethodPass {
  std::string_view name, why;
};

template <class Real>
using MakeSimulation = std::unique_ptr<Simulation> (*)(const SimulationInput&, std::vector<Pass<Real>>);

struct Method {
  std::string_view name;
  std::string_view summary;                       ///< one line: what a step does
  std::string_view source;                        ///< paper and equation
  std::string_view limits;                        ///< what it cannot do
  std::span<const Parameter> parameters = {};     ///< its own settings, beside the shared ones in /solver
  std::span<const std::string_view> shared = {};  ///< shared settings that it reads besides dt and threads
  std::span<const MethodPass> passes = {};        ///< besides "bending" and those of effects
  Membrane membrane = Membrane::triangles;
  Factorised factorised = Factorised::nothing;
  double vertex_seconds = 0;  ///< of CPU, of a vertex and iteration; 0: about that of projections
  bool springs_only = false;  ///< only takes bending models that are made of springs
  /// Why every stiffness has to be a compliance above 0; empty: it may also be k.
  std::string_view needs_compliance = {};
  /// Constraints are projected one after another. So effects may act between them, and springs may only push
  /// as hard as the projections of a substep can hold.
  bool projects = false;
  /// Effects that act between projections, and which the method takes although it does not project: after
  /// each of its iterations.
  std::span<const std::string_view> takes = {};
  int default_substeps = 0, default_iterations = 0;  ///< 0: what /solver says
  bool has_motion = true;       ///< a step goes on in time; else it goes towards an equilibrium
  bool steps_implicitly = false;  ///< its iterations go towards the minimum that implicit_step.hpp states
  bool keeps_momentum = false;  ///< only forces change Σ m v, except for rounding
  /// Its arrays have the vertices in the mesh's order: SimulationInput::permutation has to be empty, also for
  /// the effects.
  bool mesh_order = false;
  /// Single precision keeps the moves of a substep apart from the positions; else it rounds whole positions.
  bool keeps_moves_apart = false;
  MakeSimulation<float> make_float = nullptr;  ///< null: not in single precision
  MakeSimulation<double> make_double = nullptr;

  /// Null if the method does not come in that precision.
  template <class Real>
  MakeSimulation<Real> make() const {
    if constexpr (std::is_same_v<Real, float>)
      return make_float;
    else
      return make_double;
  }

  /// Whether the effect of that name acts in it. It must not be in the plan of a method that does not take
  /// it.
  bool takes_effect(std::string_view effect, bool needs_projection) const;

  /// Whether the setting of /solver of that name changes what it does.
  bool reads(std::string_view setting) const;
};

/// Every registered method, in the order of methods.def.
std::span<const Method* const> methods();

/// The method of that name, or nullptr.
const Method* find_method(std::string_view name);

/// The settings of the method's own table: those in settings.own, and defaults for the others. Throws
/// std::invalid_argument for a setting that the method does not have.
ParameterValues own_settings(const SimulationInput& input);

}  // namespace bendlab
