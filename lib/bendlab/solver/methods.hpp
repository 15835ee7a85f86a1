// The settings of every solver method, with their defaults. The file of a method, methods/<name>.cpp,
// explains the settings and the step. A new method needs a struct and its name in the list below, one file,
// one test and one config.
#pragma once

#include "bendlab/solver/method.hpp"

namespace bendlab {

enum class Sweep {
  forward,    ///< one pass over the constraints per iteration
  symmetric,  ///< forward, then backward: two projections per iteration; gains no energy at small steps
};

enum class FirstConstraint { strain, bending };

enum class Integrator { euler, bdf2 };

struct Pbd {
  Sweep sweep = Sweep::forward;
  ConstraintOrder order = ConstraintOrder::colour;
  FirstConstraint first = FirstConstraint::strain;
  double flight_limit = 0;  ///< 1; 0: no substep is cut
  int levels = 0;           ///< largest number of coarse levels
  static const MethodKind kind;
};

struct KangCho {
  /// The part of a spring's tangent that is implicit.
  enum class Tangent {
    along,      ///< k along the spring, nothing across it: J = k d dᵀ / |d|², as in the source
    taut,       ///< also k (1 - L / |d|) across a spring that is longer than L
    isotropic,  ///< k in every direction: J = k 1
  };

  Tangent tangent = Tangent::along;
  static const MethodKind kind;
};

struct Equilibrium {
  static const MethodKind kind;
};

struct Newton {
  Integrator integrator = Integrator::bdf2;
  double tolerance = 1e-7;  ///< of the cloth's size
  static const MethodKind kind;
};

struct QuasiNewton {
  enum class Membrane { stated, automatic };

  /// The default is not bdf2, because bdf2 gains energy if iterations have not converged.
  Integrator integrator = Integrator::euler;
  double tolerance = 1e-7;  ///< of the cloth's size
  int history = 5;          ///< number of pairs that L-BFGS keeps
  Membrane membrane = Membrane::automatic;
  double membrane_error = 0.01;  ///< of the cloth's size
  static const MethodKind kind;
};

struct Vbd {
  Integrator integrator = Integrator::bdf2;
  double tolerance = 1e-7;  ///< of the cloth's size
  double acceleration = 0;  ///< ρ of Chebyshev's acceleration; 0: no acceleration
  static const MethodKind kind;
};

/// All methods, in the order of the lists that users see.
inline constexpr auto listed_methods =
    listed_kinds<MethodKind, Pbd, KangCho, Equilibrium, Newton, QuasiNewton, Vbd>;

/// The settings of input.method. Throws std::logic_error if the method has settings of another type.
template <class Settings>
const Settings& settings_of(const SimulationInput& input) {
  const auto* settings = input.method.as<Settings>();
  if (settings == nullptr) throw std::logic_error("settings_of: the input has another method");
  return *settings;
}

}  // namespace bendlab
