// Static equilibrium: the minimum of elastic energy and loads, by Newton's method.
//
//   per step:  loads → gradient, Hessian → factorise → move
//
//   (H + M / τ²) Δx = f - ∇E,   H = Σ ψ'' ∇C ∇Cᵀ + λ ∇²C
//
// λ estimates ψ'(C), the force in a constraint. For a stiff membrane ψ'(C) itself is a bad estimate away from
// the solution. A step that turns a triangle by an angle stretches the triangle by the square of the angle,
// and the force of this stretch would resist the next step. So λ is ψ' + ψ'' ∇C·Δx of the last step, as if
// force and position were both unknowns (the mixed form of Newton's method; at the solution λ and ψ'(C)
// agree). A step is shortened until no triangle stretches by more than `stretch_per_step` beyond the stretch
// to first order.
//
// M / τ² is the mass term of an implicit Euler step of length τ from rest. Far from the solution τ is short,
// and the energy falls slowly; the mass term is needed there, because a flat sheet has no stiffness along its
// normal. As τ grows, the steps become Newton steps. The matrix may not be positive definite, for example if
// the cloth is crumpled, or if springs are compressed before the membrane resists their push. Then λ is first
// set to 0, except for stretched lengths. If the matrix is still not positive definite, τ is shortened. The
// last steps use the whole matrix without M / τ², so the search ends at a minimum, never at a saddle.
//
// A stiff membrane is softer at first, and becomes stiffer in factors of ten once the cloth has found its
// shape. With full stiffness from the start, a strip that bends by springs would end with creases of the
// first steps.
//
// A step counts as dt of the scene's time. The scene is settled when two conditions are met: the last step
// moved every vertex by at most 1e-6 sizes of the cloth, and the unbalanced forces are at most
// `equilibrium_tolerance` of the loads, or as small as the rounding of positions allows.
//
// Everything is computed in double precision. The loads follow from the changes of velocity by the passes of
// stage `force` on a cloth at rest. Passes of the stages `damp` and `velocity` do nothing here.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/memory.hpp"
#include "bendlab/solver/methods.hpp"
#include "bendlab/solver/supernodal_solver.hpp"
#include "bendlab/solver/time_step.hpp"

namespace bendlab {
namespace {

using Eigen::VectorXd;

constexpr std::array own_passes = {
    MethodPass{"gradient", "equilibrium: the unbalanced forces"},
    MethodPass{"Hessian", "equilibrium: the stiffness matrix"},
    MethodPass{"factorise", "equilibrium: Cholesky factors of the matrix, and the step"},
    MethodPass{"move", "equilibrium: moves the cloth, but only as far as triangles hardly stretch"},
};

constexpr double equilibrium_tolerance = 1e-7;  // 1, |f - ∇E| / |f| over all free vertices
constexpr double still = 1e-6;  // of the cloth's size: the last step of a settled cloth is at most this long

// The following numbers decide how many steps the search takes, and which of several equilibria the search
// finds. The numbers do not change how well the forces balance, because the last steps are not shortened, and
// have the stated membrane. The mass term is pseudo-transient continuation (Kelley and Keyes 1998): after a
// step that succeeds, τ is lengthened.
constexpr double stretch_per_step = 0.05;  // 1, of a triangle beyond the step's aim
constexpr double longest_move = 0.2;       // of the cloth's size, per step
constexpr double first_move = 0.05;        // of the cloth's size: by the first step of a cloth that falls
constexpr double lengthening = 10;         // of τ², after a step that was not shortened
constexpr double shortening = 4;           // of τ², after a step that was shortened much
constexpr double shortened_much = 0.3;     // of a step: at most this share of it is left
constexpr double halving = 0.5;            // factor on a step that stretches too much
constexpr double crept = 1e-4;             // of the cloth's size: shorter steps do not leave a saddle
constexpr double far_move = 5e-3;          // of the cloth's size: after a longer step, convex() multipliers
constexpr double lost = 1e-14;          // 1 / τ² below this share of the stiffness is rounded away: 100 ε
constexpr double first_stretch = 1e-4;  // 1, of the softened membrane under the loads
constexpr double softest = 1000;        // times the stated compliance, of a cloth far from its equilibrium
constexpr double softest_near = 10;     // times the stated compliance, of a pose from another mesh
constexpr double stiffening = 10;       // of the membrane, once the cloth has found its shape:
constexpr double found_unbalanced = 1e-3;  // 1, relative to the loads
constexpr double found_move = 1e-3;        // of the cloth's size, in the last step

class EquilibriumSearch final : public TimeStep<double> {
 public:
  EquilibriumSearch(const SimulationInput& input, std::vector<Pass<double>> effect_passes)
      : TimeStep<double>(input, {}),
        system_(input),
        positions_(input.points()),
        masses_(system_.unknowns()),
        whole_(system_.unknowns() == 0),
        size_(input.size),
        strain_compliance_(input.strain.size() > 0 ? input.strain_stiffness.compliance : 0),
        last_move_(whole_ ? 0 : size_),
        starting_from_(input.starting_from) {
    for (std::size_t v = 0; v < input.point_count(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0)
        masses_.segment<3>(3 * at).setConstant(input.mass_of(v));
    // An equilibrium is that of the last stiffness.
    constexpr double end = std::numeric_limits<double>::infinity();
    system_.scale_stiffness({input.strain_schedule.at(end), input.bending_schedule.at(end)});
    compile_plan(std::move(effect_passes));
  }

  bool settled() const override { return softness_ == 1 && balanced() && whole_; }
  std::optional<double> unbalanced() const override { return unbalanced_; }

  void archive(Archive& state) override {
    TimeStep<double>::archive(state);
    state(positions_, multipliers_, convex_, far_, whole_, softness_, last_move_, scale_, unbalanced_,
          rounding_, inverse_tau_squared_, solver_.memory_bytes());
    if (state.reads()) system_.soften_strain(softness_);
  }

  std::size_t memory_bytes() const override {
    std::size_t vectors = 0;
    for (const VectorXd* vector : {&masses_, &loads_, &residual_, &direction_, &multipliers_})
      vectors += bytes_of(*vector);
    return TimeStep<double>::memory_bytes() + system_.memory_bytes() + vectors +
           static_cast<std::size_t>(positions_.size()) * sizeof(double) + solver_.memory_bytes();
  }

 private:
  void scale_stiffness(const StiffnessFactors&) override {}
  bool balanced() const {
    return unbalanced_ <= std::max(equilibrium_tolerance, rounding_) && last_move_ <= still * size_;
  }
  void substep(PassContext<double>& context) override { run(plan_, context); }
  std::uint64_t projections_per_substep() const override { return system_.term_count(); }

  void compile_plan(std::vector<Pass<double>> effect_passes) {
    for (const Pass<double>& pass : effect_passes)
      if (pass.stage != Stage::force && pass.stage != Stage::damp && pass.stage != Stage::velocity)
        throw std::invalid_argument(fmt::format(
            "equilibrium: the pass {} needs a time step, but an equilibrium has loads only", pass.name));
    append_effects(plan_, effect_passes, Stage::force);
    add_pass(plan_, "gradient", [this](auto& c) { find_gradient(c.substep); });
    add_pass(plan_, "Hessian", [this](auto&) { assemble(); });
    add_pass(plan_, "factorise", [this](auto&) { factorise(); });
    add_pass(plan_, "move", [this](auto&) { move(); });
  }

  void find_gradient(double h) {
    loads_.resize(system_.unknowns());
    for (std::size_t v = 0; v < system_.free_index().size(); ++v)
      if (const int at = system_.free_index()[v]; at >= 0)
        loads_.segment<3>(3 * at) = state_.mass[v] / h * state_.velocity[v].vector();
    std::fill(state_.velocity.begin(), state_.velocity.end(), Point<double>{});
    system_.drop_held(loads_);
    residual_ = loads_ - system_.gradient(positions_);
    unbalanced_ = relative(residual_);
    if (inverse_tau_squared_ < 0) start();
    while (softness_ > 1 && unbalanced_ < found_unbalanced && last_move_ <= found_move * size_)
      soften(std::max(softness_ / stiffening, 1.0));
  }

  // Makes the membrane so soft that the loads stretch it by about first_stretch. If the cloth starts near its
  // equilibrium, the membrane is softened less, because a softer cloth may not have this equilibrium.
  void start() {
    inverse_tau_squared_ = 0;
    if (system_.unknowns() == 0) return;
    const double load = loads_.cwiseAbs().sum() / size_;  // N/m
    if (strain_compliance_ > 0 && load > 0)
      soften(std::clamp(first_stretch / (strain_compliance_ * load), 1.0, softest_start()));
    multipliers_ = system_.multipliers(positions_);
    start_creeping();
  }

  double softest_start() const {
    switch (starting_from_) {
      case StartingFrom::scene:
        return softest;
      case StartingFrom::other_mesh:
        return softest_near;
      case StartingFrom::same_mesh:
        return 1;
    }
    throw std::logic_error("equilibrium: unknown start");
  }

  void soften(double softness) {
    softness_ = softness;
    system_.soften_strain(softness);
    residual_ = loads_ - system_.gradient(positions_);
    unbalanced_ = relative(residual_);
  }

  // The error of the forces from the rounding of positions, relative to the loads.
  double rounding() const {
    constexpr double of_position = std::numeric_limits<double>::epsilon();
    return scale_ > 0 ? of_position * size_ * hessian_->diagonal().norm() / scale_ : 0;
  }

  // The norm of a residual, relative to the loads; if there are no loads, relative to the first residual.
  double relative(const VectorXd& residual) {
    const double norm = residual.norm();
    if (!(scale_ > 0)) scale_ = loads_.norm() > 0 ? loads_.norm() : norm;
    return scale_ > 0 ? norm / scale_ : 0;
  }

  // Chooses τ so that the first step moves the cloth by first_move under its loads.
  void start_creeping() {
    const VectorXd& forces = starting_from_ != StartingFrom::scene && loads_.norm() > 0 ? loads_ : residual_;
    const double acceleration = forces.cwiseQuotient(masses_).cwiseAbs().maxCoeff();
    inverse_tau_squared_ = acceleration / (first_move * size_);
  }

  void assemble() {
    if (settled()) return;
    convex_ = far_ && !balanced();
    hessian_ = &system_.hessian(positions_, convex_ ? system_.convex(multipliers_) : multipliers_);
    rounding_ = rounding();
  }

  // If the matrix is not positive definite, first sets the multipliers that may be the cause to 0 (see
  // convex()), then shortens τ. At a saddle τ is shortened at once, because the longest τ with a definite
  // matrix leads away from the saddle fastest.
  void factorise() {
    if (settled()) return;
    constexpr int attempts = 100;  // no τ helps if entries are not finite
    for (int attempt = 0; !factorised(); ++attempt) {
      if (attempt == attempts) throw std::runtime_error("equilibrium: the stiffness matrix is not finite");
      if (convex_ || balanced() || last_move_ <= crept * size_)
        inverse_tau_squared_ = std::max(shortening * inverse_tau_squared_, smallest());
      else
        hessian_ = &system_.hessian(positions_, system_.convex(multipliers_)), convex_ = true;
    }
    whole_ = !convex_ && inverse_tau_squared_ == 0;
    direction_ = solver_.solve(residual_);
  }

  bool factorised() { return solver_.factorise(*hessian_, inverse_tau_squared_ * masses_); }

  // A smaller 1 / τ² would be rounded away when it is added to the Hessian's diagonal.
  double smallest() const { return lost * hessian_->diagonal().cwiseQuotient(masses_).cwiseAbs().maxCoeff(); }

  void move() {
    if (settled()) return;
    const double farthest = direction_.cwiseAbs().maxCoeff();
    double share = farthest > 0 ? std::min(1.0, longest_move * size_ / farthest) : 1;
    while (system_.strain_beyond_first_order(positions_, share * direction_) > stretch_per_step)
      share *= halving;
    const VectorXd step = share * direction_;
    // If the step is shortened to a share, the multipliers change by this share, too.
    multipliers_ = (1 - share) * multipliers_ + share * system_.predicted_multipliers(positions_, direction_);
    positions_ = system_.moved(positions_, step);
    if (share == 1)
      inverse_tau_squared_ /= lengthening;
    else if (share < shortened_much)
      inverse_tau_squared_ *= shortening;
    if (inverse_tau_squared_ < smallest()) inverse_tau_squared_ = 0;
    last_move_ = step.cwiseAbs().maxCoeff();
    far_ = convex_ && last_move_ > far_move * size_;
    for (std::size_t v = 0; v < state_.mass.size(); ++v)
      state_.position[v].set(positions_.row(static_cast<Eigen::Index>(v)).transpose() - origin_of(v));
    find_divergence();
  }

  ElasticSystem system_;
  Positions positions_;  // #P by 3, m, in world coordinates
  VectorXd masses_, loads_, residual_, direction_, multipliers_;
  const Eigen::SparseMatrix<double>* hessian_ = nullptr;
  SupernodalSolver solver_;
  bool convex_ = false;  // the Hessian has convex() multipliers
  bool far_ = false;     // convex() is likely to be needed again
  bool whole_;           // the last step was a whole Newton step, with a definite matrix
  double size_, strain_compliance_, softness_ = 1, last_move_, scale_ = 0, unbalanced_ = 1, rounding_ = 0,
                                    inverse_tau_squared_ = -1;
  StartingFrom starting_from_;
  Passes plan_;
};

}  // namespace

constinit const MethodKind Equilibrium::kind{
    .name = "equilibrium",
    .summary =
        "the static equilibrium of loads and elastic energies by Newton's method; a step counts as dt, and "
        "the run ends when the forces balance",
    .source =
        "Newton's method in its mixed form, with force and position as unknowns; CHOLMOD's supernodal "
        "Cholesky factors",
    .limits =
        "needs energies: every stiffness is a compliance above 0; double precision only; has no motion; "
        "takes no effects that act between projections; finds only one of several equilibria",
    .settings = table_of<Equilibrium>({}),
    .passes = own_passes,
    .factorised = Factorised::blocks,
    .bytes_per_vertex = 10e3,
    .holds_axes = true,
    .takes_own_elements = true,
    .needs_compliance = "k has no energy and so no equilibrium",
    .has_motion = false,
    .mesh_order = true,
    .make_double = make_step<EquilibriumSearch>,
};
}  // namespace bendlab
