// What methods share that step implicitly: the positions at the end of a substep minimise
//
//   ½ Σ w |x - y|² + E(x),   w = (m + c γ) / γ²
//
// with the elastic energy E. x gives the velocities, v = (x - X) / γ. For a substep h from n to n + 1, with
// forces of acceleration a and linear drag of c (kg/s):
//
//   backward Euler   γ = h       X = x_n                      V = v_n
//   BDF2             γ = 2/3 h   X = x_n + (x_n - x_n-1) / 3   V = v_n + (v_n - v_n-1) / 3
//
//   y = X + γ (V + γ a) m / (m + c γ)
//
// BDF2's first substep is one of backward Euler. A method says how it minimises: iterate() is one iteration.
//
// Where a contact pushed in the last substep, motion has a kink, and backward Euler is used.
//
// Obstacles and the cloth's own layers push, and friction holds, with the forces of contact_forces.hpp. What
// a vertex sinks in is taken back at the end of the substep.
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

/// The rows of settings of every implicit method.
// clang-format off
template <class Settings>
inline constexpr std::array implicit_fields = {
    field<&Settings::integrator>({.name = "integrator",
        .meaning = "How a substep goes on in time. euler: backward Euler, of first order, which damps "
                   "motion; bdf2: of second order, which hardly does, and gains energy where iterations are "
                   "too few. quasi_newton begins with euler, the others with bdf2",
        .choices = integrator_names}),
    field<&Settings::tolerance>({.name = "tolerance", .unit = "1",
        .meaning = "A substep ends before its iterations do once no vertex is farther from its aim than this "
                   "times the cloth's size, as far as the last moves tell; 0: never",
        .minimum = 0}),
};
// clang-format on

/// The passes of the plan of every implicit method.
template <std::size_t N>
constexpr std::array<MethodPass, 4> implicit_passes(const char (&iteration)[N]) {
  return {MethodPass{"start", "forces are part of the minimum, not of the first guess"},
          MethodPass{"target", "the positions without elastic forces, and the first guess"},
          MethodPass{"iterate", iteration}, MethodPass{"update", "v from x; looks for divergence"}};
}

class ElasticSystem;

/// What a substep works on, beside State. Arrays have the slots of State::position.
template <class Real>
struct ImplicitData {
  std::vector<double> drag;                 ///< c, kg/s; empty: no drag
  std::vector<Real> gamma;                  ///< γ, s
  std::vector<Real> weight;                 ///< w, kg/s²; 0: pinned
  Points<Real> base, target;                ///< X and y, m
  Points<Real> velocity, earlier_velocity;  ///< v_n and v_n-1, m/s
  ContactForces<Real> contacts;             ///< of this iteration; not in use without effects that push
  double total_force = 0;                   ///< Σ |m a| over free vertices by the forces of this substep, N
  Real last_move = 0;                       ///< what the last iteration returned, m
  bool has_history = false;                 ///< whether there is a v_n-1
  bool weights_changed = false;             ///< whether any weight differs from that of the last substep
  bool is_first_iteration = true;           ///< of a substep
  bool is_late = false;                     ///< in the later half of a substep's iterations
};

template <class Real>
class ImplicitStep : public TimeStep<Real> {
 public:
  std::uint64_t projections() const final { return iterations_done_ * constraint_count_; }
  std::size_t memory_bytes() const override;
  std::optional<StepResidual> step_residual() const final;
  void archive(Archive& state) override;

 protected:
  /// Throws std::invalid_argument unless every stiffness is a compliance above 0.
  template <class Settings>
  ImplicitStep(const SimulationInput& input, const Settings& settings, std::vector<int> permutation)
      : ImplicitStep(input, settings.integrator, settings.tolerance, std::move(permutation)) {}
  ImplicitStep(const SimulationInput& input, Integrator integrator, double tolerance,
               std::vector<int> permutation);

  /// Call it once, when the derived class is complete. Contacts push with κ = `per_weight` w, and another
  /// `mean` N/m in the mean over free vertices, in proportion to their masses.
  void compile_plan(std::vector<Pass<Real>> effect_passes, double per_weight, double mean);

  /// The name of a pass before the iterations of a substep, which calls prepare(); null: there is none.
  virtual const char* preparation() const { return nullptr; }
  virtual void prepare() {}

  /// One iteration towards the minimum, from state_.position. Returns how far vertices may still be from it,
  /// m: the longest move of one, where the next iteration moves them by far less.
  virtual Real iterate() = 0;

  /// Whether a substep may not end after this iteration, although it was the last of /solver/iterations.
  virtual bool must_go_on() const { return false; }

  /// -∇E, N, by slot.
  virtual Points<Real> elastic_forces(const Points<Real>& positions) const = 0;

  /// The weights of every later substep of length h: with the γ of settled motion.
  std::vector<Real> lasting_weights() const;
  /// #V by 3, m. This and the next are for methods that do not permute vertices.
  Positions in_world(const Points<Real>& points) const;
  /// A long step's first guess flies far from the cloth: starts where the last substep ended, if what is
  /// minimised is lower there. Without it cloth of few iterations may gain energy.
  void start_lower(const ElasticSystem& system);
  /// If nothing is pinned, moves the cloth as a whole to its minimum: elastic forces sum to zero, but what
  /// solves for them is rounded, or carries the cloth's weight from vertex to vertex. To be called at the end
  /// of an iteration.
  void keep_momentum();
  /// Whether a pinned vertex was put elsewhere in this substep.
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
  void add_contact_passes(std::vector<Pass<Real>>& effect_passes);
  void update();

  Integrator integrator_;
  double tolerance_, size_;  // m
  std::uint64_t constraint_count_ = 0, iterations_done_ = 0;
  bool has_unknowns_ = false;
  bool has_stepped_ = false;  // since it was made, not before a checkpoint
  Passes before_, iteration_, contact_, after_;
};

}  // namespace bendlab
