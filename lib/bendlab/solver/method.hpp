// The interface of a solver method, which takes one step of a cloth. A new method is a struct in methods.hpp,
// one file in methods/, one test and one config. Its MethodKind declares what the method can simulate, and
// the rules of scenes follow from that.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/parameters/field.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// What holds the cloth together in its plane.
enum class Membrane {
  triangles,  ///< SimulationInput::strain
  edges,      ///< SimulationInput::edges, a spring along each
};

/// The matrix that a method factorises. Forecasts of memory depend on it.
enum class Factorised {
  nothing,
  scalars,  ///< once: a matrix with a scalar for each pair of neighbours
  blocks,   ///< in every iteration: a matrix with a 3 by 3 block for each pair of neighbours
};

/// A pass that a method adds to the plan, and the reason for it.
struct MethodPass {
  std::string_view name, why;
};

/// A run whose steps did not converge, for the text of its warning.
struct UnconvergedRun {
  bool touches = false;  ///< the cloth may touch an obstacle
  bool has_strain = false;
};

/// A run that diverged, or broke a bound of its scene, for the choice of remedies.
struct FailedRun {
  const SimulationInput& input;
  bool fell_wrong = false;  ///< free cloth that did not fall as its forces demand; else it flew apart
  bool single_precision = false;
  bool is_pinned = false;
  bool helps_projection = false;  ///< the scene lists an effect with EffectKind::helps_projection
  bool is_prestressed = false;    ///< springs are longer at rest than the distance of their vertices
};

template <class Real>
using MakeSimulation = std::unique_ptr<Simulation> (*)(const SimulationInput&, std::vector<Pass<Real>>);

/// A MakeSimulation that passes its arguments to the constructor of `Step`.
template <class Step, class Real>
std::unique_ptr<Simulation> make_step(const SimulationInput& input, std::vector<Pass<Real>> effect_passes) {
  return std::make_unique<Step>(input, std::move(effect_passes));
}

enum class ConstraintOrder {
  colour,  ///< by colour, in lanes and threads side by side
  mesh,    ///< in the order of the lists, one after another, by the oracle
  pins,    ///< like mesh, with lists that order_from_pins() has sorted
};

/// A solver method: its traits, and the functions that make a simulation.
struct MethodKind {
  std::string_view name;
  std::string_view summary;                 ///< one line: what a step does
  std::string_view source;                  ///< paper and equation
  std::string_view limits;                  ///< what it cannot do
  FieldTable settings;                      ///< its own settings; SolverSettings has the shared settings
  std::span<const MethodPass> passes = {};  ///< besides "bending" and the passes of effects
  Membrane membrane = Membrane::triangles;
  Factorised factorised = Factorised::nothing;
  /// The time of an iteration, relative to projecting each constraint once. Approximate, for forecasts.
  double cost = 1;
  bool springs_only = false;        ///< only takes bending models that are made of springs
  bool takes_own_elements = false;  ///< takes elements whose function the program brings
  /// Why every stiffness has to be a compliance above 0. Empty: stiffness may also be given as k.
  std::string_view needs_compliance = {};
  /// Whether constraints are projected one after another. If so, effects may act between projections, and
  /// springs may push only as hard as the projections of a substep can hold.
  bool projects = false;
  /// For a method that does not project: whether it takes effects that act between projections. They then act
  /// after each iteration, if they can (EffectKind::acts_in_iterations).
  bool takes_effects_in_iterations = false;
  int default_substeps = 0, default_iterations = 0;  ///< 0: it does not read the setting
  bool has_motion = true;         ///< steps simulate motion; else they approach an equilibrium
  bool steps_implicitly = false;  ///< its iterations approach the minimum that implicit_step.hpp states
  bool keeps_momentum = false;    ///< only forces and rounding change Σ m v
  /// Its arrays have the vertices in the mesh's order, so SimulationInput::permutation has to be empty, also
  /// for the effects.
  bool mesh_order = false;
  /// Whether single precision keeps the moves of a substep apart from the positions; else it rounds whole
  /// positions.
  bool keeps_moves_apart = false;
  /// Projections of each constraint in an iteration; null: 1.
  int (*sweeps_per_iteration)(const void* settings) = nullptr;
  /// Whether something beside the constraints resists stretch, equally in all directions; null: never.
  bool (*carries_stretch)(const void* settings) = nullptr;
  /// How far the cloth at rest may move because the membrane is softened, as a share of the cloth's size; 0:
  /// the membrane is as stated. Null: always 0.
  double (*membrane_error)(const void* settings) = nullptr;
  /// Iterations that a substep needs to follow the motion, per C², the square of the membrane's Courant
  /// number; 0: the number of iterations does not depend on C.
  double iterations_per_courant = 0;
  /// Steps lag behind the motion if they leave forces unbalanced that exceed this multiple of the effects'
  /// forces. The second limit holds where cloth touches something.
  double residual_of_lag = 2, residual_of_lag_on_obstacle = 1;
  /// A sentence on what helped against such lag in tests; null: more iterations.
  std::string (*remedy_of_lag)(const void* settings, const UnconvergedRun&) = nullptr;
  /// Changes that helped such a run in trials, with numbers; null: nothing was tried.
  std::vector<std::string> (*remedies)(const void* settings, const FailedRun&) = nullptr;
  /// Sorts the scene's lists before a simulation is made; null: the lists stay as they are.
  void (*sort)(const void* settings, SimulationInput& input, const RestMesh& rest) = nullptr;
  MakeSimulation<float> make_float = nullptr;  ///< null: there is no single precision
  MakeSimulation<double> make_double = nullptr;

  /// Null if the method does not have the precision Real.
  template <class Real>
  MakeSimulation<Real> make() const {
    if constexpr (std::is_same_v<Real, float>)
      return make_float;
    else
      return make_double;
  }

  /// For a method that a program adds: a text that identifies the version of its code in run ids. Empty: a
  /// hash of the program's file identifies the version.
  std::string_view code = {};

  /// Whether an effect with these traits acts in the method. Other effects must not be in its plan.
  bool takes_effect(bool needs_projection, bool acts_in_iterations) const {
    return projects || !needs_projection || (takes_effects_in_iterations && acts_in_iterations);
  }
};

/// How often a substep projects each constraint.
int projections_per_substep(const SimulationInput& input);

/// Every registered method: the methods of methods.hpp, then the methods that the program added.
std::span<const MethodKind* const> methods();

/// The method called `name`, or nullptr.
const MethodKind* find_method(std::string_view name);

/// Adds a method of the program's own. See Registry::add().
void register_method(const MethodKind& kind);
void register_method(const MethodKind&&) = delete;

/// The methods that the program added.
std::span<const MethodKind* const> added_methods();

}  // namespace bendlab
