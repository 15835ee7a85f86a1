// The interface of a solver method, which computes the steps of a cloth. The MethodKind of a method declares
// what the method can simulate. Scenes are checked against this declaration.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/settings/field.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// What resists stretch of the cloth.
enum class Membrane {
  triangles,  ///< SimulationInput::strain
  edges,      ///< SimulationInput::edges, a spring along each
};

/// The matrix that a method factorises.
enum class Factorised {
  nothing,
  scalars,  ///< once: a matrix with a scalar for each pair of neighbours
  blocks,   ///< in every iteration: a matrix with a 3 by 3 block for each pair of neighbours
};

/// A pass that a method adds to the plan, and the reason for the pass.
struct MethodPass {
  std::string_view name, why;
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

/// A solver method: its properties, and the functions that make a simulation.
struct MethodKind {
  std::string_view name;
  std::string_view summary;  ///< one line: what a step does
  std::string_view source;   ///< paper and equation
  std::string_view limits;   ///< what it cannot do
  FieldTable settings;       ///< the method's own settings; SolverSettings has the shared settings
  std::span<const MethodPass> passes = {};  ///< besides "bending" and the passes of effects
  Membrane membrane = Membrane::triangles;
  Factorised factorised = Factorised::nothing;
  double bytes_per_vertex = 0;      ///< memory that the method takes besides mesh and constraints, measured
  bool springs_only = false;        ///< only takes bending models that are made of springs
  bool holds_axes = false;          ///< can hold vertices along an axis (SimulationInput::held)
  bool takes_own_elements = false;  ///< takes elements whose function the program brings
  /// Why the method needs every stiffness as a compliance above 0. Empty: stiffness may also be given as k.
  std::string_view needs_compliance = {};
  /// Whether the method projects constraints one after another. Only then may effects act between
  /// projections. build_scene() then shortens the excess length of prestressed
  /// springs, if a substep has too few projections to balance their push (push_bound.hpp).
  bool projects = false;
  /// For a method that does not project: whether effects that act between projections may act after each
  /// iteration. An effect also has to allow this (EffectKind::acts_in_iterations).
  bool takes_effects_in_iterations = false;
  int default_substeps = 0, default_iterations = 0;  ///< 0: the method does not read the setting
  bool has_motion = true;                            ///< false: steps approach an equilibrium
  bool steps_implicitly = false;  ///< its iterations approach the minimum that implicit_step.hpp states
  bool keeps_momentum = false;    ///< only forces and rounding change Σ m v
  /// Whether the method's arrays have the vertices in the mesh's order. Then SimulationInput::permutation has
  /// to be empty, also for the effects.
  bool mesh_order = false;
  /// Whether, in single precision, the moves of a substep are stored apart from the positions; false: each
  /// move is added to the position and rounded.
  bool keeps_moves_apart = false;
  /// Projections of each constraint in an iteration; null: 1.
  int (*sweeps_per_iteration)(const void* settings) = nullptr;
  /// Whether a part of the method, such as the coarse levels of pbd, also resists stretch, equally in all
  /// directions; null: never.
  bool (*carries_stretch)(const void* settings) = nullptr;
  /// How far a softened membrane may move the cloth at rest, in sizes of the cloth; 0: no softening. Null: 0.
  double (*membrane_error)(const void* settings) = nullptr;
  /// The number of iterations that a substep needs to follow the motion, divided by C²; C is the Courant
  /// number of the membrane. 0: the number does not depend on C.
  double iterations_per_courant = 0;
  /// Steps lag behind the motion if the unbalanced forces exceed this multiple of the effects' forces; the
  /// second multiple is for cloth that touches something.
  double residual_of_lag = 2, residual_of_lag_on_obstacle = 1;
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

  /// For a method that a program adds: the version of the method's code, as a part of run ids. Empty: the
  /// version is a hash of the program's file.
  std::string_view code = {};

  /// Whether an effect acts in the method, if its EffectKind has these two values. The plan must not have
  /// others.
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

/// Adds a method that the program defines. See Registry::add().
void register_method(const MethodKind& kind);
void register_method(const MethodKind&&) = delete;

/// The methods that the program added.
std::span<const MethodKind* const> added_methods();

}  // namespace bendlab
