// The interface of a solver method: what one step does to a cloth. A new method is a struct in methods.hpp,
// one file in methods/, one test and one config. It declares here what it can simulate; the rules of scenes
// follow that.
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

/// What a warning knows of a run whose steps did not converge.
struct UnconvergedRun {
  bool touches = false;  ///< the cloth may touch an obstacle
  bool has_strain = false;
};

/// What a remedy knows of a run that did what its scene cannot do.
struct FailedRun {
  const SimulationInput& input;
  bool fell_wrong = false;  ///< nothing holds it, and it did not fall as its forces say; else it flew apart
  bool single_precision = false;
  bool is_pinned = false;
  bool helps_projection = false;  ///< it lists an effect that does (EffectKind)
  bool is_prestressed = false;    ///< springs are longer at rest than their vertices are apart
};

template <class Real>
using MakeSimulation = std::unique_ptr<Simulation> (*)(const SimulationInput&, std::vector<Pass<Real>>);

/// A MakeSimulation that constructs a class with what it gets.
template <class Step, class Real>
std::unique_ptr<Simulation> make_step(const SimulationInput& input, std::vector<Pass<Real>> effect_passes) {
  return std::make_unique<Step>(input, std::move(effect_passes));
}

enum class ConstraintOrder {
  colour,  ///< by colour, with lanes and threads side by side
  mesh,    ///< in the order of the lists, one after another, by the oracle
  pins,    ///< like mesh, with lists that order_from_pins() has sorted
};

/// A member of the family: its traits, and what makes a simulation by it.
struct MethodKind {
  std::string_view name;
  std::string_view summary;                 ///< one line: what a step does
  std::string_view source;                  ///< paper and equation
  std::string_view limits;                  ///< what it cannot do
  FieldTable settings;                      ///< its own, beside the shared ones in SolverSettings
  std::span<const MethodPass> passes = {};  ///< besides "bending" and those of effects
  Membrane membrane = Membrane::triangles;
  Factorised factorised = Factorised::nothing;
  /// About how many times as long as projecting each constraint once an iteration takes, for forecasts.
  double cost = 1;
  bool springs_only = false;        ///< only takes bending models that are made of springs
  bool takes_own_elements = false;  ///< elements of a function that the library does not know
  /// Why every stiffness has to be a compliance above 0; empty: it may also be k.
  std::string_view needs_compliance = {};
  /// Constraints are projected one after another. So effects may act between them, and springs may only push
  /// as hard as the projections of a substep can hold.
  bool projects = false;
  /// It takes effects that act between projections although it does not project: after each of its
  /// iterations, those that can (EffectKind::acts_in_iterations).
  bool takes_effects_in_iterations = false;
  int default_substeps = 0, default_iterations = 0;  ///< 0: it reads no such number
  bool has_motion = true;         ///< a step goes on in time; else it goes towards an equilibrium
  bool steps_implicitly = false;  ///< its iterations go towards the minimum that implicit_step.hpp states
  bool keeps_momentum = false;    ///< only forces change Σ m v, except for rounding
  /// Its arrays have the vertices in the mesh's order: SimulationInput::permutation has to be empty, also for
  /// the effects.
  bool mesh_order = false;
  /// Single precision keeps the moves of a substep apart from the positions; else it rounds whole positions.
  bool keeps_moves_apart = false;
  /// Projections of each constraint in an iteration; null: 1.
  int (*sweeps_per_iteration)(const void* settings) = nullptr;
  /// Whether stretch is carried by more than the constraints, alike in all directions; null: never.
  bool (*carries_stretch)(const void* settings) = nullptr;
  /// How far the cloth at rest may move because the membrane is softened, as a share of the cloth's size;
  /// 0: the membrane is as stated. Null: always so.
  double (*membrane_error)(const void* settings) = nullptr;
  /// Iterations that a substep needs to follow the motion, per C², the square of the membrane's Courant
  /// number; 0: their number does not depend on it.
  double iterations_per_courant = 0;
  /// Steps that leave more of the effects' forces unbalanced, times these forces, lag behind the motion; and
  /// where cloth touches something.
  double residual_of_lag = 2, residual_of_lag_on_obstacle = 1;
  /// What helped against that in tests, in a sentence; null: more iterations.
  std::string_view (*remedy_of_lag)(const void* settings, const UnconvergedRun&) = nullptr;
  /// What helped in trials with such a run, with numbers; null: nothing was tried.
  std::vector<std::string_view> (*remedies)(const void* settings, const FailedRun&) = nullptr;
  /// Sorts the scene's lists before a simulation is made; null: it takes them as they are.
  void (*sort)(const void* settings, SimulationInput& input, const RestMesh& rest) = nullptr;
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

  /// Of an added one: tells versions of its code apart, in run ids. Empty: the program's file does.
  std::string_view code = {};

  /// Whether an effect acts in it. One that does not must not be in its plan.
  bool takes_effect(bool needs_projection, bool acts_in_iterations) const {
    return projects || !needs_projection || (takes_effects_in_iterations && acts_in_iterations);
  }
};

/// How often a substep projects each constraint.
int projections_per_substep(const SimulationInput& input);

/// Every registered method: those of methods.hpp, then those that the program added.
std::span<const MethodKind* const> methods();

/// The method of that name, or nullptr.
const MethodKind* find_method(std::string_view name);

/// Adds a method of the program's own. See Registry::add().
void register_method(const MethodKind& kind);
void register_method(const MethodKind&&) = delete;

/// The methods that the program added.
std::span<const MethodKind* const> added_methods();

}  // namespace bendlab
