// What all methods with implicit steps share. The positions at the end of a substep minimise
//
//   ½ Σ w |x - y|² + E(x),   w = (m + c γ) / γ²
//
// with the elastic energy E. The velocities are v = (x - X) / γ. For a substep of length h from n to n + 1,
// with forces of acceleration a and linear drag c (kg/s):
//
//   backward Euler   γ = h       X = x_n                      V = v_n
//   BDF2             γ = 2/3 h   X = x_n + (x_n - x_n-1) / 3   V = v_n + (v_n - v_n-1) / 3
//
//   y = X + γ (V + γ a) m / (m + c γ)
//
// The first substep of BDF2 is a backward Euler step. Each method has its own iteration, iterate().
//
// A vertex that a contact pushed in the last substep uses backward Euler, because a push makes a kink in
// motion.
//
// contact_forces.hpp has the forces of obstacles, of layers of the cloth, and of friction. The depth by which
// a vertex sinks into an obstacle is removed at the end of the substep.
//
//   per substep:  start → force passes → damp passes → target → predicted passes →
//                 n × (project passes, contact passes, iterate) → project passes → update → velocity passes
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include "bendlab/solver/contact_forces.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/time_step.hpp"

namespace bendlab {

inline constexpr std::array<std::string_view, 2> integrator_names = {"euler", "bdf2"};

/// The settings that all implicit methods have.
// clang-format off
template <class Settings>
inline constexpr std::array implicit_fields = {
    field<&Settings::integrator>({.name = "integrator",
        .meaning = "The time integrator. euler: backward Euler, first order, damps motion; bdf2: second "
                   "order, hardly damps motion, but gains energy if iterations are too few. The default is "
                   "euler for quasi_newton, and bdf2 for newton and vbd",
        .choices = integrator_names}),
    field<&Settings::tolerance>({.name = "tolerance", .unit = "1",
        .meaning = "A substep ends early if all vertices are closer to the minimum than this share of the "
                   "cloth's size, as estimated from the last moves; 0: no substep ends early",
        .minimum = 0}),
};
// clang-format on

/// The passes that every implicit method has.
template <std::size_t N>
constexpr std::array<MethodPass, 4> implicit_passes(const char (&iteration)[N]) {
  return {MethodPass{"start", "stores the velocities before forces change them"},
          MethodPass{"target", "the positions without elastic forces, and the first guess"},
          MethodPass{"iterate", iteration}, MethodPass{"update", "v from x; looks for divergence"}};
}

class ElasticSystem;

/// The data of a substep that are not in State. Arrays have the order of State::position.
template <class Real>
struct ImplicitData {
  std::vector<double> drag;                 ///< c, kg/s; empty: no drag
  std::vector<Real> gamma;                  ///< γ, s
  std::vector<Real> weight;                 ///< w, kg/s²; 0: pinned
  Points<Real> base, target;                ///< X and y, m
  Points<Real> velocity, earlier_velocity;  ///< v_n and v_n-1, m/s
  ContactForces<Real> contacts;             ///< of this iteration; in_use() if effects push
  double total_force = 0;                   ///< Σ |m a| over free vertices by the forces of this substep, N
  Real last_move = 0;                       ///< what the last iterate() returned, m
  bool has_history = false;                 ///< whether earlier_velocity is known
  bool weights_changed = false;             ///< whether any weight differs from that of the last substep
  bool is_first_iteration = true;           ///< whether this is the first iteration of a substep
  bool is_late = false;                     ///< whether this is in the later half of a substep's iterations
};

template <class Real>
class ImplicitStep : public TimeStep<Real> {
 public:
  std::uint64_t projections() const final { return iterations_done_ * constraint_count_; }
  std::size_t memory_bytes() const override;
  std::optional<StepResidual> step_residual() const final;
  void archive(Archive& state) override;

 protected:
  /// Throws std::invalid_argument if a stiffness is not a compliance above 0.
  template <class Settings>
  ImplicitStep(const SimulationInput& input, const Settings& settings, std::vector<int> permutation)
      : ImplicitStep(input, settings.integrator, settings.tolerance, std::move(permutation)) {}
  ImplicitStep(const SimulationInput& input, Integrator integrator, double tolerance,
               std::vector<int> permutation);

  /// Call this once, when the derived class is complete. The stiffness of a contact is `per_weight` w + b m,
  /// with the weight w and the mass m of its vertex. `mean` is the mean of b m over free vertices, N/m.
  void compile_plan(std::vector<Pass<Real>> effect_passes, double per_weight, double mean);

  /// The name of the pass that calls prepare() before the iterations of a substep; null: no such pass.
  virtual const char* preparation() const { return nullptr; }
  virtual void prepare() {}

  /// One iteration towards the minimum, from state_.position. Returns how far vertices may still be from the
  /// minimum, m. If the method converges fast, the longest move of this iteration is a good estimate.
  virtual Real iterate() = 0;

  /// Whether the substep needs another iteration, even if /solver/iterations are done.
  virtual bool must_go_on() const { return false; }

  /// -∇E, N, in the order of State::position.
  virtual Points<Real> elastic_forces(const Points<Real>& positions) const = 0;

  /// The weights w for the γ that the integrator has after its first substep.
  std::vector<Real> lasting_weights() const;
  /// Points in world coordinates, #P by 3, m. Methods that permute vertices cannot call this or
  /// start_lower().
  Positions in_world(const Points<Real>& points) const;
  /// Replaces the first guess by the positions at the end of the last substep, if the minimised function is
  /// lower there. Otherwise the first guess of a long step may be so far away that cloth gains energy.
  void start_lower(const ElasticSystem& system);
  /// If nothing is pinned, shifts the whole cloth to where the minimised function is least. Elastic forces
  /// sum to zero, but an iteration rounds the sum, or passes the cloth's weight on only from vertex to
  /// vertex. Call this at the end of an iteration.
  void keep_momentum();
  /// Whether a pinned vertex was moved in this substep.
  bool pins_moved() const;

  using TimeStep<Real>::settings_, TimeStep<Real>::state_, TimeStep<Real>::constraints_;
  ImplicitData<Real> data_;

 private:
  using typename TimeStep<Real>::Passes;
  void substep(PassContext<Real>& context) final;
  int most_iterations() const { return 20 * std::max(settings_.iterations, 5); }
  std::uint64_t projections_per_substep() const final { return constraint_count_; }
  Real weight_for(std::size_t v, double gamma) const;
  void take_drag_over(Pass<Real>& pass);
  void remember_velocities();
  void aim(Real h);
  void turn_clamped_normals();
  void add_contact_passes(std::vector<Pass<Real>>& effect_passes);
  void update();

  Integrator integrator_;
  double tolerance_, size_;  // m
  std::vector<ClampedNormal> clamped_;
  std::uint64_t constraint_count_ = 0, iterations_done_ = 0;
  bool has_unknowns_ = false;
  bool has_stepped_ = false;  // since construction; steps before a checkpoint do not count
  Passes before_, iteration_, contact_, after_;
};

}  // namespace bendlab
